#include "validation/rock_bed_energy.h"

#include "base/random.h"
#include "base/statistics.h"
#include "validation/rock_scenes.h"

namespace sluice {

void RockBedEnergy::keys(Schema& s) {
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.integer("steps_at_30", steps_at_30,
            {.at_least = 1000, .doc = "length of the run in steps of 30 a contact, whatever the rung"});
  s.integer("rocks_along", rocks_along, {.at_least = 2, .doc = "rocks along each edge at the start"});
  s.number("blockiness", blockiness, {.at_least = 2, .at_most = 16, .doc = "2 is a ball"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "of each rock at the start"});
}

Measured RockBedEnergy::run(const CsvTable& reference) const {
  const double expected = reference_numbers(reference, "energy_ratio").front();
  RockSetup setup;
  setup.pair = {1, 0, 0};
  setup.gravity = {0, 0, -9.81};
  if (blockiness > 2) setup.shapes = {make_superquadric(1, 1, blockiness)};
  const double reach = 2 * setup.largest * setup.shapes[0].bounding_radius;
  const double cell = 1.05 * reach, edge = cell * static_cast<double>(rocks_along);
  RockScene scene(setup, {box_wall(setup, {Vec3::Zero(), Vec3(edge, edge, 1.5 * edge)})});
  Random random(11);
  for (int k = 0; k < rocks_along; ++k)
    for (int j = 0; j < rocks_along; ++j)
      for (int i = 0; i < rocks_along; ++i)
        scene.dem->add({.x = cell * Vec3(i + 0.5, j + 0.5, k + 0.5),
                        .v = speed * random.on_sphere(),
                        .q = blockiness > 2 ? random.rotation() : Quat::Identity(),
                        .size = setup.largest});
  const double contact = scene.dem->limits().contact_time;
  const double dt = contact / steps_per_contact;
  const auto steps = static_cast<std::int64_t>(static_cast<double>(steps_at_30) * steps_per_contact / 30);
  const std::int64_t every = std::max<std::int64_t>(1, steps / 1000);
  const auto total = [&] {
    const DemEnergy e = scene.dem->energy();
    return e.kinetic + e.elastic + e.potential;
  };
  const double start = total();
  std::vector<double> gain, kinetic;
  for (std::int64_t n = 1; n <= steps; ++n) {
    scene.step(dt);
    if (n % every != 0 || n < steps / 10) continue;
    gain.push_back(total() - start);
    kinetic.push_back(scene.dem->energy().kinetic);
  }
  const double scale = mean(kinetic);
  const std::size_t tenth = std::max<std::size_t>(1, gain.size() / 10);
  const std::vector<double> first(gain.begin(), gain.begin() + static_cast<std::ptrdiff_t>(tenth));
  const std::vector<double> last(gain.end() - static_cast<std::ptrdiff_t>(tenth), gain.end());
  Measured out;
  out.particle_steps = scene.rock_steps;
  out.values.push_back({"1 + mean energy gained over kinetic", 1 + mean(gain) / scale, expected, 1});
  out.values.push_back({"1 + energy gained from first to last tenth over kinetic",
                        1 + (mean(last) - mean(first)) / scale, expected, 1});
  return out;
}

}  // namespace sluice
