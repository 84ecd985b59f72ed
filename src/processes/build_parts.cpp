#include "processes/build_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "processes/check_motion.h"
#include "processes/check_places.h"
#include "processes/foresee.h"

namespace sluice {

namespace {

int index_of_material(const Materials& materials, const std::string& name) {
  for (std::size_t i = 0; i < materials.all.size(); ++i)
    if (materials.all[i].name == name) return static_cast<int>(i);
  return -1;
}

/// What the sources of rock say about the rocks there can be.
struct RockSources {
  std::vector<RockShape> shapes;
  std::vector<ShapeMix> conveyor_mix, fill_mix;                            ///< one per entry
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;  ///< [m]
  double densest = 0;                                                      ///< [kg/m3]
  std::set<std::string> materials;
};

class Builder {
 public:
  explicit Builder(const ProcessConfig& config) : config_(config) {}
  BuiltProcess build();

 private:
  void refuse(const Location& where, const std::string& key, const std::string& problem,
              const std::string& reason, const std::string& suggestion) {
    problems_.push_back({where, key, problem, reason, suggestion});
  }
  void stop_if_bad() {
    if (!problems_.empty()) throw InputError(std::move(problems_));
  }
  /// Runs one builder; its problems join the others, those without a place at `section`.
  template <class Run>
  void collect(const Run& run, const Location& section = {}) {
    try {
      run();
    } catch (const InputError& e) {
      for (InputProblem p : e.problems()) {
        if (p.where.file.empty()) p.where = section;
        problems_.push_back(std::move(p));
      }
    }
  }
  Location first_rock_source() const;
  Location first_water_source() const;

  void look_at_phases();
  RockSources look_at_rocks();
  void need_contacts(const RockSources& sources, const std::vector<Wall>& walls);
  void look_at_exits();
  void make_rocks(const RockSources& sources);
  void make_water();
  void make_inflows(const RockSources& sources);
  void make_fills(const RockSources& sources);

  const ProcessConfig& config_;
  std::vector<InputProblem> problems_;
  Materials materials_;
  InflowTarget target_;
  BuiltProcess built_;
};

Location Builder::first_rock_source() const {
  return config_.conveyors.empty() ? config_.rock_fills.front().where : config_.conveyors.front().where;
}

Location Builder::first_water_source() const {
  if (!config_.pipes.empty()) return config_.pipes.front().where;
  if (!config_.channels.empty()) return config_.channels.front().where;
  return config_.sprays.empty() ? config_.water_fills.front().where : config_.sprays.front().where;
}

void Builder::look_at_phases() {
  const bool rock_source = !config_.conveyors.empty() || !config_.rock_fills.empty();
  const bool water_source = !config_.pipes.empty() || !config_.channels.empty() || !config_.sprays.empty() ||
                            !config_.water_fills.empty();
  if (!config_.rocks && !config_.water)
    refuse(config_.duration_at, "duration", "has nothing to simulate",
           "the process has neither 'rocks' nor 'water'", "add one of them");
  if (!config_.rocks && rock_source)
    refuse(first_rock_source(), "rocks", "is missing", "conveyors or rock_fills bring rock", "add 'rocks:'");
  if (!config_.water && water_source)
    refuse(first_water_source(), "water", "is missing", "pipes, channels, sprays or water_fills bring water",
           "add 'water:'");
  if (config_.rocks && !rock_source)
    refuse(config_.rocks_at, "rocks", "has no source", "no conveyor and no rock_fill",
           "add one, or leave 'rocks' out");
  if (config_.water && !water_source && config_.conveyors.empty())
    refuse(config_.water_at, "water", "has no source", "no pipe, spray, fill or conveyor",
           "add one, or leave 'water' out");
  if (config_.coupling && (!config_.rocks || !config_.water))
    refuse(config_.duration_at, "coupling", "has only one side", "it needs 'rocks' and 'water'",
           "leave it out");
  if (config_.coupling && config_.coupling->resolve_from && config_.coupling->mode == CouplingMode::one_way)
    refuse(config_.coupling->resolve_from_at, "resolve_from", "resolves rocks that the water does not feel",
           "'mode' is 'one_way'", "leave one of them out");
}

RockSources Builder::look_at_rocks() {
  RockSources sources;
  const auto take = [&](const SizeDistributionConfig& sizes, const ShapeMixConfig& shapes,
                        const std::string& material, const Location& where) {
    collect([&] {
      const SizeDistribution distribution(sizes);
      sources.smallest = std::min(sources.smallest, distribution.smallest());
      sources.largest = std::max(sources.largest, distribution.largest());
    });
    const int m = index_of_material(materials_, material);
    if (m < 0) {
      refuse(where, "material", "is '" + material + "', which is not a material", "rocks need a density",
             "name one of 'materials'");
    } else {
      const double density = materials_.all[static_cast<std::size_t>(m)].density;
      if (!(density > 0))
        refuse(where, "material", "has no density", "rocks are made of '" + material + "'",
               "give materials." + material + ".density");
      sources.densest = std::max(sources.densest, density);
      sources.materials.insert(material);
    }
    return make_shape_mix(shapes, sources.shapes);
  };
  for (const ConveyorFeedConfig& feed : config_.conveyors)
    sources.conveyor_mix.push_back(take(feed.sizes, feed.shapes, feed.material, feed.where));
  for (const RockFillConfig& fill : config_.rock_fills)
    sources.fill_mix.push_back(take(fill.sizes, fill.shapes, fill.material, fill.where));
  return sources;
}

// A pair of materials that can touch must be stated: friction is never a guess.
void Builder::need_contacts(const RockSources& sources, const std::vector<Wall>& walls) {
  std::set<std::string> wall_materials;
  for (const Wall& wall : walls)
    if (wall.blocks != BlocksPhase::water_only)
      wall_materials.insert(materials_.all[static_cast<std::size_t>(wall.material)].name);
  const auto stated = [&](const std::string& a, const std::string& b) {
    return std::any_of(config_.contacts.begin(), config_.contacts.end(), [&](const ContactConfig& c) {
      return (c.between[0] == a && c.between[1] == b) || (c.between[0] == b && c.between[1] == a);
    });
  };
  std::set<std::pair<std::string, std::string>> missing;
  for (const std::string& rock : sources.materials) {
    for (const std::string& other : sources.materials)
      if (!stated(rock, other)) missing.insert(std::minmax(rock, other));
    for (const std::string& wall : wall_materials)
      if (!stated(rock, wall)) missing.insert(std::minmax(rock, wall));
  }
  for (const auto& [a, b] : missing)
    refuse(config_.rocks_at, "contacts", fmt::format("does not say what happens between {} and {}", a, b),
           "friction and restitution are never guessed",
           fmt::format("add {{between: [{}, {}], friction: 0.5, restitution: 0.3}}", a, b));
}

void Builder::look_at_exits() {
  const double cell = config_.water ? config_.water->spacing : 0;
  collect([&] { check_exits(config_.exits, built_.parts.domain, *built_.parts.walls, cell); });
  if (config_.stop && std::none_of(config_.exits.begin(), config_.exits.end(),
                                   [&](const ExitConfig& e) { return e.name == config_.stop->exit; }))
    refuse(config_.stop->where, "exit", "is '" + config_.stop->exit + "', which is not an exit",
           "the run ends by what leaves there", "name one of 'exits'");
}

void Builder::make_rocks(const RockSources& sources) {
  DemScene scene;
  scene.materials = materials_;
  scene.shapes = sources.shapes;
  scene.domain = built_.parts.domain;
  scene.gravity = config_.gravity;
  scene.smallest_size = sources.smallest;
  scene.largest_size = sources.largest;
  scene.densest = sources.densest;
  built_.parts.rocks = std::make_unique<DemSystem>(*config_.rocks, std::move(scene), *built_.parts.walls);
}

void Builder::make_water() {
  built_.parts.water = make_mpm(*config_.water, built_.parts.domain, config_.gravity, *built_.parts.walls);
}

void Builder::make_inflows(const RockSources& sources) {
  const auto add = [&](auto make) {
    collect([&] { built_.parts.inflows.push_back(make()); });
    ++target_.index;  // of its own random stream
  };
  for (std::size_t i = 0; i < config_.conveyors.size(); ++i) {
    const ConveyorFeedConfig& feed = config_.conveyors[i];
    add([&] { return make_conveyor_feed(feed, sources.conveyor_mix[i], target_); });
    collect([&] {
      const SizeDistribution sizes(feed.sizes);
      built_.rock_rate += feed.rate * (1 - sizes.fines_fraction());
      if (feed.below_cutoff == BelowCutoff::leave_out && sizes.fines_fraction() > 0)
        built_.warnings.push_back(
            fmt::format("{}: {:.3g} % of the feed is finer than the cut-off of {:.3g} mm and left out",
                        feed.name, 100 * sizes.fines_fraction(), 1e3 * feed.sizes.cutoff));
    });
  }
  for (const PipeJetConfig& pipe : config_.pipes) add([&] { return make_pipe_jet(pipe, target_); });
  for (const ChannelInflowConfig& channel : config_.channels)
    add([&] { return make_channel_inflow(channel, target_); });
  for (const SprayNozzleConfig& spray : config_.sprays)
    add([&] { return make_spray_nozzle(spray, target_); });
}

void Builder::make_fills(const RockSources& sources) {
  Parts& parts = built_.parts;
  InflowTarget target = target_;
  for (std::size_t i = 0; i < config_.rock_fills.size(); ++i, ++target.index)
    collect([&] {
      parts.initial_rock_kg += fill_rocks(config_.rock_fills[i], sources.fill_mix[i], target).mass;
    });
  for (std::size_t i = 0; i < config_.water_fills.size(); ++i, ++target.index)
    collect([&] {
      const FilledMass filled = fill_water(config_.water_fills[i], *parts.walls, target);
      parts.initial_water_kg += filled.mass;
      parts.initial_fines_kg += filled.fines;
    });
  target_.index = target.index;
}

BuiltProcess Builder::build() {
  look_at_phases();
  stop_if_bad();
  std::vector<Wall> walls;
  collect([&] { materials_ = build_materials(config_); });
  collect([&] { walls = build_walls(config_); });
  stop_if_bad();
  Parts& parts = built_.parts;
  parts.domain = config_.domain.domain();
  parts.gravity = config_.gravity;
  parts.walls = std::make_unique<Walls>(std::move(walls));
  const RockSources sources = look_at_rocks();
  if (config_.rocks) need_contacts(sources, parts.walls->all());
  look_at_exits();
  for (InputProblem& p : misplaced(config_)) problems_.push_back(std::move(p));
  stop_if_bad();

  if (config_.rocks) collect([&] { make_rocks(sources); }, config_.rocks_at);
  std::ranges::move(motion_warnings(config_, parts.walls->all()), std::back_inserter(built_.warnings));
  if (parts.rocks && config_.coupling && config_.coupling->lubrication != FilmModel::none &&
      !std::ranges::all_of(parts.rocks->shapes(), &RockShape::is_sphere))
    refuse(config_.coupling->lubrication_at, "lubrication", "is of spheres alone",
           "some rocks have other shapes", "leave it out, or make all rocks spheres");
  if (config_.water) collect([&] { make_water(); }, config_.water_at);
  std::ranges::move(unresolved_motions(config_, parts.rocks ? parts.rocks->step_size() : 0,
                                       parts.water ? parts.water->limits().step : 0),
                    std::back_inserter(problems_));
  stop_if_bad();
  target_ = {parts.rocks.get(),
             parts.water.get(),
             parts.domain,
             config_.gravity,
             static_cast<std::uint64_t>(config_.seed),
             0};
  make_fills(sources);
  make_inflows(sources);
  stop_if_bad();
  if (parts.rocks && parts.water && config_.coupled)
    parts.coupling = std::make_unique<Coupling>(config_.coupling.value_or(CouplingConfig{}), parts.domain,
                                                parts.gravity, *parts.rocks, *parts.water);
  if (parts.coupling)
    for (const RemovedPoint& displaced : parts.coupling->make_room()) {
      parts.initial_water_kg -= displaced.mass;
      parts.initial_fines_kg -= displaced.fines_mass;
    }
  parts.exits.emplace(config_.exits, *parts.walls, config_.output.exit_slot, parts.domain);
  for (const GaugeConfig& gauge : config_.gauges) parts.probes.push_back(make_gauge(gauge));
  for (const MixingConfig& mixing : config_.mixing)
    parts.probes.push_back(std::make_unique<MixingProbe>(mixing));
  std::ranges::move(foreseen(config_, parts), std::back_inserter(built_.warnings));
  return std::move(built_);
}

}  // namespace

BuiltProcess build_parts(const ProcessConfig& config) {
  return Builder(config).build();
}

}  // namespace sluice
