#include "dem/dem_system.h"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>

#include "base/parallel.h"
#include "base/random.h"
#include "dem/dem_state.h"

namespace sluice {

namespace {
std::uint64_t mix(std::uint64_t hash, double value) {
  return mix64(hash ^ std::bit_cast<std::uint64_t>(value));
}
struct VecSum {
  Vec3 value = Vec3::Zero();
  VecSum& operator+=(const VecSum& other) {
    value += other.value;
    return *this;
  }
};
}  // namespace

DemSystem::DemSystem(const DemConfig& config, DemScene scene, const Walls& walls)
    : implementation_(std::make_unique<Implementation>(config, std::move(scene), walls)) {}
DemSystem::~DemSystem() = default;

const Rocks& DemSystem::rocks() const {
  return implementation_->rocks;
}
const std::vector<RockShape>& DemSystem::shapes() const {
  return implementation_->scene.shapes;
}
const Materials& DemSystem::materials() const {
  return implementation_->scene.materials;
}
const DemScene& DemSystem::scene() const {
  return implementation_->scene;
}
const DemStepLimits& DemSystem::limits() const {
  return implementation_->limits;
}
Vec3 DemSystem::semi_axes(std::size_t rock) const {
  return implementation_->shape_of(rock).semi_axes * rocks().size[rock];
}
Vec3 DemSystem::inertia(std::size_t rock) const {
  return implementation_->inertia(rock);
}
double DemSystem::volume(std::size_t rock) const {
  const double size = rocks().size[rock];
  return implementation_->shape_of(rock).volume * size * size * size;
}

void DemSystem::step(double t, double dt) {
  steps(t, dt, 1);
}
void DemSystem::steps(double t, double dt, int n) {
  // The speed of a moving wall is what it moves over a step: there is none over no time.
  if (!(dt > 0) && !(dt == 0 && implementation_->moving.empty()))
    throw std::invalid_argument(fmt::format("rocks cannot take a step of {} s", dt));
  implementation_->steps_of(t, dt, n);
}

std::size_t DemSystem::contact_count() const {
  std::uint64_t sum = 0;
  for (const DemChunk& chunk : implementation_->chunks) sum += chunk.contacts;
  return sum;
}

const Histogram& DemSystem::overlaps() const {
  return implementation_->overlap_histogram;
}
double DemSystem::overlap_mean() const {
  const Implementation& s = *implementation_;
  return s.overlap_count > 0 ? s.overlap_sum / s.overlap_count : 0;
}
double DemSystem::overlap_max() const {
  double most = 0;
  for (const DemChunk& chunk : implementation_->chunks) most = std::max(most, chunk.overlap_most);
  return 100 * most;
}

const std::vector<WallLoad>& DemSystem::wall_loads() const {
  const Implementation& s = *implementation_;
  s.load_sums.assign(s.walls.size(), {});
  for (const DemChunk& chunk : s.chunks)
    for (std::size_t w = 0; w < s.walls.size(); ++w) {
      s.load_sums[w].impulse += chunk.loads[w].impulse;
      s.load_sums[w].angular_impulse += chunk.loads[w].angular_impulse;
      s.load_sums[w].sliding_energy += chunk.loads[w].sliding_energy;
      s.load_sums[w].impact_energy += chunk.loads[w].impact_energy;
    }
  return s.load_sums;
}

DemEnergy DemSystem::energy() const {
  const Implementation& s = *implementation_;
  const Rocks& r = s.rocks;
  DemEnergy energy;
  energy.kinetic = parallel_sum<double>(s.count(), [&](std::size_t i) {
    const Vec3 w_body = r.q[i].conjugate() * r.w[i];
    return 0.5 * r.mass[i] * r.v[i].squaredNorm() + 0.5 * w_body.cwiseAbs2().dot(s.inertia(i));
  });
  energy.potential = parallel_sum<double>(
      s.count(), [&](std::size_t i) { return -r.mass[i] * s.scene.gravity.dot(r.x[i]); });
  for (const DemChunk& chunk : s.chunks) {
    energy.elastic += chunk.elastic;
    energy.dissipated_normal += chunk.lost_normal;
    energy.dissipated_friction += chunk.lost_friction;
    energy.wall_work += chunk.wall_work;
    energy.fluid_work += chunk.fluid_work;
  }
  return energy;
}

Vec3 DemSystem::momentum() const {
  const Rocks& r = rocks();
  return parallel_sum<VecSum>(r.count(), [&](std::size_t i) { return VecSum{r.mass[i] * r.v[i]}; }).value;
}
Vec3 DemSystem::impulse_from_gravity() const {
  double mass_seconds = 0;
  for (const DemChunk& chunk : implementation_->chunks) mass_seconds += chunk.mass_seconds;
  return mass_seconds * scene().gravity;
}
Vec3 DemSystem::impulse_from_fluid() const {
  Vec3 sum = Vec3::Zero();
  for (const DemChunk& chunk : implementation_->chunks) sum += chunk.fluid_impulse;
  return sum;
}

std::uint64_t DemSystem::state_hash() const {
  const Rocks& r = rocks();
  return parallel_sum<std::uint64_t>(r.count(), [&](std::size_t i) {
    std::uint64_t hash = mix64(r.id[i]);
    for (const Vec3* v : {&r.x[i], &r.v[i], &r.w[i]})
      for (int k = 0; k < 3; ++k) hash = mix(hash, (*v)[k]);
    for (int k = 0; k < 4; ++k) hash = mix(hash, r.q[i].coeffs()[k]);
    return hash;
  });
}

std::size_t DemSystem::memory_bytes() const {
  return implementation_->memory_bytes();
}
void DemSystem::exchange(StateArchive& archive) {
  implementation_->exchange(archive);
}

}  // namespace sluice
