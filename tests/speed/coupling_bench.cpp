/// Speed of the exchange between 50 000 rocks and a million points of water: rocks at rest in a stream, in a
/// periodic box. The first exchange is checked against the formulas of coupling.h, written out plainly.

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "coupling/coupling.h"
#include "mpm/mpm_system.h"
#include "speed/speed.h"

namespace sluice::speed {
namespace {

constexpr double h = 0.01, side = 0.5;  // [m]
constexpr double size = 0.008;          // kernel of 4 sizes: nodes 0.02 m apart
constexpr int cells = 25;               // of the coupling grid, per axis
constexpr double node_distance = side / cells;
constexpr std::size_t rock_count = 50000;
const Vec3 stream(0.5, 0.3, 0.2);  // [m/s]

/// Trilinear weights in a periodic box.
struct Around {
  std::array<std::size_t, 8> node;
  std::array<double, 8> weight;
  explicit Around(const Vec3& x) {
    for (std::size_t c = 0; c < 8; ++c) {
      std::size_t index = 0, stride = 1;
      weight[c] = 1;
      for (int k = 0; k < 3; ++k, stride *= cells) {
        const double place = x[k] / node_distance, low = std::floor(place), share = place - low;
        const int upper = static_cast<int>(c >> k) & 1;
        weight[c] *= upper ? share : 1 - share;
        index += stride * static_cast<std::size_t>((static_cast<int>(low) + upper + cells) % cells);
      }
      node[c] = index;
    }
  }
};

/// Drag on each rock [N]. @param wetted  share of each rock in water
std::vector<Vec3> plain_drag(const DemSystem& dem, const FluidNodes& water, const std::vector<double>& wetted,
                             double dt) {
  struct Node {
    double solids = 0, mass = 0, density = 0, viscosity = 0, taken = 0;
    Vec3 momentum = Vec3::Zero(), taken_momentum = Vec3::Zero();
  };
  std::vector<Node> nodes(static_cast<std::size_t>(cells * cells * cells));
  const Rocks& rocks = dem.rocks();
  for (std::size_t r = 0; r < rocks.count(); ++r) {
    const Around around(rocks.x[r]);
    for (std::size_t c = 0; c < 8; ++c) nodes[around.node[c]].solids += around.weight[c] * dem.volume(r);
  }
  for (std::size_t i = 0; i < water.count(); ++i) {
    const Around around(water.x[i]);
    for (std::size_t c = 0; c < 8; ++c) {
      Node& node = nodes[around.node[c]];
      const double mass = around.weight[c] * water.mass[i];
      node.mass += mass;
      node.momentum += mass * water.v[i];
      node.density += mass * water.density[i];
      node.viscosity += mass * water.viscosity[i];
    }
  }

  std::vector<double> take_up(rocks.count());
  const auto shares = [&](std::size_t r) {
    Around wet(rocks.x[r]);
    double sum = 0;
    for (std::size_t c = 0; c < 8; ++c) sum += wet.weight[c] *= nodes[wet.node[c]].mass;
    for (double& w : wet.weight) w /= sum;
    return wet;
  };
  for (std::size_t r = 0; r < rocks.count(); ++r) {
    const Around around(rocks.x[r]);
    double mass = 0, density = 0, viscosity = 0, others = 0;
    Vec3 momentum = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c) {
      const Node& node = nodes[around.node[c]];
      const double w = around.weight[c];
      mass += w * node.mass;
      momentum += w * node.momentum;
      density += w * node.density;
      viscosity += w * node.viscosity;
      others += w * (node.solids - w * dem.volume(r)) / std::pow(node_distance, 3);
    }
    density /= mass;
    viscosity /= mass;
    // Di Felice (1994)
    const double u = (momentum / mass - rocks.v[r]).norm(), open = 1 - others, d = rocks.size[r];
    const double re = density * open * u * d / viscosity;
    const double chi = 3.7 - 0.65 * std::exp(-0.5 * std::pow(1.5 - std::log10(re), 2));
    const double drag_coefficient = std::pow(0.63 + 4.8 / std::sqrt(re), 2);
    const double beta = wetted[r] * 0.5 * drag_coefficient * density * u * std::numbers::pi / 4 * d * d *
                        std::pow(open, 2 - chi);
    take_up[r] = rocks.mass[r] * (1 - std::exp(-beta * dt / rocks.mass[r]));
    const Around wet = shares(r);
    for (std::size_t c = 0; c < 8; ++c) {
      nodes[wet.node[c]].taken += take_up[r] * wet.weight[c];
      nodes[wet.node[c]].taken_momentum += take_up[r] * wet.weight[c] * rocks.v[r];
    }
  }

  std::vector<Vec3> drag(rocks.count(), Vec3::Zero());
  for (std::size_t r = 0; r < rocks.count(); ++r) {
    const Around wet = shares(r);
    for (std::size_t c = 0; c < 8; ++c) {
      const Node& node = nodes[wet.node[c]];
      const Vec3 u = (node.momentum + node.taken_momentum) / (node.mass + node.taken);
      drag[r] += take_up[r] * wet.weight[c] * (u - rocks.v[r]) / dt;
    }
  }
  return drag;
}

class CouplingBench {
 public:
  void operator()(benchmark::State& state) {
    if (!coupling_) set_up();
    coupling_seconds_ = 0;
    const double seconds = time_steps(state, [&] { step(); });
    const Vec3 given = coupling_->impulse_on_rocks(), taken = coupling_->impulse_on_fluid();
    if (!((given + taken).norm() < 1e-12 * given.norm())) wrong_ = "the impulses on both sides differ";
    if (!wrong_.empty()) return state.SkipWithError(wrong_.c_str());
    const double steps = static_cast<double>(state.iterations());
    state.counters["ms_per_step"] = 1e3 * coupling_seconds_ / steps;
    state.counters["ms_per_whole_step"] = 1e3 * seconds / steps;
    state.counters["worst_departure"] = worst_;
  }

 private:
  template <class Call>
  void timed(const Call& call) {
    const Stopwatch watch;
    call();
    coupling_seconds_ += watch.seconds();
  }

  void step() {
    const double dt = water_->limits().step;
    timed([&] { coupling_->solids_to_grid(); });
    water_->points_to_grid(t_, dt);
    timed([&] { coupling_->drag(dt); });
    water_->walls(dt);
    water_->grid_to_points(dt);
    timed([&] { coupling_->fluid_to_grid(dt); });
    dem_->step(t_, std::min(dt, dem_->step_size()));
    t_ += dt;
  }

  void set_up();
  void check_first_exchange();

  Walls none_;
  std::unique_ptr<FluidSystem> water_;
  std::unique_ptr<DemSystem> dem_;
  std::unique_ptr<Coupling> coupling_;
  double t_ = 0, worst_ = 0, coupling_seconds_ = 0;
  std::string wrong_;
};

void CouplingBench::set_up() {
  Domain domain;
  domain.box = {Vec3::Zero(), Vec3::Constant(side)};
  domain.low.fill(Face::periodic);
  domain.high.fill(Face::periodic);
  Random random(4);

  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 1;
  water_ = make_mpm(config, domain, Vec3::Zero(), none_);
  const int n = static_cast<int>(std::lround(2 * side / h));
  for (int k = 0; k < n * n * n; ++k) {
    NewPoint point;
    point.x = 0.5 * h * (Vec3(k % n, k / n % n, k / (n * n)) + Vec3::Constant(0.5));
    for (int d = 0; d < 3; ++d) point.x[d] += 0.1 * h * random.uniform(-1, 1);
    point.v = stream;
    point.mass = 1000 * std::pow(0.5 * h, 3);
    water_->add(point);
  }

  DemScene scene;
  scene.materials.all = {{"rock", 2700}};
  scene.materials.pairs = {{}};
  scene.shapes = {make_sphere()};
  scene.smallest_size = scene.largest_size = size;
  scene.densest = 2700;
  scene.gravity.setZero();
  scene.domain = domain;
  dem_ = std::make_unique<DemSystem>(DemConfig{}, scene, none_);
  const int rows = static_cast<int>(std::ceil(std::cbrt(rock_count)));
  for (std::size_t i = 0; i < rock_count; ++i) {
    const int k = static_cast<int>(i);
    const Vec3 place = Vec3(k % rows, k / rows % rows, k / (rows * rows)) + Vec3::Constant(0.5);
    dem_->add({.x = side / rows * (place + 0.15 * random.on_sphere()),
               .v = 0.05 * random.on_sphere(),
               .size = size});
  }
  coupling_ = std::make_unique<Coupling>(CouplingConfig{}, domain, Vec3::Zero(), *dem_, *water_);
  check_first_exchange();
}

void CouplingBench::check_first_exchange() {
  const double dt = water_->limits().step;
  coupling_->solids_to_grid();
  water_->points_to_grid(0, dt);
  FluidNodes nodes;
  water_->read_nodes(nodes);
  coupling_->drag(dt);
  const std::vector<double>& wetted = coupling_->wetted_fraction();
  const std::vector<Vec3> reference = plain_drag(*dem_, nodes, wetted, dt);
  for (std::size_t r = 0; r < reference.size(); ++r) {
    worst_ = std::max(worst_, (coupling_->drag_force()[r] - reference[r]).norm() / reference[r].norm());
    if (!(wetted[r] > 0.9)) wrong_ = fmt::format("rock {} is only {} in water", r, wetted[r]);
  }
  if (!(worst_ < 1e-9)) wrong_ = fmt::format("drag departs from the plain formulas by {:.2g}", worst_);
  water_->walls(dt);
  water_->grid_to_points(dt);
  coupling_->fluid_to_grid(dt);
  t_ = dt;
}

const bool registered = [] {
  benchmark::RegisterBenchmark("coupling/step_50k_1m", CouplingBench())->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace sluice::speed
