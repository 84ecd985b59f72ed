#pragma once

#include <cmath>

#include "coupling/coupling.h"
#include "mpm/mpm_system.h"

namespace sluice {

inline const Vec3 gravity(0, 0, -9.81);

struct PoolRocks {
  double size = 0.01;     ///< largest [m]
  double density = 2650;  ///< [kg/m3]
  RockShape shape = make_sphere();
  WallSlip wall_slip = WallSlip::turbulent_film;
  Precision precision = Precision::single;
};

/// A column of water on a floor, periodic sideways, with rocks in it.
struct Pool {
  Pool(double width, double depth, double spacing, const PoolRocks& of, const CouplingConfig& config) {
    domain.box = {Vec3::Zero(), Vec3(width, width, depth + 8 * spacing)};
    domain.low = {Face::periodic, Face::periodic, Face::wall};
    domain.high = {Face::periodic, Face::periodic, Face::open};
    Wall floor;
    floor.name = "floor";
    const double e = width;  // beyond the periodic faces
    floor.mesh = make_rectangle("floor", {Vec3(-e, -e, 0), Vec3(width + e, -e, 0),
                                          Vec3(width + e, width + e, 0), Vec3(-e, width + e, 0)});
    walls = Walls({floor});
    MpmConfig mpm;
    mpm.spacing = spacing;
    mpm.fastest_bulk_speed = 1;
    mpm.deepest = depth;
    mpm.wall_slip = of.wall_slip;
    mpm.precision = of.precision;
    water = make_mpm(mpm, domain, gravity, walls);
    fill(depth);

    DemScene scene;
    scene.materials.all = {{"rock", of.density}};
    scene.materials.pairs = {PairProperties{}};
    scene.shapes = {of.shape};
    scene.domain = domain;
    scene.gravity = gravity;
    scene.smallest_size = scene.largest_size = of.size;
    scene.densest = of.density;
    DemConfig dem;
    dem.impact_speed = 1;
    rocks = std::make_unique<DemSystem>(dem, scene, walls);
    coupling = std::make_unique<Coupling>(config, domain, gravity, *rocks, *water);
  }

  void fill(double depth) {
    const double step = water->spacing() / 2;
    const double c = water->limits().sound_speed;
    for (double z = step / 2; z < depth; z += step)
      for (double y = step / 2; y < domain.box.hi.y(); y += step)
        for (double x = step / 2; x < domain.box.hi.x(); x += step) {
          NewPoint p;
          p.x = {x, y, z};
          p.J = std::exp(-9.81 * (depth - z) / (c * c));
          p.mass = water->model().density * water->point_volume() / p.J;
          water->add(p);
        }
  }

  enum class Rocks { held, falling };
  /// A step of the coupling, in which the water makes `water_steps` of its own.
  void step(Rocks how, int water_steps = 1) {
    const double of_water = water->limits().step, dt = water_steps * of_water;
    coupling->solids_to_grid();
    for (int k = 0; k < water_steps; ++k) {
      if (coupling->resolves()) coupling->place_resolved(dt, k, water_steps);
      water->points_to_grid(t + k * of_water, of_water);
      if (k == 0) coupling->drag(dt);
      water->walls(of_water);
      water->grid_to_points(of_water);
      if (k == 0) coupling->fluid_to_grid(of_water);
      if (coupling->resolves()) coupling->take_resolved(dt, k, water_steps);
    }
    const int n = static_cast<int>(std::ceil(dt / rocks->step_size()));
    for (int k = 0; how == Rocks::falling && k < n; ++k) rocks->step(t + k * dt / n, dt / n);
    t += dt;
  }

  /// Mean height of the points, which is half the depth of a level pool [m].
  double centroid() const {
    const WaterPoints p = water->points();
    double moment = 0, mass = 0;
    for (std::size_t i = 0; i < p.count(); ++i) {
      moment += p.mass[i] * p.x[i].z();
      mass += p.mass[i];
    }
    return moment / mass;
  }

  Domain domain;
  Walls walls;
  std::unique_ptr<FluidSystem> water;
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<Coupling> coupling;
  double t = 0;
};

}  // namespace sluice
