#include "coupling/coupling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/find_by_id.h"
#include "base/parallel.h"
#include "coupling/coupling_grid.h"
#include "coupling/wetting.h"

namespace sluice {

namespace {

/// Densest random packing of stones; a kernel that finds more has put a rock's volume where it is not.
constexpr double least_void_fraction = 0.3;

/// What one rock has to do with the coupling grid in this exchange.
struct RockOnGrid {
  int level = 0;
  LevelWeights weights;  ///< over all nodes, sum 1
  LevelWeights wet;      ///< times fluid mass, sum 1; unset where dry
  double wetted = 0;
  double take_up = 0;  ///< b of the header [kg]
};

}  // namespace

struct Coupling::Implementation {
  Implementation(const CouplingConfig& c, const Domain& domain, const Vec3& g, DemSystem& r, FluidSystem& f)
      : config(c),
        gravity(g),
        rocks(r),
        fluid(f),
        grid(domain, f.spacing(), c.kernel_diameters * r.scene().smallest_size,
             c.kernel_diameters * r.scene().largest_size),
        table(domain, f.spacing()),
        domain(domain) {
    points = wetting_points(r.shapes(), static_cast<int>(c.wetting_points));
  }

  void place_rocks();
  void find_wetted();
  void evaluate_drag(double dt);
  void solve_nodes();
  void share_impulses(double dt);
  void evaluate_buoyancy(double dt);
  void give_to_fluid();
  double solids_fraction_around(std::size_t rock) const;
  double node_volume(int level, int node) const;

  CouplingConfig config;
  Vec3 gravity;
  DemSystem& rocks;
  FluidSystem& fluid;
  CouplingGrid grid;
  FillTable table;
  Domain domain;
  std::vector<WettingPoints> points;

  FluidNodes nodes;
  std::vector<RockOnGrid> on_grid;
  std::vector<double> wetted;
  std::vector<Vec3> drag, buoyancy, force, torque;
  std::vector<Vec3> node_impulse, node_acceleration;
  std::vector<double> displaced, void_fraction;

  // Filtered Du/Dt - g per rock, kept by id.
  std::vector<std::uint64_t> filter_id;
  std::vector<Vec3> filtered;

  Vec3 on_rocks = Vec3::Zero(), on_fluid = Vec3::Zero();
  double kernel_ratio = 0, least_void = 1;
};

void CouplingConfig::keys(Schema& s) {
  s.choice("mode", mode, {{"two_way", CouplingMode::two_way}, {"one_way", CouplingMode::one_way}},
           {.doc = "one_way: rocks feel the water, the water does not feel the rocks"});
  s.choice("drag", drag,
           {{"di_felice", DragModel::di_felice},
            {"schiller_naumann", DragModel::schiller_naumann},
            {"gidaspow", DragModel::gidaspow}},
           {.doc = "drag law of a rock among others"});
  s.number("kernel_diameters", kernel_diameters,
           {.at_least = 2, .at_most = 16, .doc = "least width of the averaging kernel over the rock's size"});
  s.number("filter_time_factor", filter_time_factor,
           {.at_least = 0,
            .at_most = 100,
            .doc = "buoyancy is low-passed over this many times spacing / sound speed"});
  s.integer("wetting_points", wetting_points,
            {.at_least = 8, .at_most = 256, .doc = "points in each rock that find its wetted fraction"});
}

double Coupling::Implementation::node_volume(int level, int node) const {
  const CouplingLevel& l = grid.level(level);
  const int index[3] = {node % l.nodes.x(), (node / l.nodes.x()) % l.nodes.y(),
                        node / (l.nodes.x() * l.nodes.y())};
  double volume = l.cell_volume();
  for (int k = 0; k < 3; ++k)
    if (!domain.periodic(k) && (index[k] == 0 || index[k] == l.nodes[k] - 1)) volume *= 0.5;
  return volume;
}

void Coupling::Implementation::place_rocks() {
  const Rocks& all = rocks.rocks();
  on_grid.resize(all.count());
  grid.clear_solids();
  for (std::size_t r = 0; r < all.count(); ++r) {
    RockOnGrid& place = on_grid[r];
    place.level = grid.level_for(config.kernel_diameters * all.size[r]);
    place.weights = grid.weights(place.level, all.x[r]);
    const double volume = rocks.volume(r);
    CouplingLevel& level = grid.level(place.level);
    for (std::size_t c = 0; c < 8; ++c)
      level.solids[static_cast<std::size_t>(place.weights.node[c])] += place.weights.weight[c] * volume;
    const double ratio = grid.kernel_width(place.level) / all.size[r];
    kernel_ratio = kernel_ratio == 0 ? ratio : std::min(kernel_ratio, ratio);
  }
}

// Solids fraction that the other rocks make around this one: a rock is not in its own way. Rocks of
// other levels count through their own level's nodes.
double Coupling::Implementation::solids_fraction_around(std::size_t r) const {
  const RockOnGrid& place = on_grid[r];
  const double own = rocks.volume(r);
  double fraction = 0;
  for (int l = 0; l < grid.level_count(); ++l) {
    if (!grid.in_use(l)) continue;
    const LevelWeights w = l == place.level ? place.weights : grid.weights(l, rocks.rocks().x[r]);
    for (std::size_t c = 0; c < 8; ++c) {
      double volume = grid.level(l).solids[static_cast<std::size_t>(w.node[c])];
      if (l == place.level) volume -= w.weight[c] * own;
      fraction += w.weight[c] * std::max(0.0, volume) / node_volume(l, w.node[c]);
    }
  }
  return fraction;
}

void Coupling::Implementation::find_wetted() {
  const Rocks& all = rocks.rocks();
  wetted.assign(all.count(), 0.0);
  parallel_for(
      all.count(),
      [&](std::size_t r) {
        RockOnGrid& place = on_grid[r];
        place.wetted = 0;
        const CouplingLevel& level = grid.level(place.level);
        double sum = 0;
        place.wet = place.weights;
        for (std::size_t c = 0; c < 8; ++c) {
          place.wet.weight[c] *= level.mass[static_cast<std::size_t>(place.wet.node[c])];
          sum += place.wet.weight[c];
        }
        if (sum <= 0) return;
        for (double& w : place.wet.weight) w /= sum;
        place.wetted = table.wetted_fraction(points[static_cast<std::size_t>(all.shape[r])], all.x[r],
                                             all.q[r].toRotationMatrix() * all.size[r], all.radius[r]);
        wetted[r] = place.wetted;
      },
      64);
}

void Coupling::Implementation::evaluate_drag(double dt) {
  const Rocks& all = rocks.rocks();
  parallel_for(
      all.count(),
      [&](std::size_t r) {
        RockOnGrid& place = on_grid[r];
        place.take_up = 0;
        if (place.wetted <= 0) return;
        const CouplingLevel& level = grid.level(place.level);
        double mass = 0, density = 0, viscosity = 0;
        Vec3 momentum = Vec3::Zero();
        for (std::size_t c = 0; c < 8; ++c) {
          const auto n = static_cast<std::size_t>(place.weights.node[c]);
          const double w = place.weights.weight[c];
          mass += w * level.mass[n];
          momentum += w * level.momentum[n];
          density += w * level.density[n];
          viscosity += w * level.viscosity[n];
        }
        DragInput in;
        in.density = density / mass;
        in.viscosity = viscosity / mass;
        in.diameter = std::cbrt(6 / std::numbers::pi * rocks.volume(r));
        in.void_fraction = std::max(least_void_fraction, 1 - solids_fraction_around(r));
        in.speed = (momentum / mass - all.v[r]).norm();
        const double beta = place.wetted * drag_per_speed(config.drag, in);
        place.take_up = -all.mass[r] * std::expm1(-beta * dt / all.mass[r]);
      },
      64);
}

void Coupling::Implementation::solve_nodes() {
  const Rocks& all = rocks.rocks();
  for (std::size_t r = 0; r < all.count(); ++r) {
    const RockOnGrid& place = on_grid[r];
    if (place.take_up <= 0) continue;
    CouplingLevel& level = grid.level(place.level);
    for (std::size_t c = 0; c < 8; ++c) {
      const auto n = static_cast<std::size_t>(place.wet.node[c]);
      const double b = place.take_up * place.wet.weight[c];
      level.drag_sum[n] += b;
      level.drag_rock_momentum[n] += b * all.v[r];
    }
  }
}

void Coupling::Implementation::share_impulses(double dt) {
  const Rocks& all = rocks.rocks();
  const bool two_way = config.mode == CouplingMode::two_way;
  drag.assign(all.count(), Vec3::Zero());
  for (std::size_t r = 0; r < all.count(); ++r) {
    const RockOnGrid& place = on_grid[r];
    if (place.take_up <= 0) continue;
    CouplingLevel& level = grid.level(place.level);
    Vec3 total = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c) {
      const auto n = static_cast<std::size_t>(place.wet.node[c]);
      const double b = place.take_up * place.wet.weight[c];
      if (b <= 0) continue;
      const Vec3 u =
          two_way
              ? Vec3((level.momentum[n] + level.drag_rock_momentum[n]) / (level.mass[n] + level.drag_sum[n]))
              : Vec3(level.momentum[n] / level.mass[n]);
      const Vec3 impulse = b * (u - all.v[r]);
      total += impulse;
      if (two_way) level.impulse[n] -= impulse;
    }
    drag[r] = total / dt;
  }
}

// The filtered acceleration is evaluated in fluid_to_grid; here it becomes an impulse on both sides.
void Coupling::Implementation::evaluate_buoyancy(double dt) {
  const Rocks& all = rocks.rocks();
  const bool two_way = config.mode == CouplingMode::two_way;
  buoyancy.assign(all.count(), Vec3::Zero());
  FindById earlier(filter_id);
  for (std::size_t r = 0; r < all.count(); ++r) {
    const RockOnGrid& place = on_grid[r];
    if (place.wetted <= 0) continue;
    CouplingLevel& level = grid.level(place.level);
    double mass = 0, density = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      const auto n = static_cast<std::size_t>(place.weights.node[c]);
      mass += place.weights.weight[c] * level.mass[n];
      density += place.weights.weight[c] * level.density[n];
    }
    const auto known = earlier.find(all.id[r]);
    const Vec3 lift = known ? filtered[*known] : Vec3(0, 0, 0);
    const double displaced_volume = place.wetted * rocks.volume(r);
    buoyancy[r] = displaced_volume * density / mass * lift;
    if (!two_way) continue;
    for (std::size_t c = 0; c < 8; ++c) {
      const auto n = static_cast<std::size_t>(place.wet.node[c]);
      level.impulse[n] -= place.wet.weight[c] * dt * buoyancy[r];
      level.displaced[n] += place.wet.weight[c] * displaced_volume;
    }
  }
}

void Coupling::Implementation::give_to_fluid() {
  grid.scatter(nodes, node_impulse, displaced);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : node_impulse) sum += p;
  on_fluid += sum;
  fluid.add_impulse(node_impulse);
  void_fraction.assign(nodes.count(), 1.0);
  for (std::size_t i = 0; i < nodes.count(); ++i) {
    if (displaced[i] <= 0 || nodes.open_volume[i] <= 0) continue;
    void_fraction[i] = std::max(least_void_fraction, 1 - displaced[i] / nodes.open_volume[i]);
    least_void = std::min(least_void, void_fraction[i]);
  }
  fluid.set_void_fraction(void_fraction);
}

Coupling::Coupling(const CouplingConfig& config, const Domain& domain, const Vec3& gravity, DemSystem& rocks,
                   FluidSystem& fluid)
    : implementation_(std::make_unique<Implementation>(config, domain, gravity, rocks, fluid)) {}
Coupling::~Coupling() = default;

void Coupling::solids_to_grid() {
  implementation_->place_rocks();
}

void Coupling::drag(double dt) {
  Implementation& c = *implementation_;
  const std::size_t count = c.rocks.rocks().count();
  c.fluid.read_nodes(c.nodes);
  c.grid.gather(c.nodes);
  c.table.set(c.nodes);
  c.find_wetted();
  c.evaluate_drag(dt);
  c.solve_nodes();
  c.share_impulses(dt);
  c.evaluate_buoyancy(dt);
  if (c.config.mode == CouplingMode::two_way) c.give_to_fluid();
  c.force.resize(count);
  c.torque.assign(count, Vec3::Zero());
  for (std::size_t r = 0; r < count; ++r) {
    c.force[r] = c.drag[r] + c.buoyancy[r];
    c.on_rocks += dt * c.force[r];
  }
  c.rocks.set_fluid_force(c.force, c.torque);
  c.rocks.add_wet_dose(c.wetted, dt);
}

void Coupling::fluid_to_grid(double dt) {
  Implementation& c = *implementation_;
  const Rocks& all = c.rocks.rocks();
  c.fluid.read_accelerations(c.node_acceleration);
  c.grid.gather_acceleration(c.nodes, c.node_acceleration);
  const double tau = c.config.filter_time_factor * c.fluid.spacing() / c.fluid.limits().sound_speed;
  const double share = tau > 0 ? -std::expm1(-dt / tau) : 1.0;
  std::vector<std::uint64_t> id;
  std::vector<Vec3> lift;
  FindById earlier(c.filter_id);
  for (std::size_t r = 0; r < all.count() && r < c.on_grid.size(); ++r) {
    const RockOnGrid& place = c.on_grid[r];
    if (place.wetted <= 0) continue;
    const CouplingLevel& level = c.grid.level(place.level);
    double mass = 0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 8; ++k) {
      const auto n = static_cast<std::size_t>(place.weights.node[k]);
      mass += place.weights.weight[k] * level.mass[n];
      sum += place.weights.weight[k] * level.acceleration[n];
    }
    const Vec3 now = sum / mass - c.gravity;
    const auto known = earlier.find(all.id[r]);
    id.push_back(all.id[r]);
    lift.push_back(known ? Vec3(c.filtered[*known] + share * (now - c.filtered[*known])) : Vec3(share * now));
  }
  c.filter_id = std::move(id);
  c.filtered = std::move(lift);
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
  return c.grid.memory_bytes() + c.table.memory_bytes() + c.on_grid.capacity() * sizeof(RockOnGrid);
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
}

}  // namespace sluice
