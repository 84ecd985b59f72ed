#include "validation/water_scenes.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace sluice {

WaterScene::WaterScene(const WaterSetup& setup, std::vector<Wall> all)
    : walls(std::move(all)), water(make_mpm(setup.config, setup.domain, setup.gravity, walls)) {}

void WaterScene::fill(const WaterFill& fill) {
  const double distance = std::cbrt(water->point_volume()), c = water->limits().sound_speed;
  const double density = water->model().density;
  Random random(7);
  const Vec3 size = fill.box.size();
  const Vec3i n = (size / distance).array().round().cast<int>();
  const Vec3 step = size.array() / n.cast<double>().array();
  for (int k = 0; k < n.z(); ++k)
    for (int j = 0; j < n.y(); ++j)
      for (int i = 0; i < n.x(); ++i) {
        NewPoint p;
        p.x = fill.box.lo + Vec3((i + 0.5) * step.x(), (j + 0.5) * step.y(), (k + 0.5) * step.z());
        p.J = 1 / (1 + fill.pressure(p.x) / (density * c * c));
        p.v = fill.velocity(p.x);
        p.mass = density * step.prod() / p.J;
        for (int r = 0; r < 3; ++r) p.x[r] += fill.jitter * step[r] * random.uniform(-1.0, 1.0);
        water->add(p);
      }
}

void WaterScene::step(const std::function<void()>& look) {
  const double dt = water->limits().step;
  water->points_to_grid(t, dt);
  if (look) look();
  water->walls(dt);
  water->grid_to_points(dt);
  t += dt;
  point_steps += static_cast<double>(water->count());
}

void WaterScene::run_to(double time) {
  while (t < time - 0.5 * water->limits().step) step();
}

Wall sheet(const char* name, const std::array<Vec3, 4>& corners) {
  Wall wall;
  wall.name = name;
  wall.mesh = make_rectangle(name, corners);
  return wall;
}

std::vector<Wall> trough(double length, double width, double top, double beyond) {
  std::vector<Wall> walls;
  walls.push_back(sheet("floor", {Vec3(-beyond, -width, 0), Vec3(length + beyond, -width, 0),
                                  Vec3(length + beyond, 2 * width, 0), Vec3(-beyond, 2 * width, 0)}));
  for (const double x : {0.0, length})
    walls.push_back(sheet("end", {Vec3(x, -width, -beyond), Vec3(x, 2 * width, -beyond),
                                  Vec3(x, 2 * width, top), Vec3(x, -width, top)}));
  return walls;
}

Domain water_domain(const Box& box, std::array<bool, 3> periodic) {
  Domain domain;
  domain.box = box;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (periodic[axis]) domain.low[axis] = domain.high[axis] = Face::periodic;
  return domain;
}

double still_pressure(double density, double gravity, double sound_speed, double depth) {
  return density * sound_speed * sound_speed * std::expm1(gravity * depth / (sound_speed * sound_speed));
}

}  // namespace sluice
