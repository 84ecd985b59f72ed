/// Water without slip: what viscosity does beside walls, wherever they stand to the grid.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mpm/water_scenes.h"

namespace sluice {
namespace {

constexpr double h = 0.02;        ///< [m]
constexpr double strip = 4 * h;   ///< length of the scenes along their flow, y, which is periodic [m]
constexpr double density = 1000;  ///< of clear water [kg/m3]

/// A section in x and z, turned about y and moved from the grid's nodes.
struct Section {
  double degrees = 0;
  double x = 0, z = 0;  ///< of its origin [cells]

  Vec3 axis(double quarter_turns) const {
    const double angle = degrees * std::numbers::pi / 180 + quarter_turns * std::numbers::pi / 2;
    return {std::cos(angle), 0, std::sin(angle)};
  }
  Vec3 origin() const { return {h * x, 0, h * z}; }
  Vec3 place(double along, double up, double y) const {
    return origin() + along * axis(0) + up * axis(1) + Vec3(0, y, 0);
  }
  double along(const Vec3& at) const { return (at - origin()).dot(axis(0)); }
  double up(const Vec3& at) const { return (at - origin()).dot(axis(1)); }

  /// A wall along y between two places of the section, and its speed along y.
  Wall wall(std::array<double, 2> from, std::array<double, 2> to, double speed = 0) const {
    const double below = -strip, above = 2 * strip;  // beyond the periodic faces
    Wall wall;
    wall.name = "wall";
    wall.mesh = make_rectangle("wall", {place(from[0], from[1], below), place(to[0], to[1], below),
                                        place(to[0], to[1], above), place(from[0], from[1], above)});
    wall.surface_velocity = {0, speed, 0};
    return wall;
  }
};

struct Liquid {
  double viscosity = 1;    ///< without fines [Pa s]
  double fines = 0;        ///< by volume
  double sound_speed = 1;  ///< [m/s]
};

MpmConfig without_slip(const Liquid& liquid) {
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 0.1 * liquid.sound_speed;
  config.wall_slip = WallSlip::no_slip;
  config.keep_tension = true;
  config.fluid.viscosity = liquid.viscosity;
  return config;
}

Domain strip_of(double half_width) {
  Domain domain = open_box(Vec3(-half_width, 0, -half_width), Vec3(half_width, strip, half_width));
  make_periodic(domain, 1);
  return domain;
}

/// Fills part of a section, points half a cell apart, with a speed along y.
void fill_section(
    FluidSystem& water, const Section& section, const Box& part, double fines = 0,
    const std::function<double(double up)>& speed = [](double) { return 0.0; }) {
  const FluidModel& model = water.model();
  const double step = h / 2, volume = step * step * step;
  for (double up = part.lo.z() + step / 2; up < part.hi.z(); up += step)
    for (double along = part.lo.x() + step / 2; along < part.hi.x(); along += step)
      for (double y = step / 2; y < strip; y += step) {
        NewPoint p;
        p.x = section.place(along, up, y);
        p.v = {0, speed(up), 0};
        p.mass = slurry_density(model, fines) * volume;
        p.fines_mass = fines * model.fines_density * volume;
        water.add(p);
      }
}

void run_to(FluidSystem& water, double& t, double end) {
  for (const double dt = water.limits().step; t < end; t += dt) step_water(water, t, dt);
}

struct Sheared {
  double worst = 0;  ///< departure of a point's speed from the line, over the plates' speed
  double force = 0;  ///< on the sheet in the middle, over 2 mu U A / H
};

/// A sheet at rest between two plates, four cells away, that move along y: |v| is a straight line on either
/// side. The ends of the section are free surfaces, which such a flow does not shear.
Sheared sheared(const Section& section, const Liquid& liquid) {
  const double height = 4 * h, half = 6 * h, wide = 8 * h, speed = 0.05 * liquid.sound_speed;
  std::vector<Wall> parts;
  parts.push_back(section.wall({-wide, 0}, {wide, 0}));
  for (const double plate : {-height, height})
    parts.push_back(section.wall({-wide, plate}, {wide, plate}, speed));
  const Walls walls(std::move(parts));
  auto water = make_mpm(without_slip(liquid), strip_of(12 * h), Vec3::Zero(), walls);
  for (const double lo : {-height, 0.0})
    fill_section(*water, section, {Vec3(-half, 0, lo), Vec3(half, strip, lo + height)}, liquid.fines,
                 [&](double up) { return speed * std::abs(up) / height; });
  const double viscosity = slurry_viscosity(water->model(), liquid.fines);
  const double end = h * h * density / viscosity;
  double t = 0;
  run_to(*water, t, end / 2);
  const double from = t, before = water->wall_loads()[0].impulse.y();
  run_to(*water, t, end);
  Sheared result;
  result.force = (water->wall_loads()[0].impulse.y() - before) / (t - from) /
                 (2 * viscosity * speed / height * 2 * half * strip);
  const WaterPoints points = water->points();
  for (std::size_t i = 0; i < points.count(); ++i) {
    if (std::abs(section.along(points.x[i])) > half - 3 * h) continue;
    const double line = speed * std::abs(section.up(points.x[i])) / height;
    result.worst = std::max(result.worst, std::abs(points.v[i].y() - line) / speed);
  }
  return result;
}

// A wall that acts a tenth of a cell off its place is off by 2.5 % here.
TEST(LinearShear, StaysALineOnBothSidesOfASheetWhereverItStands) {
  for (const Section& section : std::vector<Section>{{0, 0, 0},
                                                     {0, 0.3, 0.1},
                                                     {0, 0, 0.25},
                                                     {0, 0.1, 0.5},
                                                     {0, 0, 0.77},
                                                     {17, 0.2, 0.3},
                                                     {45, 0.4, 0.15},
                                                     {90, 0.6, 0}}) {
    const Sheared result = sheared(section, {});
    EXPECT_LT(result.worst, 0.004) << section.degrees << " degrees, " << section.z << " cells";
    EXPECT_NEAR(result.force, 1.0, 0.02) << section.degrees << " degrees, " << section.z << " cells";
  }
}

// The wall's stress is the slurry's: at 0.3 fines by volume 2.8 times that of its liquid.
TEST(LinearShear, OfSlurryPullsWithTheSlurrysViscosity) {
  EXPECT_NEAR(sheared({17, 0.2, 0.3}, {.fines = 0.3}).force, 1.0, 0.02);
}

// Twenty times the steps: what the transfers do by themselves must not bend the line either. (The free ends
// are pulled by the transfers, so nothing is said of the force.)
TEST(LinearShear, StaysALineWithHardlyAnyViscosityPerStep) {
  for (const Section& section : std::vector<Section>{{0, 0.3, 0.1}, {17, 0.2, 0.3}, {45, 0.4, 0.15}})
    EXPECT_LT(sheared(section, {.sound_speed = 20}).worst, 0.01) << section.degrees << " degrees";
}

// Square duct of 8 cells. Mean speed g a2 / (12 nu) (1 - 192 / pi5 sum tanh(n pi / 2) / n5, n odd)
// = 0.0351443 g a2 / nu.
TEST(Duct, CarriesAsMuchAsItsSeriesSaysWhereverItStands) {
  const double half = 4 * h, side = 2 * half, nu = 0.02, exact = 0.05;
  const double g = exact * nu / (0.0351443 * side * side);
  for (const Section& section :
       std::vector<Section>{{0, 0, 0}, {0, 0.3, 0.4}, {17, 0.3, 0.4}, {45, 0.3, 0.4}}) {
    std::vector<Wall> parts;
    for (const double at : {-half, half}) {
      parts.push_back(section.wall({-half, at}, {half, at}));
      parts.push_back(section.wall({at, -half}, {at, half}));
    }
    const Walls walls(std::move(parts));
    auto water = make_mpm(without_slip({.viscosity = nu * density}), strip_of(8 * h), Vec3(0, g, 0), walls);
    fill_section(*water, section, {Vec3(-half, 0, -half), Vec3(half, strip, half)});
    double t = 0;
    run_to(*water, t, 0.6 * side * side / nu);
    EXPECT_NEAR(water->momentum().y() / water->total_mass() / exact, 1.0, 0.03)
        << section.degrees << " degrees, " << section.z << " cells";
  }
}

/// Mean speed of a layer at rest that a plate below moves from t = 0 on, over the plate's: Fourier series.
/// @param tau  nu t / depth^2
double carried(double tau) {
  double mean = 1;
  for (int n = 1; n < 200; n += 2) {
    const double k = n * std::numbers::pi / 2;
    mean -= 2 / (k * k) * std::exp(-k * k * tau);
  }
  return mean;
}

// At the start the sheared layer is thinner than a cell, and the nodes at the belt carry too much: a third of
// a cell of water at the belt's speed. It is not lost, so it counts less and less.
TEST(BeltWithoutSlip, CarriesALayerAsViscosityDoes) {
  const double depth = 5 * h, nu = 0.02, speed = 0.5;
  Domain domain = open_box(Vec3(0, 0, -2 * h), Vec3(strip, strip, depth + 4 * h));
  make_periodic(domain, 0);
  make_periodic(domain, 1);
  const Section section;
  std::vector<Wall> parts;
  parts.push_back(section.wall({-strip, 0}, {2 * strip, 0}, speed));
  const Walls walls(std::move(parts));
  MpmConfig config = without_slip({.viscosity = nu * density});
  config.fastest_bulk_speed = speed;
  config.deepest = depth;
  config.keep_tension = false;
  const Vec3 gravity(0, 0, -9.81);
  auto water = make_mpm(config, domain, gravity, walls);
  fill_section(*water, section, {Vec3(0, 0, 0), Vec3(strip, strip, depth)});
  const double dt = water->limits().step;
  double t = 0;
  struct Moment {
    double tau, tolerance;
  };
  for (const Moment moment : {Moment{0.03, 0.35 * h / depth}, {0.1, 0.03}, {0.3, 0.02}, {1, 0.005}}) {
    run_to(*water, t, moment.tau * depth * depth / nu);
    const double mean = water->momentum().y() / water->total_mass() / speed;
    EXPECT_NEAR(mean, carried(nu * t / (depth * depth)), moment.tolerance) << "nu t / H2 = " << moment.tau;
    // float sums: 1e-6 of what was handed over per 1000 steps, the weight and the belt's momentum
    EXPECT_NEAR(water->wall_loads()[0].impulse.y(), -water->momentum().y(),
                1e-9 * t / dt * water->total_mass() * (9.81 * t + speed));
  }
}

}  // namespace
}  // namespace sluice
