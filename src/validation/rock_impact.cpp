#include "validation/rock_impact.h"

#include "base/errors.h"
#include "dem/hertz_mindlin.h"

namespace sluice {

namespace {

constexpr double rigid_modulus = 1e30;    // [Pa]
constexpr double longest_contact = 1000;  // in contacts without damping

}  // namespace

Impact impact_of(const ImpactSphere& sphere, const Vec3& v, ImpactAgainst against, double steps_per_contact) {
  const bool twin = against == ImpactAgainst::twin;
  RockSetup setup;
  setup.rocks = {sphere.material};
  setup.wall = {"rigid plane", 0, rigid_modulus, 0.3};
  setup.pair = {sphere.restitution, sphere.friction, 0, ForceLaw::hertz_mindlin, sphere.tangential};
  setup.smallest = setup.largest = 2 * sphere.radius;
  std::vector<Wall> walls;
  if (!twin) walls.push_back(level_wall(setup, 0, 1000 * sphere.radius));
  RockScene scene(setup, walls);

  // half a step before the first touch
  const double mass = scene.dem->mass_of(0, 0, setup.largest), closing = (twin ? 2 : 1) * -v.z();
  const ContactLaw law = contact_law(scene.dem->materials(), 0, twin ? 0 : 1, setup.end);
  const Indentation at{0, twin ? sphere.radius / 2 : sphere.radius, twin ? mass / 2 : mass};
  const double dt = hertz_contact_time(law, at, closing, setup.end) / steps_per_contact;
  scene.dem->add({.x = {0, 0, sphere.radius - 0.5 * v.z() * dt}, .v = v, .size = setup.largest});
  if (twin) scene.dem->add({.x = {0, 0, -sphere.radius + 0.5 * v.z() * dt}, .v = -v, .size = setup.largest});

  const auto overlap = [&] {
    const Rocks& rocks = scene.rocks();
    return twin ? 2 * sphere.radius - (rocks.x[0] - rocks.x[1]).norm() : sphere.radius - rocks.x[0].z();
  };
  Impact impact;
  double before = overlap();
  while (impact.t.empty() || before > 0) {
    if (static_cast<double>(impact.t.size()) > longest_contact * steps_per_contact)
      throw NumericalError("impact", scene.t, "the contact does not end", "raise 'steps_per_contact'");
    const double v_before = scene.rocks().v[0].z();
    scene.step(dt);
    impact.t.push_back(scene.t - dt);
    impact.overlap.push_back(0.5 * (before + overlap()));
    impact.force.push_back(mass * (scene.rocks().v[0].z() - v_before) / dt);
    before = overlap();
  }
  // the rest of the last half kick
  scene.step(dt);
  impact.v = scene.rocks().v[0];
  impact.w = scene.rocks().w[0];
  impact.contact_time = scene.t - 0.5 * dt + overlap() / ((twin ? 2 : 1) * impact.v.z());
  impact.rock_steps = scene.rock_steps;
  return impact;
}

}  // namespace sluice
