/// Liquids with a yield stress: they stand where a Newtonian one would flow.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mpm/water_scenes.h"

namespace sluice {
namespace {

constexpr double h = 0.02, depth = 6 * h, density = 1000, incline = 0.2;

struct Layer {
  double speed = 0;             ///< of the layer's surface [m/s]
  double weight = 0, held = 0;  ///< along the slope: impulse of gravity and that on the floor [N s]
};

/// A layer on a sticky slope, seen by an observer who stands on it: periodic along x, at rest at first.
Layer on_a_slope(Precision precision, const FluidModel& fluid, double seconds) {
  Domain domain = open_box(Vec3(0, 0, -h), Vec3(4 * h, 4 * h, 2 * depth));
  make_periodic(domain, 0);
  make_periodic(domain, 1);
  Wall floor;
  floor.name = "floor";
  floor.mesh = make_rectangle("floor", {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)});
  const Walls walls(std::vector<Wall>{floor});
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 0.5;
  config.deepest = depth;
  config.wall_slip = WallSlip::no_slip;
  config.precision = precision;
  config.fluid = fluid;
  const Vec3 gravity = 9.81 * Vec3(std::sin(incline), 0, -std::cos(incline));
  auto water = make_mpm(config, domain, gravity, walls);
  for (double z = h / 4; z < depth; z += h / 2)
    for (double y = h / 4; y < 4 * h; y += h / 2)
      for (double x = h / 4; x < 4 * h; x += h / 2) {
        NewPoint p;
        p.x = {x, y, z};
        p.J = std::exp(gravity.z() * (depth - z) / std::pow(water->limits().sound_speed, 2));
        p.mass = density * std::pow(h / 2, 3);
        water->add(p);
      }
  double t = 0;
  for (const double dt = water->limits().step; t < seconds; t += dt) step_water(*water, t, dt);
  Layer out;
  const WaterPoints points = water->points();
  double highest = 0;
  for (std::size_t i = 0; i < points.count(); ++i)
    if (points.x[i].z() > highest) {
      highest = points.x[i].z();
      out.speed = points.v[i].x();
    }
  out.weight = water->impulse_from_gravity().x();
  out.held = water->wall_loads()[0].impulse.x();
  return out;
}

FluidModel mud(double yield_stress) {
  FluidModel fluid;
  fluid.rheology = Rheology::bingham;
  fluid.viscosity = 2;
  fluid.yield_stress = yield_stress;
  fluid.yield_rate = 1;
  return fluid;
}

// The floor's stress is rho g sin(a) H: 234 Pa here.
constexpr double floor_stress = 234;

TEST(YieldStress, HoldsALayerOnASlopeWhoseWeightItCanCarry) {
  for (const Precision precision : {Precision::single, Precision::reference}) {
    const Layer layer = on_a_slope(precision, mud(1.5 * floor_stress), 0.25);
    // It creeps at a rate below r ln 3, the one at which the regularised stress is two thirds of the yield
    // stress.
    EXPECT_LT(layer.speed, 1 * std::log(3.0) * depth);
    EXPECT_GT(layer.held, 0.9 * layer.weight);  // the rest is in its creep
  }
}

TEST(YieldStress, LetsALayerFlowWhoseWeightItCannotCarry) {
  const Layer layer = on_a_slope(Precision::single, mud(0.3 * floor_stress), 0.5);
  // Steady: (rho g sin a / 2 mu)(H - h_plug)^2, h_plug the depth at which the stress is the yield stress.
  const double steady = floor_stress / depth / (2 * 2) * std::pow(0.7 * depth, 2);
  EXPECT_GT(layer.speed, 0.5);
  EXPECT_LT(layer.speed, steady);
  EXPECT_LT(layer.held, 0.6 * layer.weight);
}

TEST(YieldStress, OfZeroWithIndexOneIsANewtonianLiquidToRounding) {
  FluidModel newtonian;
  newtonian.viscosity = 2;
  const Layer a = on_a_slope(Precision::reference, newtonian, 0.05);
  const Layer b = on_a_slope(Precision::reference, mud(0), 0.05);
  EXPECT_NEAR(a.speed, b.speed, 1e-9 * a.speed);
  EXPECT_NEAR(a.held, b.held, 1e-9 * a.held);
}

}  // namespace
}  // namespace sluice
