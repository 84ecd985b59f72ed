#include "validation/coupling_bed.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "validation/coupling_scenes.h"

namespace sluice {

namespace {

/// Held rocks: so heavy that drag does not move them within a step [kg/m3].
constexpr double held_density = 1e7;

struct Bed {
  double diameter, void_fraction, drive;
  double volume() const { return std::numbers::pi / 6 * std::pow(diameter, 3); }
  /// Edge of a face-centred cube, which has four rocks [m].
  double cube() const { return std::cbrt(4 * volume() / (1 - void_fraction)); }
};

// Water that leaves the rocks' share of the space free: points on a lattice, each with eps times its volume.
void fill_between(WaterScene& scene, const Bed& bed, double width, double h) {
  const auto n = static_cast<std::int64_t>(std::llround(2 * width / h));
  Random random(2);
  for (std::int64_t i = 0; i < n * n * n; ++i) {
    NewPoint point;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t place = k == 0 ? i % n : k == 1 ? i / n % n : i / (n * n);
      point.x[k] = 0.5 * h * (static_cast<double>(place) + 0.5 + random.uniform(-0.1, 0.1));
    }
    point.mass = scene.water->model().density * std::pow(0.5 * h, 3) * bed.void_fraction;
    scene.water->add(point);
  }
}

void pack(DemSystem& rocks, const Bed& bed, std::int64_t cubes) {
  Random random(5);
  const Vec3 corner[4] = {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};
  for (std::int64_t i = 0; i < cubes * cubes * cubes; ++i)
    for (const Vec3& c : corner) {
      const Vec3 cube(static_cast<double>(i % cubes), static_cast<double>(i / cubes % cubes),
                      static_cast<double>(i / (cubes * cubes)));
      rocks.add(
          {.x = bed.cube() * (cube + c) + 0.03 * bed.diameter * random.on_sphere(), .size = bed.diameter});
    }
}

}  // namespace

void CouplingBed::keys(Schema& s) {
  s.integer("cells", cells, {.at_least = 4, .doc = "of the water's grid along the box"});
  s.choice("read", read, {{"speed", BedReading::speed}, {"drag", BedReading::drag}},
           {.doc = "superficial speed of the water, or drag per rock"});
  s.choice("drag", drag, drag_models, {.doc = "law of drag"});
  s.integer("lattice_cells", lattice_cells, {.at_least = 3, .doc = "cubes of four rocks along the box"});
  s.number("seconds", seconds, {.unit = "s", .above = 0, .doc = "of flow, the last fifth is read"});
}

Measured CouplingBed::run(const CsvTable& reference) const {
  const std::vector<double> diameter = reference_numbers(reference, "diameter");
  const std::vector<double> void_fraction = reference_numbers(reference, "void_fraction");
  const std::vector<double> drive = reference_numbers(reference, "drive");
  const std::vector<double> expected =
      reference_numbers(reference, read == BedReading::speed ? "speed" : "drag");
  Measured out;
  for (std::size_t k = 0; k < diameter.size(); ++k) {
    const Bed bed{diameter[k], void_fraction[k], drive[k]};
    const double width = static_cast<double>(lattice_cells) * bed.cube();
    const double h = width / static_cast<double>(cells);
    ImmersedSetup setup;
    setup.rock_density = held_density;
    setup.rock_size = bed.diameter;
    setup.coupling.drag = drag;
    setup.water.config.spacing = h;
    setup.water.config.fastest_bulk_speed = 1;
    setup.water.gravity = {bed.drive, 0, 0};
    setup.water.domain = water_domain({Vec3::Zero(), Vec3::Constant(width)}, {true, true, true});
    ImmersedScene scene(setup, {});
    fill_between(scene.fluid, bed, width, h);
    pack(*scene.rocks, bed, lattice_cells);
    const double dt = scene.fluid.water->limits().step;
    double sum = 0, looks = 0;
    while (scene.fluid.t < seconds) {
      scene.coupling->solids_to_grid();
      scene.fluid.step([&] { scene.coupling->drag(dt); });
      scene.coupling->fluid_to_grid(dt);
      if (scene.fluid.t < 0.8 * seconds) continue;
      looks += 1;
      if (read == BedReading::speed) {
        sum += bed.void_fraction * scene.fluid.water->momentum().x() / scene.fluid.water->total_mass();
      } else {
        double drag_on_all = 0;
        for (const Vec3& one : scene.coupling->drag_force()) drag_on_all += one.x();
        sum += drag_on_all / static_cast<double>(scene.rocks->rocks().count());
      }
    }
    out.particle_steps += scene.fluid.point_steps;
    out.values.push_back(
        {fmt::format("{}, d = {} mm, {:.0f} % void",
                     read == BedReading::speed ? "superficial speed [m/s]" : "drag per rock [N]",
                     1e3 * bed.diameter, 100 * bed.void_fraction),
         sum / looks, expected[k], expected[k]});
  }
  return out;
}

}  // namespace sluice
