#include "processes/foresee.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/time_step.h"

namespace sluice {

namespace {

constexpr double wide_sizes = 20;          ///< largest over smallest rock from which the step is worth a word
constexpr double wide_densities = 100;     ///< likewise
constexpr double costly = 4;               ///< steps shorter by this factor than another setting allows
constexpr double soft_overlap = 0.15;      ///< of the radius: impacts last and reach visibly too long
constexpr double long_step = 0.5;          ///< of the critical step: half the margin of stability is gone
constexpr double few_steps = 15;           ///< in a contact: restitution is off by up to 5 % (risk 11)
constexpr double most_mach = 0.32;         ///< v/c at which a run stops: density 5 % off
constexpr double weak_sound = 0.1 * 1.05;  ///< v/c of the rule, with its rounding
constexpr double many_steps = 1e7;
constexpr double fewest_cells = 4;  ///< across a channel, for its pressure

class Foresight {
 public:
  Foresight(const ProcessConfig& config, const Parts& parts) : config_(config), parts_(parts) {}
  std::vector<std::string> take() {
    if (parts_.rocks) {
      spread_of_rocks();
      stiffness();
      rock_step();
      rock_speed();
    }
    if (parts_.water) {
      sound();
      jets();
      viscosity();
      slurry();
      cells();
    }
    if (parts_.rocks && parts_.water) light_rocks();
    number_of_steps();
    return std::move(said_);
  }

 private:
  void say(std::string sentence) { said_.push_back(std::move(sentence)); }
  double gravity() const { return config_.gravity.norm(); }

  void spread_of_rocks() {
    const DemScene& scene = parts_.rocks->scene();
    const double sizes = scene.largest_size / scene.smallest_size;
    if (sizes >= wide_sizes)
      say(fmt::format(
          "rocks: sizes from {:.3g} to {:.3g} mm, a ratio of {:.3g}; the smallest set the step, "
          "{:.3g} times shorter than the largest alone would; raise the 'cutoff' if they do not matter",
          1e3 * scene.smallest_size, 1e3 * scene.largest_size, sizes, sizes));
    double lightest = scene.densest;
    for (const Material& m : scene.materials.all)
      if (m.density > 0) lightest = std::min(lightest, m.density);
    if (scene.densest >= wide_densities * lightest)
      say(fmt::format(
          "rocks: densities from {:.3g} to {:.3g} kg/m3, a ratio of {:.3g}; the lightest set the step, "
          "{:.3g} times shorter than the heaviest alone would",
          lightest, scene.densest, scene.densest / lightest, std::sqrt(scene.densest / lightest)));
  }

  /// Overlap over radius of an impact at this speed, by the linear law without damping.
  double overlap_at(double speed) const {
    const DemScene& scene = parts_.rocks->scene();
    double volume = 0;
    for (const RockShape& shape : scene.shapes) volume = std::max(volume, shape.volume);
    return 2 * speed * std::sqrt(scene.densest * volume / parts_.rocks->limits().stiffness_per_size);
  }

  void stiffness() {
    const DemConfig& rocks = *config_.rocks;
    if (!rocks.stiffness_per_size) return;
    const double overlap = overlap_at(rocks.impact_speed);
    const double needed = *rocks.stiffness_per_size * std::pow(overlap / rocks.impact_overlap, 2);
    if (overlap > rocks.overlap_limit)
      say(
          fmt::format("rocks: an impact at {:.3g} m/s overlaps {:.2g} of the radius and stops the run (limit "
                      "{:.2g}); raise 'stiffness_per_size' to {:.2g} N/m2 for {:.2g}",
                      rocks.impact_speed, overlap, rocks.overlap_limit, needed, rocks.impact_overlap));
    else if (overlap > soft_overlap)
      say(
          fmt::format("rocks: an impact at {:.3g} m/s overlaps {:.2g} of the radius; 'stiffness_per_size' of "
                      "{:.2g} N/m2 would make it {:.2g}",
                      rocks.impact_speed, overlap, needed, rocks.impact_overlap));
    else if (overlap * costly < rocks.impact_overlap)
      say(fmt::format(
          "rocks: 'stiffness_per_size' is {:.3g} times what 'impact_overlap' asks for, and the step "
          "{:.3g} times shorter ({:.2g} s)",
          *rocks.stiffness_per_size / needed, std::sqrt(*rocks.stiffness_per_size / needed),
          parts_.rocks->step_size()));
  }

  void rock_step() {
    const DemStepLimits& limits = parts_.rocks->limits();
    if (limits.step > long_step * limits.network)
      say(fmt::format(
          "rocks: the step is {:.2g} of the critical step of a dense bed; lower 'network_fraction'",
          limits.step / limits.network));
    if (limits.contact_time < few_steps * limits.step * (1 - 1e-9))
      say(fmt::format(
          "rocks: the shortest contact has {:.3g} steps, with which restitution is off by 5 % and "
          "more; raise 'steps_per_contact'",
          limits.contact_time / limits.step));
  }

  /// Rocks that start, or fall through the whole domain, faster than they may land.
  void rock_speed() {
    if (parts_.rocks->limits().stiffness_per_size <= 0) return;  // Hertz stiffens as it goes
    double fastest = 0;
    const auto look = [&](double start, double height) {
      fastest = std::max(fastest, std::sqrt(start * start + 2 * gravity() * std::max(0.0, height)));
    };
    const double floor = parts_.domain.box.lo.z();
    for (const RockFillConfig& fill : config_.rock_fills) look(fill.velocity.norm(), fill.high.z() - floor);
    for (const ConveyorFeedConfig& feed : config_.conveyors) look(feed.belt_speed, feed.position.z() - floor);
    const double overlap = overlap_at(fastest), limit = config_.rocks->overlap_limit;
    if (fastest > config_.rocks->impact_speed && overlap > limit)
      say(fmt::format(
          "rocks: falling to the bottom of the domain they land at {:.3g} m/s and overlap {:.2g} of "
          "the radius (limit {:.2g}); raise 'impact_speed' ({:.3g} m/s)",
          fastest, overlap, limit, config_.rocks->impact_speed));
  }

  void sound() {
    const MpmConfig& water = *config_.water;
    const double c = parts_.water->limits().sound_speed;
    const double expected = std::max(water.fastest_bulk_speed, std::sqrt(2 * gravity() * water.deepest));
    if (water.sound_speed && expected > weak_sound * c)
      say(fmt::format(
          "water: sound at {:.3g} m/s is only {:.3g} times as fast as the water, whose density is "
          "then {:.2g} % off; raise 'sound_speed' to {:.3g} m/s",
          c, c / expected, 50 * std::pow(expected / c, 2), 10 * expected));
    double fall = 0;
    for (const WaterFillConfig& fill : config_.water_fills)
      fall = std::max(
          fall, std::sqrt(fill.velocity.squaredNorm() +
                          2 * gravity() * (fill.level.value_or(fill.high.z()) - parts_.domain.box.lo.z())));
    if (fall > most_mach * c)
      say(fmt::format(
          "water: falling to the bottom of the domain a fill reaches {:.3g} m/s, {:.2g} of the speed "
          "of sound (the run stops at {:.2g}); raise {}",
          fall, fall / c, most_mach, water.sound_speed ? "'sound_speed'" : "'fastest_bulk_speed'"));
  }

  void jets() {
    const MpmConfig& water = *config_.water;
    const double stated = std::max(water.fastest_speed, water.fastest_bulk_speed);
    const double c = parts_.water->limits().sound_speed;
    const auto leaves = [&](const std::string& name, double speed) {
      if (speed > most_mach * c)
        say(fmt::format(
            "{}: leaves at {:.3g} m/s, {:.2g} of the speed of sound (bulk water stops the run at "
            "{:.2g}); raise {}",
            name, speed, speed / c, most_mach, water.sound_speed ? "'sound_speed'" : "'fastest_bulk_speed'"));
      else if (speed > 1.05 * stated)
        say(fmt::format("{}: leaves at {:.3g} m/s, faster than 'fastest_speed' says ({:.3g} m/s)", name,
                        speed, stated));
    };
    for (const PipeJetConfig& pipe : config_.pipes) {
      leaves(pipe.name, pipe.speed() * profile_speed(pipe.profile, 0));
      if (pipe.bore < water.spacing)
        say(fmt::format(
            "{}: its bore of {:.3g} mm is thinner than a cell ({:.3g} mm), over which the jet will "
            "spread; lower 'spacing'",
            pipe.name, 1e3 * pipe.bore, 1e3 * water.spacing));
    }
    for (const ChannelInflowConfig& channel : config_.channels) {
      const double across = config_.gravity.cross(channel.outlets.axis()).norm();
      leaves(channel.name, fastest_speed(channel, across));
      if (!is_rapid(channel, across))
        say(fmt::format(
            "{}: at {:.3g} m/s its water is slower than its waves ({:.3g} m/s): it runs back unless "
            "a wall stands behind the inlet, and what is downstream decides its depth; a smaller "
            "'depth' makes it rapid",
            channel.name, channel.speed(), std::sqrt(across * channel.depth)));
      if (std::min(channel.depth, channel.width) < water.spacing)
        say(fmt::format(
            "{}: its section of {:.3g} x {:.3g} mm is thinner than a cell ({:.3g} mm), over which "
            "the water will spread; lower 'spacing'",
            channel.name, 1e3 * channel.width, 1e3 * channel.depth, 1e3 * water.spacing));
    }
    for (const SprayNozzleConfig& spray : config_.sprays)
      if (spray.speed(water.fluid.density) > 1.05 * stated)
        say(fmt::format("{}: leaves at {:.3g} m/s, faster than 'fastest_speed' says ({:.3g} m/s)", spray.name,
                        spray.speed(water.fluid.density), stated));
  }

  void viscosity() {
    const MpmConfig& water = *config_.water;
    const FluidStepLimits& limits = parts_.water->limits();
    const bool yields = water.fluid.rheology != Rheology::newtonian;
    if (limits.acoustic >= costly * limits.viscous)
      say(fmt::format(
          "water: its viscosity {}makes the step {:.3g} times shorter than sound does ({:.2g} s); use "
          "larger cells ('spacing'), or {} as far as the flow does not change",
          yields ? "at rest " : "", limits.acoustic / limits.viscous, limits.step,
          yields ? "raise 'yield_rate'" : "lower 'viscosity'"));
    if (water.wall_slip == WallSlip::no_slip) return;
    const double viscosity =
        apparent_viscosity(water.fluid, flow_curve(water.fluid, 0), water.fastest_bulk_speed / water.spacing);
    const double cell_reynolds = water.fastest_bulk_speed * water.spacing * water.fluid.density / viscosity;
    if (water.fluid.yield_stress > 0)
      say("water: it has a yield stress, which walls without 'wall_slip: no_slip' do not feel: it will not "
          "stand on a slope");
    else if (viscosity > 0 && cell_reynolds < 1)
      say(
          fmt::format("water: so thick (Reynolds number of a cell {:.2g}) that it sticks to walls; set "
                      "'wall_slip: no_slip'",
                      cell_reynolds));
  }

  /// What belts bring must not ask for a shorter step than the run has: the watch stops it.
  void slurry() {
    const FluidModel& fluid = config_.water->fluid;
    const double step = choose_time_step(parts_).dt_fluid();
    for (const ConveyorFeedConfig& feed : config_.conveyors) {
      if (feed.below_cutoff != BelowCutoff::slurry || !(feed.moisture > 0)) continue;
      const double grains = SizeDistribution(feed.sizes).fines_fraction() / fluid.fines_density;
      const double phi = grains / (grains + feed.moisture / fluid.density);
      const double thicker = largest_viscosity(fluid, phi) / slurry_density(fluid, phi) /
                             (largest_viscosity(fluid, 0) / fluid.density);
      const double allowed = parts_.water->limits().viscous / thicker;
      if (allowed < step)
        say(fmt::format(
            "{}: its slurry of {:.3g} % grains is {:.3g} times as thick as the water and allows steps "
            "of {:.2g} s (the run has {:.2g} s and will stop); lower 'courant' to {:.2g}",
            feed.name, 100 * phi, thicker, allowed, step,
            0.9 * config_.water->courant * allowed / parts_.water->limits().acoustic));
    }
  }

  void cells() {
    const Vec3 size = parts_.domain.box.size();
    for (int k = 0; k < 3; ++k) {
      const double across = size[k] / config_.water->spacing;
      if (parts_.domain.low[k] == Face::wall && parts_.domain.high[k] == Face::wall &&
          across < fewest_cells * (1 - 1e-9))
        say(fmt::format(
            "water: the domain is {:.2g} cells wide along {} (pressure is right from {:.0f} on); lower "
            "'spacing' to {:.3g} mm",
            across, "xyz"[k], fewest_cells, 1e3 * size[k] / fewest_cells));
    }
  }

  void light_rocks() {
    const double liquid = parts_.water->model().density;
    for (const Material& m : parts_.rocks->materials().all)
      if (m.density > 0 && m.density < 0.5 * liquid)
        say(fmt::format(
            "{}: {:.3g} of the water's density; no added mass is in the model, so that it starts up to "
            "{:.2g} times too fast",
            m.name, m.density / liquid, 1 + 0.5 * liquid / m.density));
  }

  void number_of_steps() {
    const TimeStep step = choose_time_step(parts_);
    const double shortest =
        std::min(parts_.rocks ? step.dt_rock() : step.dt, parts_.water ? step.dt_fluid() : step.dt);
    if (config_.duration > many_steps * shortest)
      say(
          fmt::format("the run takes {:.2g} steps of {:.2g} s: see what makes them so short above, or lower "
                      "'duration'",
                      config_.duration / shortest, shortest));
  }

  const ProcessConfig& config_;
  const Parts& parts_;
  std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> foreseen(const ProcessConfig& config, const Parts& parts) {
  return Foresight(config, parts).take();
}

}  // namespace sluice
