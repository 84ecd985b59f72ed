/// Where water accelerates, nodes pull less at its points: a slot of two cells lets it through, and what
/// walls and gravity give is all the momentum there is.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "mpm/water_scenes.h"

namespace sluice {
namespace {

const Vec3 gravity(0, 0, -9.81);
constexpr double h = 0.01, width = 16 * h, depth = 12 * h, slot = 2 * h;

Wall rectangle(const std::string& name, const std::array<Vec3, 4>& corners) {
  Wall wall;
  wall.name = name;
  wall.mesh = make_rectangle(name, corners);
  return wall;
}

/// A tank with a slot of two cells in the middle of its floor, three cells thick and periodic.
Walls tank_with_slot() {
  const double off = 0.05, middle = width / 2;
  const auto floor_part = [&](const std::string& name, double from, double to) {
    return rectangle(name, {Vec3(from, -off, 0), Vec3(to, -off, 0), Vec3(to, off, 0), Vec3(from, off, 0)});
  };
  const auto side = [&](const std::string& name, double x) {
    return rectangle(
        name, {Vec3(x, -off, -off), Vec3(x, off, -off), Vec3(x, off, 2 * depth), Vec3(x, -off, 2 * depth)});
  };
  std::vector<Wall> parts;
  parts.push_back(floor_part("floor below left", -off, middle - slot / 2));
  parts.push_back(floor_part("floor below right", middle + slot / 2, width + off));
  parts.push_back(side("left", 0));
  parts.push_back(side("right", width));
  return Walls(std::move(parts));
}

struct SlotRun {
  double coefficient = 0;   ///< of discharge, from 0.05 to 0.12 s
  double momentum_gap = 0;  ///< over the sum of all impulses
};

SlotRun run_slot(Precision precision) {
  const Walls walls = tank_with_slot();
  Domain domain = open_box(Vec3(-2 * h, 0, -0.4), Vec3(width + 2 * h, 3 * h, depth + 4 * h));
  make_periodic(domain, 1);
  MpmConfig config;
  config.spacing = h;
  config.deepest = depth;
  config.fastest_bulk_speed = 2;
  config.wall_slip = WallSlip::slip;
  config.precision = precision;
  const auto water = make_mpm(config, domain, gravity, walls);
  const double c = water->limits().sound_speed;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(width, 3 * h, depth)};
  fill.J = [&](const Vec3& x) { return 1 / (1 + 9.81 * (depth - x.z()) / (c * c)); };
  fill_with_water(*water, h / 2, fill);

  const double start = water->total_mass(), dt = water->limits().step, from = 0.05, to = 0.12;
  const auto inside = [&] {
    const WaterPoints points = water->points();
    double mass = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
      if (points.x[i].z() > 0) mass += points.mass[i];
    return mass;
  };
  SlotRun out;
  double before = 0, share = 1, ideal = 0;
  for (int n = 0; n * dt < to; ++n) {
    if (n * dt >= from) {
      if (before == 0) before = inside();
      if (n % 20 == 0) share = inside() / start;  // of the level
      ideal += dt * water->model().density * slot * 3 * h * std::sqrt(2 * 9.81 * depth * share);
    }
    step_water(*water, n * dt, dt);
  }
  out.coefficient = (before - inside()) / ideal;
  Vec3 loads = Vec3::Zero();
  double sum = water->impulse_from_gravity().norm();
  for (const WallLoad& load : water->wall_loads()) {
    loads += load.impulse;
    sum += load.impulse.norm();
  }
  out.momentum_gap = (water->momentum() + loads - water->impulse_from_gravity()).norm() / sum;
  return out;
}

// Kirchhoff (1869): pi / (pi + 2) of the ideal flow; the lips stand on nodes, which is where a slot of two
// cells is narrowest.
TEST(Slot, OfTwoCellsPassesThreeFifthsOfTheContractedJet) {
  const double contracted = std::numbers::pi / (std::numbers::pi + 2);
  const SlotRun run = run_slot(Precision::single);
  EXPECT_GT(run.coefficient, 0.6 * contracted);
  EXPECT_LT(run.coefficient, contracted);
  EXPECT_LT(run.momentum_gap, 1e-5);
}

TEST(Slot, LeavesMomentumClosedInTheReference) {
  EXPECT_LT(run_slot(Precision::reference).momentum_gap, 1e-12);
}

}  // namespace
}  // namespace sluice
