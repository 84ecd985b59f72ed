#include "validation/rock_hopper.h"

#include <fmt/format.h>

#include <numbers>

#include "base/errors.h"
#include "base/random.h"
#include "geometry/make_shapes.h"
#include "validation/rock_scenes.h"

namespace sluice {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int sides = 48;

/// Flat ring between an opening and a cylinder, through z = 0.
TriMesh ring(double inner, double outer) {
  TriMesh mesh;
  mesh.part_names = {"floor"};
  for (int k = 0; k < sides; ++k)
    for (const double r : {inner, outer})
      mesh.vertices.emplace_back(r * std::cos(2 * pi * k / sides), r * std::sin(2 * pi * k / sides), 0);
  for (int k = 0; k < sides; ++k) {
    const int a = 2 * k, b = 2 * ((k + 1) % sides);
    mesh.triangles.push_back({a, a + 1, b + 1});
    mesh.triangles.push_back({a, b + 1, b});
    mesh.part.insert(mesh.part.end(), {0, 0});
  }
  return mesh;
}

}  // namespace

void RockHopper::keys(Schema& s) {
  s.number("opening", opening, {.above = 2, .doc = "diameter of the opening over that of a ball"});
  s.number("size", size, {.unit = "m", .above = 0, .doc = "diameter of the balls"});
  s.number("friction", friction, {.at_least = 0, .doc = "Coulomb's coefficient of balls and walls"});
  s.number("bed_openings", bed_openings, {.above = 0, .doc = "height of the fill over the opening"});
  s.number("width_openings", width_openings, {.above = 1, .doc = "width of the cylinder over the opening"});
  s.number("settle", settle, {.unit = "s", .at_least = 0, .doc = "before counting begins"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "for which it is counted"});
}

Measured RockHopper::run(const CsvTable& reference) const {
  const double C = reference_numbers(reference, "C").front(), k = reference_numbers(reference, "k").front();
  const double gap = opening * size, radius = 0.5 * width_openings * gap, height = bed_openings * gap;
  RockSetup setup;
  setup.pair = {0.3, friction, 0};
  setup.smallest = 0.95 * size;
  setup.largest = 1.05 * size;
  setup.stiffness_per_size = 2.3e6;  // 5 % overlap at 1 m/s, faster than anything here
  setup.gravity = {0, 0, -9.81};
  setup.box = {Vec3(-2 * radius, -2 * radius, -4 * size), Vec3(2 * radius, 2 * radius, 3 * height)};
  Wall floor, shell;
  floor.name = "floor";
  floor.mesh = ring(0.5 * gap, 1.05 * radius);
  shell.name = "shell";
  shell.mesh = make_tube("shell", {Vec3(0, 0, 0), Vec3(0, 0, 2 * height), radius, sides, TubeEnds::open});
  floor.material = shell.material = 1;
  RockScene scene(setup, {floor, shell});

  // fill a little loose: it settles to the packing that friction leaves
  Random random(5);
  const double cell = 1.07 * size;
  for (double z = 0.55 * size; z < 1.25 * height; z += cell)
    for (double y = -radius; y < radius; y += cell)
      for (double x = -radius; x < radius; x += cell) {
        const Vec3 at(x + 0.01 * size * random.uniform(-1, 1), y + 0.01 * size * random.uniform(-1, 1), z);
        if (std::hypot(at.x(), at.y()) > radius * std::cos(pi / sides) - 0.55 * size) continue;
        scene.dem->add({.x = at, .size = random.uniform(0.95, 1.05) * size});
      }

  const double dt = scene.dem->step_size();
  const double low = 0.75 * gap, high = 1.5 * gap;  // of the slab in which the bed is weighed
  double left = 0, weighed = 0, looks = 0;
  const auto run_for = [&](double span, bool counted) {
    const auto steps = static_cast<std::int64_t>(std::ceil(span / dt));
    for (std::int64_t n = 0; n < steps; ++n) {
      scene.step(dt);
      if (n % 100 != 0 && n + 1 != steps) continue;
      for (const RemovedRock& rock : scene.dem->remove_outside()) left += counted ? rock.mass : 0;
      if (!counted || n % 1000 != 0) continue;
      for (std::size_t i = 0; i < scene.rocks().count(); ++i)
        if (scene.rocks().x[i].z() >= low && scene.rocks().x[i].z() < high) weighed += scene.mass(i);
      looks += 1;
    }
  };
  run_for(settle, false);
  run_for(seconds, true);
  double top = 0;
  for (const Vec3& x : scene.rocks().x) top = std::max(top, x.z());
  if (top < high)
    throw NumericalError("hopper", scene.t, fmt::format("the bed has fallen to {:.3g} m", top),
                         "raise 'bed_openings' or shorten 'seconds'");
  const double bulk = weighed / looks / (pi * radius * radius * (high - low));
  Measured out;
  out.particle_steps = scene.rock_steps;
  out.values.push_back({fmt::format("discharge over Beverloo's, bulk density {:.0f} kg/m3", bulk),
                        left / seconds / (C * bulk * std::sqrt(9.81) * std::pow(gap - k * size, 2.5)), 1, 1});
  return out;
}

}  // namespace sluice
