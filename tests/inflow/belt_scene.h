#pragma once
/// A level belt with rocks: for the tests of feeds and fills.

#include <memory>

#include "dem/dem_system.h"
#include "inflow/inflow.h"

namespace sluice::test {

/// Belt on z = 0 from x = -2 to 3 m, 1.2 m wide; one kind of rock.
struct BeltScene {
  Walls walls;
  std::unique_ptr<DemSystem> rocks;
  Domain domain;

  BeltScene(double smallest, double largest, double belt_speed,
            std::vector<RockShape> shapes = {make_sphere()})
      : walls(belt(belt_speed)) {
    domain.box = {Vec3(-2, -2, -1), Vec3(3, 2, 3)};
    DemScene scene;
    scene.materials.all = {{"belt", 0}, {"ore", 2700}};
    scene.materials.pairs.assign(4, {.restitution = 0.2, .friction = 0.7});
    scene.shapes = std::move(shapes);
    scene.domain = domain;
    scene.smallest_size = smallest;
    scene.largest_size = largest;
    scene.densest = 2700;
    rocks = std::make_unique<DemSystem>(DemConfig{}, scene, walls);
  }

  InflowTarget target() {
    InflowTarget t;
    t.rocks = rocks.get();
    t.domain = domain;
    t.seed = 11;
    t.index = 3;
    return t;
  }

 private:
  static Walls belt(double speed) {
    Wall wall;
    wall.name = "belt";
    wall.mesh =
        make_rectangle("belt", {Vec3(-2, -0.6, 0), Vec3(3, -0.6, 0), Vec3(3, 0.6, 0), Vec3(-2, 0.6, 0)});
    wall.surface_velocity = Vec3(speed, 0, 0);
    std::vector<Wall> all;
    all.push_back(std::move(wall));
    return Walls(std::move(all));
  }
};

}  // namespace sluice::test
