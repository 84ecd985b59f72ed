/// What points keep of their own beside the grid's velocity: in brief, and without braking flow that the grid
/// sees.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "mpm/brief_vector.h"
#include "mpm/water_scenes.h"

namespace sluice {
namespace {

TEST(BriefVector, KeepsFloatsToHalfAUnitOfTheEighthBinaryDigit) {
  Random random(5);
  for (int n = 0; n < 100000; ++n) {
    Quad<float> v{};
    for (int r = 0; r < 3; ++r)
      v[r] = static_cast<float>(random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-30.0, 30.0)));
    const Quad<float> kept = BriefVector<float>(v).quad();
    for (int r = 0; r < 3; ++r)
      EXPECT_LE(std::abs(kept[r] - v[r]), std::ldexp(1.0F, -8) * std::abs(v[r]) * 1.0001F) << v[r];
    EXPECT_EQ(kept[3], 0.0F);
    for (int r = 0; r < 3; ++r) EXPECT_EQ(BriefVector<float>(kept).quad()[r], kept[r]);
  }
  EXPECT_EQ(BriefVector<float>(Quad<float>{}).quad()[0], 0.0F);
}

TEST(BriefVector, KeepsDoublesWhole) {
  const Quad<double> v{0.1, -1.0 / 3, 1e-200, 4};
  const Quad<double> kept = BriefVector<double>(v).quad();
  for (int r = 0; r < 3; ++r) EXPECT_EQ(kept[r], v[r]);
}

/// Viscosity that a standing wave of shear seems to have, over h c.
/// @param fastest  of the wave over the speed of sound
double thickness_of_water(int cells_per_wave, double fastest) {
  const double h = 0.01, length = cells_per_wave * h, width = 4 * h;
  Domain domain = open_box(Vec3::Zero(), Vec3(width, width, length));
  for (const int axis : {0, 1, 2}) make_periodic(domain, axis);
  const Walls no_walls;
  MpmConfig config;
  config.spacing = h;
  config.sound_speed = 10.0;
  config.keep_tension = true;
  config.fluid.viscosity = 1e-9;
  auto water = make_mpm(config, domain, Vec3::Zero(), no_walls);
  const double k = 2 * std::numbers::pi / length, c = water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(width, width, length)};
  fill.velocity = [&](const Vec3& x) { return Vec3(fastest * c * std::sin(k * x.z()), 0, 0); };
  fill_with_water(*water, h / 2, fill);
  const auto amplitude = [&] {
    const WaterPoints points = water->points();
    double sum = 0;
    for (std::size_t i = 0; i < points.count(); ++i) sum += points.v[i].x() * std::sin(k * points.x[i].z());
    return sum;
  };
  const double dt = water->limits().step, before = amplitude();
  const int steps = 400;
  for (int n = 0; n < steps; ++n) step_water(*water, n * dt, dt);
  return -std::log(amplitude() / before) / (k * k * steps * dt) / (h * c);
}

// To first order in what the transfers lose, all of it, the wave of eight cells would have 0.9 (h / length)^2
// / 1.1.
TEST(Misfit, OfAWaveIsNotForgottenUnlessItShearsTheWaterFast) {
  const double first_order = 0.9 / 64 / 1.1;
  EXPECT_LT(thickness_of_water(8, 1e-4), 0.2 * first_order);
  EXPECT_GT(thickness_of_water(8, 1e-4), -0.01 * first_order);
  EXPECT_GT(thickness_of_water(8, 0.1), 0.3 * first_order);
  EXPECT_LT(thickness_of_water(8, 0.1), 1.2 * first_order);
}

}  // namespace
}  // namespace sluice
