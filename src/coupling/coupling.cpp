#include "coupling/coupling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/find_by_id.h"
#include "base/parallel.h"
#include "coupling/coupling_grid.h"
#include "coupling/cross_section.h"
#include "coupling/resolved_rocks.h"
#include "coupling/turning.h"
#include "coupling/wetting.h"

namespace sluice {

namespace {

/// Densest random packing of stones; a kernel that finds more has put a rock's volume where it is not.
constexpr double least_void_fraction = 0.3;

/// What one rock has to do with the coupling grid in this exchange.
struct RockOnGrid {
  LevelWeights place;  ///< weights over all nodes; once wetted, times fluid mass: sum 1 either way
  int level = 0;
  double core = 0;   ///< size of what is resolved of it, over its own
  double outer = 1;  ///< volume of the rest, over its own
  double wetted = 0;
  double take_up = 0;    ///< b of the header [kg]
  double displaced = 0;  ///< wetted volume [m3]
};

/// Size of the largest rock on which a drag law acts [m].
double largest_unresolved(const CouplingConfig& config, const DemSystem& rocks, const FluidSystem& fluid) {
  const double largest = rocks.scene().largest_size;
  const bool law_ends = config.resolve_from && fluid.sticks_to_walls();
  return law_ends ? std::min(largest, *config.resolve_from * fluid.spacing()) : largest;
}

/// How far outside a resolved rock its surface is asked whether it is wet [cells].
constexpr double wet_beside = 0.75;

}  // namespace

struct Coupling::Implementation {
  Implementation(const CouplingConfig& c, const Domain& domain, const Vec3& g, DemSystem& r, FluidSystem& f)
      : config(c),
        gravity(g),
        rocks(r),
        fluid(f),
        grid(domain, f.spacing(), c.kernel_diameters * r.scene().smallest_size,
             c.kernel_diameters * largest_unresolved(c, r, f)),
        table(domain, f.spacing()),
        domain(domain) {
    own_drag = f.sticks_to_walls();
    points = wetting_points(r.shapes(), static_cast<int>(c.wetting_points));
    if (c.resolve_from) {
      resolved =
          std::make_unique<ResolvedRocks>(c.partly_from() * f.spacing(), *c.resolve_from * f.spacing(), r, f);
      if (c.lubrication != FilmModel::none) resolved->use_lubrication(c.lubrication_roughness);
      skins = skin_points(r.shapes(), static_cast<int>(c.wetting_points));
    }
    for (const RockShape& shape : r.shapes()) {
      if (c.drag == DragModel::hoelzer_sommerfeld) cross_sections.emplace_back(shape);
      if (c.torque != CouplingTorque::none) turning.emplace_back(shape);
      diameter_per_size.push_back(std::cbrt(6 / std::numbers::pi * shape.volume));
    }
  }

  void place_rocks();
  void keep_filter_with_rocks();
  void find_saturation();
  void meet_water(double dt);
  void meet_water(std::size_t rock, double dt);
  void add_to_nodes(double dt);
  void solve_nodes();
  void share_impulses(double dt);
  void give_to_fluid();
  void filter_acceleration(double dt);
  Vec3 explicit_force(std::size_t rock) const {
    return resolved ? Vec3(buoyancy[rock] + beyond_core[rock]) : buoyancy[rock];
  }
  double filter_time() const {
    return config.filter_time_factor * fluid.spacing() / fluid.limits().sound_speed;
  }
  double solids_fraction_around(std::size_t rock) const;
  bool meets_law(const RockOnGrid& rock) const { return rock.core < 1 || !own_drag; }
  Vec3 torque_on(std::size_t rock, double dt) const;

  CouplingConfig config;
  Vec3 gravity;
  DemSystem& rocks;
  FluidSystem& fluid;
  CouplingGrid grid;
  FillTable table;
  Domain domain;
  std::vector<WettingPoints> points;         // of each shape
  std::vector<double> diameter_per_size;     // of the sphere of equal volume, of each shape
  std::vector<CrossSection> cross_sections;  // of each shape, where the drag law asks
  std::vector<Turning> turning;              // of each shape, where asked
  std::unique_ptr<ResolvedRocks> resolved;   // where asked
  bool own_drag = false;                     // resolved rocks feel no law, but what the water does
  std::vector<WettingPoints> skins;          // of each shape, where rocks are resolved

  FluidNodes nodes;
  std::vector<double> saturation;  // of the space that rocks, wet or dry, leave free at each node
  std::vector<RockOnGrid> on_grid;
  SlabOrder by_slab;
  std::vector<double> wetted;
  std::vector<Vec3> drag, buoyancy, force, torque;
  std::vector<WaterAround> around;  // each rock, where water turns rocks
  std::vector<Vec3> core_force,
      beyond_core;  // where rocks are resolved: on the core, and what is missing [N]
  FromRocks to_nodes;
  std::vector<Vec3> node_acceleration;
  std::vector<double> void_fraction;

  // Filtered Du/Dt - g per rock, kept by id; zero where dry.
  std::vector<std::uint64_t> filter_id;
  std::vector<Vec3> filtered;

  Vec3 on_rocks = Vec3::Zero(), on_fluid = Vec3::Zero();
  double kernel_ratio = 0, least_void = 1;
};

void Coupling::Implementation::place_rocks() {
  const Rocks& all = rocks.rocks();
  on_grid.resize(all.count());
  std::vector<double> largest(static_cast<std::size_t>(grid.coarsest()) + 1, 0.0);
  for (std::size_t r = 0; r < all.count(); ++r) {
    on_grid[r].core = resolved ? resolved->core(r) : 0;
    on_grid[r].outer = 1 - on_grid[r].core * on_grid[r].core * on_grid[r].core;
    if (!meets_law(on_grid[r])) continue;
    on_grid[r].level = grid.level_for(config.kernel_diameters * all.size[r]);
    double& size = largest[static_cast<std::size_t>(on_grid[r].level)];
    size = std::max(size, all.size[r]);
  }
  for (int l = grid.finest(); l <= grid.coarsest(); ++l) {
    if (largest[static_cast<std::size_t>(l)] == 0) continue;
    const double ratio = grid.kernel_width(l) / largest[static_cast<std::size_t>(l)];
    kernel_ratio = kernel_ratio == 0 ? ratio : std::min(kernel_ratio, ratio);
  }
  parallel_for(all.count(),
               [&](std::size_t r) { on_grid[r].place = grid.weights(on_grid[r].level, all.x[r]); });
  by_slab.sort(all.count(), grid.slab_count(),
               [&](std::size_t r) { return meets_law(on_grid[r]) ? on_grid[r].place.slab : -1; });
  grid.clear_solids();
  grid.each_slab(by_slab, [&](std::size_t, std::span<const std::uint32_t> items) {
    for (const std::uint32_t r : items)
      grid.add_solids(on_grid[r].level, on_grid[r].place, on_grid[r].outer * rocks.volume(r));
  });
}

// Solids fraction that the other rocks make around this one: a rock is not in its own way. Rocks of
// other levels count through their own level's nodes.
double Coupling::Implementation::solids_fraction_around(std::size_t r) const {
  const RockOnGrid& rock = on_grid[r];
  double fraction = 0;
  for (int l = grid.finest(); l <= grid.coarsest(); ++l) {
    const CouplingLevel& level = grid.level(l);
    const double own = l == rock.level ? rock.outer * rocks.volume(r) : 0;
    const LevelWeights w = l == rock.level ? rock.place : grid.weights(l, rocks.rocks().x[r]);
    for (std::size_t c = 0; c < 8; ++c) {
      const NodeLanes& node = level.fluid_at(w.node[c]);
      fraction += w.weight[c] * std::max(0.0, node[fluid_lane::solids] - w.weight[c] * own) *
                  node[fluid_lane::per_volume];
    }
  }
  return fraction;
}

// Rocks come, go and change places between exchanges.
void Coupling::Implementation::keep_filter_with_rocks() {
  const std::vector<std::uint64_t>& id = rocks.rocks().id;
  if (filter_id == id) return;
  std::vector<Vec3> kept(id.size(), Vec3::Zero());
  FindById earlier(filter_id);
  for (std::size_t r = 0; r < id.size(); ++r)
    if (const auto known = earlier.find(id[r])) kept[r] = filtered[*known];
  filter_id = id;
  filtered = std::move(kept);
}

// The void fraction that the fluid knows is that of the wet rocks alone, and what is wet follows from the
// fill: on its own that has two answers where more than half is rock. All rocks together leave one.
void Coupling::Implementation::find_saturation() {
  if (config.mode == CouplingMode::one_way) {
    saturation = nodes.fill;
    return;
  }
  grid.solids_fraction(nodes, saturation);
  parallel_for(nodes.count(), [&](std::size_t i) {
    const double open = nodes.open_volume[i] * std::max(least_void_fraction, 1 - saturation[i]);
    saturation[i] = open > 0 ? nodes.mass[i] / (nodes.density[i] * open) : 0;
  });
}

void Coupling::Implementation::meet_water(double dt) {
  const std::size_t count = rocks.rocks().count();
  wetted.resize(count);
  buoyancy.resize(count);
  if (!turning.empty()) around.resize(count);
  if (resolved) {
    beyond_core.resize(count);
    resolved->filtered_force(core_force);
  }
  keep_filter_with_rocks();
  parallel_for(
      count, [&](std::size_t r) { meet_water(r, dt); }, 64);
}

// Wetted fraction, drag and buoyancy of one rock; nothing is written to nodes yet.
void Coupling::Implementation::meet_water(std::size_t r, double dt) {
  const Rocks& all = rocks.rocks();
  RockOnGrid& rock = on_grid[r];
  const CouplingLevel& level = grid.level(rock.level);
  rock.wetted = rock.take_up = rock.displaced = wetted[r] = 0;
  buoyancy[r] = Vec3::Zero();
  if (resolved) beyond_core[r] = Vec3::Zero();
  const auto shape = static_cast<std::size_t>(all.shape[r]);
  if (rock.core > 0) {  // water stands beside what is resolved, not in it
    const double beside = rock.core * all.size[r] + 2 * wet_beside * fluid.spacing();
    const double grown = std::max(all.size[r], beside);
    rock.wetted = table.wetted_fraction(skins[shape], all.x[r], all.q[r].toRotationMatrix() * grown,
                                        all.radius[r] * grown / all.size[r]);
    wetted[r] = rock.wetted;
    if (!meets_law(rock)) rock.wetted = 0;
    if (rock.wetted <= 0) return;
  }
  NodeLanes sums{};
  for (std::size_t c = 0; c < 8; ++c) sums += rock.place.weight[c] * level.fluid_at(rock.place.node[c]);
  const double mass = sums[fluid_lane::mass];
  if (!(mass > 0)) rock.wetted = 0;
  if (mass > 0 && rock.core == 0)
    wetted[r] = rock.wetted = table.wetted_fraction(points[shape], all.x[r],
                                                    all.q[r].toRotationMatrix() * all.size[r], all.radius[r]);
  if (rock.wetted <= 0) return;
  rock.displaced = rock.wetted * rock.outer * rocks.volume(r);

  DragInput in;
  in.density = sums[fluid_lane::density] / mass;
  in.viscosity = sums[fluid_lane::viscosity] / mass;
  in.diameter = all.size[r] * diameter_per_size[shape];
  in.void_fraction = std::max(least_void_fraction, 1 - solids_fraction_around(r));
  constexpr int p = fluid_lane::momentum;
  const Vec3 slip = Vec3(sums[p], sums[p + 1], sums[p + 2]) / mass - all.v[r];
  in.speed = slip.norm();
  const FluidModel& model = fluid.model();
  if (model.rheology != Rheology::newtonian)
    in.viscosity = viscosity_around(model, fines_fraction(model, in.density), in.speed, in.diameter);
  in.sphericity = rocks.shapes()[shape].sphericity;
  if (!cross_sections.empty() && in.speed > 0) {
    const double section = cross_sections[shape].seen_along(all.q[r].conjugate() * (slip / in.speed));
    in.crosswise = std::numbers::pi / 4 * std::pow(diameter_per_size[shape], 2) / section;
  }
  const double square = rock.core * rock.core, beyond = 1 - square * square * square;
  const double share = own_drag ? beyond : 1;
  const double beta = share * rock.wetted * drag_per_speed(config.drag, in);
  if (!around.empty())
    around[r] = {in.density, in.viscosity, in.speed > 0 ? Vec3(slip / in.speed) : slip, beyond * rock.wetted,
                 beyond / share};
  if (rock.core > 0) {
    const double whole = rock.wetted * rocks.volume(r);
    beyond_core[r] =
        (square * square - 1) * (core_force[r] - (1 - rock.outer) * whole * in.density * filtered[r]);
  }
  rock.take_up = -all.mass[r] * std::expm1(-beta * dt / all.mass[r]);
  // The filtered acceleration is evaluated in fluid_to_grid; here it becomes an impulse on both sides.
  buoyancy[r] = rock.displaced * in.density * filtered[r];
  for (std::size_t c = 0; c < 8; ++c)
    rock.place.weight[c] *= level.fluid_at(rock.place.node[c])[fluid_lane::mass] / mass;
}

void Coupling::Implementation::add_to_nodes(double dt) {
  const Rocks& all = rocks.rocks();
  grid.each_slab(by_slab, [&](std::size_t, std::span<const std::uint32_t> items) {
    for (const std::uint32_t r : items) {
      const RockOnGrid& rock = on_grid[r];
      if (rock.wetted <= 0) continue;
      CouplingLevel& level = grid.level(rock.level);
      Vec3 bv = rock.take_up * all.v[r];
      if (resolved) bv -= dt * beyond_core[r];
      const Vec3 lift = dt * buoyancy[r];
      const NodeLanes sums{rock.take_up, bv.x(),    bv.y(),    bv.z(),
                           -lift.x(),    -lift.y(), -lift.z(), rock.displaced};
      for (std::size_t c = 0; c < 8; ++c) level.rock_at(rock.place.node[c]) += rock.place.weight[c] * sums;
    }
  });
}

void Coupling::Implementation::solve_nodes() {
  const bool two_way = config.mode == CouplingMode::two_way;
  for (int l = grid.finest(); l <= grid.coarsest(); ++l) {
    CouplingLevel& level = grid.level(l);
    parallel_for(level.wet.size(), [&](std::size_t i) {
      const NodeLanes& fluid = level.fluid_at(level.wet[i]);
      NodeLanes& rock = level.rock_at(level.wet[i]);
      const double mass = fluid[fluid_lane::mass], b = rock[rock_lane::take_up];
      for (int k = 0; k < 3; ++k) {
        const double u = fluid[fluid_lane::momentum + k] / mass;
        const double change = two_way ? (rock[rock_lane::velocity + k] - b * u) / (mass + b) : 0;
        rock[rock_lane::velocity + k] = u + change;
        rock[rock_lane::impulse + k] += mass * change;
      }
    });
  }
}

void Coupling::Implementation::share_impulses(double dt) {
  const Rocks& all = rocks.rocks();
  drag.resize(all.count());
  force.resize(all.count());
  torque.assign(all.count(), Vec3::Zero());
  parallel_for(all.count(), [&](std::size_t r) {
    const RockOnGrid& rock = on_grid[r];
    drag[r] = Vec3::Zero();
    if (rock.wetted > 0) {
      const CouplingLevel& level = grid.level(rock.level);
      NodeLanes sums{};
      for (std::size_t c = 0; c < 8; ++c) sums += rock.place.weight[c] * level.rock_at(rock.place.node[c]);
      constexpr int u = rock_lane::velocity;
      drag[r] = rock.take_up / dt * (Vec3(sums[u], sums[u + 1], sums[u + 2]) - all.v[r]);
    }
    if (!turning.empty() && rock.wetted > 0) torque[r] = torque_on(r, dt);
    force[r] = drag[r] + explicit_force(r);
    if (resolved) drag[r] += beyond_core[r];
  });
  on_rocks += dt * parallel_sum<Vec3>(
                       all.count(), [&](std::size_t r) { return force[r]; }, Vec3::Zero());
}

// Of drag beside the centre, and against spin: what remains of it after dt, were nothing else to act.
Vec3 Coupling::Implementation::torque_on(std::size_t r, double dt) const {
  const Rocks& all = rocks.rocks();
  const Turning& law = turning[static_cast<std::size_t>(all.shape[r])];
  const Quat to_body = all.q[r].conjugate();
  const WaterAround& water = around[r];
  TurningInput in;
  in.size = all.size[r];
  in.density = water.density;
  in.viscosity = water.viscosity;
  in.direction = to_body * water.direction;
  in.spin = to_body * (all.w[r] - grid.level(on_grid[r].level).water_spin(on_grid[r].place));
  Vec3 moment = water.turning * law.centre_of_pressure(in).cross(to_body * drag[r]);
  const Vec3 inertia = rocks.inertia(r), rate = water.resisting * law.resistance(in);
  for (int k = 0; k < 3; ++k)
    moment[k] += inertia[k] * in.spin[k] * std::expm1(-rate[k] * dt / inertia[k]) / dt;
  return all.q[r] * moment;
}

void Coupling::Implementation::give_to_fluid() {
  grid.scatter(nodes, to_nodes);
  on_fluid += parallel_sum<Vec3>(
      nodes.count(), [&](std::size_t i) { return to_nodes.impulse[i]; }, Vec3::Zero());
  fluid.add_impulse(to_nodes.impulse);
  void_fraction.resize(nodes.count());
  constexpr std::size_t chunk = 1024;
  std::vector<double> least((nodes.count() + chunk - 1) / chunk, 1.0);
  parallel_chunks(nodes.count(), chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      void_fraction[i] = 1;
      if (to_nodes.displaced[i] > 0 && nodes.open_volume[i] > 0)
        void_fraction[i] = std::max(least_void_fraction, 1 - to_nodes.displaced[i] / nodes.open_volume[i]);
      least[c] = std::min(least[c], void_fraction[i]);
    }
  });
  for (const double one : least) least_void = std::min(least_void, one);
  fluid.set_void_fraction(void_fraction);
}

void Coupling::Implementation::filter_acceleration(double dt) {
  const double tau = filter_time();
  const double share = tau > 0 ? -std::expm1(-dt / tau) : 1.0;
  parallel_for(filtered.size(), [&](std::size_t r) {
    const RockOnGrid& rock = on_grid[r];
    if (rock.wetted <= 0) {
      filtered[r] = Vec3::Zero();
      return;
    }
    const CouplingLevel& level = grid.level(rock.level);
    decltype(CouplingLevel::Acceleration::lanes) mean{};
    for (std::size_t c = 0; c < 8; ++c)
      mean += rock.place.weight[c] * level.acceleration[static_cast<std::size_t>(rock.place.node[c])].lanes;
    filtered[r] += share * (Vec3(mean[0], mean[1], mean[2]) - gravity - filtered[r]);
  });
}

Coupling::Coupling(const CouplingConfig& config, const Domain& domain, const Vec3& gravity, DemSystem& rocks,
                   FluidSystem& fluid)
    : implementation_(std::make_unique<Implementation>(config, domain, gravity, rocks, fluid)) {}
Coupling::~Coupling() = default;

const ResolvedExtent* Coupling::resolved() const {
  return implementation_->resolved ? &implementation_->resolved->extent() : nullptr;
}

std::vector<RemovedPoint> Coupling::make_room() {
  return resolves() ? implementation_->resolved->make_room() : std::vector<RemovedPoint>{};
}

void Coupling::place_resolved(double dt, int k, int n) {
  implementation_->resolved->place(dt, k, n);
}

void Coupling::take_resolved(double dt, int k, int n) {
  Implementation& c = *implementation_;
  const Vec3 before = c.resolved->impulse();
  c.resolved->take_loads();
  c.on_rocks += c.resolved->impulse() - before;
  c.on_fluid -= c.resolved->impulse() - before;
  if (k + 1 < n) return;
  c.resolved->add_mean_loads(dt, c.filter_time(), c.force, c.torque);
  if (c.config.lubrication != FilmModel::none) c.resolved->add_films(c.wetted, c.nodes, dt, c.force);
  c.rocks.set_fluid_force(c.force, c.torque);
}

void Coupling::solids_to_grid() {
  implementation_->place_rocks();
}

void Coupling::drag(double dt) {
  Implementation& c = *implementation_;
  c.fluid.read_nodes(c.nodes);
  c.grid.gather(c.nodes);
  c.find_saturation();
  c.table.set(c.nodes, c.saturation);
  c.meet_water(dt);
  if (c.config.mode == CouplingMode::two_way) c.add_to_nodes(dt);
  c.solve_nodes();
  c.share_impulses(dt);
  if (c.config.mode == CouplingMode::two_way) c.give_to_fluid();
  c.rocks.set_fluid_force(c.force, c.torque);
  c.rocks.add_wet_dose(c.wetted, dt);
}

void Coupling::fluid_to_grid(double dt) {
  Implementation& c = *implementation_;
  c.fluid.read_accelerations(c.node_acceleration);
  // Drag moves the fluid without a gradient of pressure.
  if (c.config.mode == CouplingMode::two_way)
    parallel_for(c.nodes.count(),
                 [&](std::size_t i) { c.node_acceleration[i] -= c.to_nodes.change_by_drag[i] / dt; });
  c.grid.gather_acceleration(c.nodes, c.node_acceleration);
  c.filter_acceleration(dt);
}

const std::vector<double>& Coupling::wetted_fraction() const {
  return implementation_->wetted;
}
const std::vector<Vec3>& Coupling::drag_force() const {
  return implementation_->drag;
}
const std::vector<Vec3>& Coupling::buoyancy_force() const {
  return implementation_->buoyancy;
}
const std::vector<Vec3>& Coupling::force() const {
  return implementation_->force;
}
const std::vector<Vec3>& Coupling::torque() const {
  return implementation_->torque;
}
const std::vector<WallLoad>& Coupling::film_loads() const {
  static const std::vector<WallLoad> none;
  return resolves() ? implementation_->resolved->film_loads() : none;
}
Vec3 Coupling::impulse_on_rocks() const {
  return implementation_->on_rocks;
}
Vec3 Coupling::impulse_on_fluid() const {
  return implementation_->on_fluid;
}
double Coupling::smallest_kernel_ratio() const {
  return implementation_->kernel_ratio;
}
double Coupling::smallest_void_fraction() const {
  return implementation_->least_void;
}

std::size_t Coupling::memory_bytes() const {
  const Implementation& c = *implementation_;
  return c.grid.memory_bytes() + c.table.memory_bytes() + c.on_grid.capacity() * sizeof(RockOnGrid) +
         (c.resolved ? c.resolved->memory_bytes() : 0);
}

void Coupling::exchange(StateArchive& a) {
  Implementation& c = *implementation_;
  a.values("filter_id", c.filter_id);
  a.values("filtered", c.filtered);
  a.values("wetted", c.wetted);
  a.value("on_rocks", c.on_rocks);
  a.value("on_fluid", c.on_fluid);
  a.value("kernel_ratio", c.kernel_ratio);
  a.value("least_void", c.least_void);
  if (c.resolved) c.resolved->exchange(a);
}

}  // namespace sluice
