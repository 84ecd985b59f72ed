/// Water in the pores of a bed at rest that is denser than it is void.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "coupling/coupling.h"
#include "mpm/mpm_system.h"

namespace sluice {
namespace {

/// A periodic box of held rocks, four to each face-centred cube, and water in a share of their pores.
struct PackedBed {
  static constexpr double size = 0.01, solids = 0.58;

  PackedBed(double saturation, const Vec3& gravity) {
    const double cube = size * std::cbrt(4 * M_PI / 6 / solids), width = 4 * cube;
    domain.box = {Vec3::Zero(), Vec3::Constant(width)};
    domain.low = domain.high = {Face::periodic, Face::periodic, Face::periodic};
    MpmConfig mpm;
    mpm.spacing = width / 8;
    mpm.fastest_bulk_speed = 1;
    water = make_mpm(mpm, domain, gravity, walls);
    Random random(3);
    const double step = mpm.spacing / 2;
    for (double z = step / 2; z < width; z += step)
      for (double y = step / 2; y < width; y += step)
        for (double x = step / 2; x < width; x += step) {
          NewPoint p;
          for (int k = 0; k < 3; ++k) p.x[k] = Vec3(x, y, z)[k] + random.uniform(-0.1, 0.1) * step;
          p.mass = 1000 * std::pow(step, 3) * (1 - solids) * saturation;
          water->add(p);
        }

    DemScene scene;
    scene.materials.all = {{"rock", 1e7}};
    scene.materials.pairs = {PairProperties{}};
    scene.shapes = {make_sphere()};
    scene.domain = domain;
    scene.smallest_size = scene.largest_size = size;
    scene.densest = 1e7;
    DemConfig dem;
    dem.impact_speed = 1;
    rocks = std::make_unique<DemSystem>(dem, scene, walls);
    for (int i = 0; i < 64; ++i)
      for (const Vec3& corner :
           {Vec3(0.25, 0.25, 0.25), Vec3(0.75, 0.75, 0.25), Vec3(0.75, 0.25, 0.75), Vec3(0.25, 0.75, 0.75)})
        rocks->add({.x = cube * (Vec3(i % 4, i / 4 % 4, i / 16) + corner), .size = size});
    coupling = std::make_unique<Coupling>(CouplingConfig{}, domain, gravity, *rocks, *water);
  }

  void run(int steps) {
    const double dt = water->limits().step;
    for (int n = 0; n < steps; ++n) {
      coupling->solids_to_grid();
      water->points_to_grid(n * dt, dt);
      coupling->drag(dt);
      water->walls(dt);
      water->grid_to_points(dt);
      coupling->fluid_to_grid(dt);
    }
  }
  double mean_wetted() const {
    const std::vector<double>& each = coupling->wetted_fraction();
    return std::accumulate(each.begin(), each.end(), 0.0) / static_cast<double>(each.size());
  }

  Domain domain;
  Walls walls;
  std::unique_ptr<FluidSystem> water;
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<Coupling> coupling;
};

// The share that is wet and the space that wet rocks leave free follow from each other: in a bed this dense
// w = (1 - phi) / phi would satisfy that, too.
TEST(PackedBed, IsWhollyWetWhereWaterFillsItsPores) {
  PackedBed bed(1, Vec3(1, 0, 0));
  bed.run(100);
  EXPECT_NEAR(bed.mean_wetted(), 1, 0.03);
}

TEST(PackedBed, IsWetByTheShareOfItsPoresThatWaterFills) {
  for (double saturation : {0.25, 0.6}) {
    PackedBed bed(saturation, Vec3::Zero());
    bed.run(20);
    EXPECT_NEAR(bed.mean_wetted(), saturation, 0.02);
  }
}

TEST(PackedBed, LetsWaterReplaceItsAirWithoutPressure) {
  PackedBed bed(0.6, Vec3::Zero());
  bed.run(200);
  const WaterPoints points = bed.water->points();
  EXPECT_EQ(*std::max_element(points.pressure.begin(), points.pressure.end()), 0);
  EXPECT_EQ(bed.water->largest_speed(), 0);
}

}  // namespace
}  // namespace sluice
