#include "coupling/resolved_rocks.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace sluice {

namespace {

/// A smaller core holds back water as a far larger one would [cells].
constexpr double least_core = 2;

Pose part_way(const Pose& from, const Pose& to, const Twist& twist, double time, double share) {
  if (share <= 0) return from;
  if (share >= 1) return to;
  const Vec3 turn = share * time * twist.w;
  Pose pose;
  pose.at = from.at + share * (to.at - from.at);
  const double angle = turn.norm();
  pose.q = angle > 0 ? Quat(Eigen::AngleAxisd(angle, Vec3(turn / angle))) * from.q : from.q;
  return pose;
}

}  // namespace

ResolvedRocks::ResolvedRocks(double partly_from, double from, DemSystem& rocks, FluidSystem& fluid)
    : extent_{partly_from, from}, rocks_(rocks), fluid_(fluid) {}

double ResolvedRocks::core(std::size_t rock) const {
  const double size = rocks_.rocks().size[rock];
  if (size >= extent_.from) return 1;
  const double core = (size - extent_.partly_from) / (extent_.from - extent_.partly_from);
  return core * size >= least_core * fluid_.spacing() ? core : 0;
}

void ResolvedRocks::follow_rocks(double dt) {
  const Rocks& all = rocks_.rocks();
  const Domain& domain = rocks_.scene().domain;
  rock_of_.clear();
  for (std::size_t r = 0; r < all.count(); ++r)
    if (core(r) > 0) rock_of_.push_back(r);
  std::sort(rock_of_.begin(), rock_of_.end(),
            [&](std::size_t a, std::size_t b) { return all.id[a] < all.id[b]; });
  std::vector<Held> now;
  now.reserve(rock_of_.size());
  auto known = held_.begin();
  for (const std::size_t r : rock_of_) {
    while (known != held_.end() && known->id < all.id[r]) ++known;
    Held held{all.id[r],   {all.q[r], Vec3::Zero(), all.x[r]}, {all.q[r], Vec3::Zero(), all.x[r]}, {}, {},
              Vec3::Zero()};
    held.last = held.twist = {all.v[r], all.w[r], all.x[r]};  // a new one moves from the next step on
    if (known != held_.end() && known->id == held.id) {
      // Through a periodic face it came from the image on this side.
      const Vec3 before = held.now.at + domain.nearest_image(known->now.at - held.now.at);
      held.last = known->twist;
      held.last.at += before - known->now.at;
      held.before = known->now;
      held.force = known->force;
      held.before.at = before;
      held.twist = twist_between(held.before, held.now, dt);
      if (rocks_.shapes()[static_cast<std::size_t>(all.shape[r])].is_sphere())
        held.twist.w = all.w[r];  // its orientation is not kept
    }
    now.push_back(held);
  }
  held_ = std::move(now);
  const auto whole = static_cast<std::uint64_t>(
      std::count_if(rock_of_.begin(), rock_of_.end(), [&](std::size_t r) { return core(r) == 1; }));
  extent_.most_whole = std::max(extent_.most_whole, whole);
  extent_.most_partly = std::max(extent_.most_partly, rock_of_.size() - whole);
}

void ResolvedRocks::place(double dt, int k, int n) {
  if (k == 0) {
    follow_rocks(dt);
    loads_.assign(held_.size(), {});
  }
  const Rocks& all = rocks_.rocks();
  bodies_.clear();
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const Held& held = held_[i];
    const std::size_t r = rock_of_[i];
    FluidBody body;
    const double part = core(r);
    body.semi_axes = part * rocks_.semi_axes(r);
    body.blockiness = rocks_.shapes()[static_cast<std::size_t>(all.shape[r])].blockiness;
    body.reach = part * all.radius[r];
    body.now = part_way(held.before, held.now, held.twist, dt, static_cast<double>(k) / n);
    body.next = part_way(held.before, held.now, held.twist, dt, static_cast<double>(k + 1) / n);
    body.twist = held.twist;
    // Each substep has its part of the step's change.
    body.last = held.twist;
    body.last.v += (held.last.velocity(held.twist.at) - held.twist.v) / n;
    body.last.w += (held.last.w - held.twist.w) / n;
    bodies_.push_back(body);
  }
  fluid_.set_bodies(bodies_);
}

void ResolvedRocks::take_loads() {
  const std::vector<BodyLoad>& loads = fluid_.body_loads();
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    loads_[i].impulse += loads[i].impulse;
    loads_[i].angular_impulse += loads[i].angular_impulse;
    impulse_ += loads[i].impulse;
  }
}

void ResolvedRocks::add_mean_loads(double dt, double tau, std::vector<Vec3>& force,
                                   std::vector<Vec3>& torque) {
  const double share = tau > 0 ? -std::expm1(-dt / tau) : 1.0;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    held_[i].force += share * (loads_[i].impulse / dt - held_[i].force);
    force[rock_of_[i]] += loads_[i].impulse / dt;
    torque[rock_of_[i]] += loads_[i].angular_impulse / dt;
  }
}

void ResolvedRocks::use_lubrication(double roughness) {
  lubrication_.emplace(rocks_, rocks_.wall_loads().size(), fluid_.spacing(), roughness);
}

void ResolvedRocks::add_films(const std::vector<double>& wetted, const FluidNodes& nodes, double dt,
                              std::vector<Vec3>& force) {
  if (!lubrication_ || rock_of_.empty()) return;
  const auto sum = [&](const auto& of) { return parallel_sum<double>(nodes.count(), of, 0.0); };
  const double mass = sum([&](std::size_t i) { return nodes.mass[i]; });
  const double moment = sum([&](std::size_t i) { return nodes.mass[i] * nodes.density[i]; });
  const double fines = mass > 0 ? fines_fraction(fluid_.model(), moment / mass) : 0;
  std::vector<FilmRock> in_films;
  for (const std::size_t r : rock_of_)
    if (wetted[r] > 0) in_films.push_back({r, core(r) * wetted[r]});
  lubrication_->add(in_films, fluid_.model(), fines, dt, force);
}

const std::vector<WallLoad>& ResolvedRocks::film_loads() const {
  static const std::vector<WallLoad> none;
  return lubrication_ ? lubrication_->wall_loads() : none;
}

void ResolvedRocks::filtered_force(std::vector<Vec3>& force) const {
  force.assign(rocks_.rocks().count(), Vec3::Zero());
  for (std::size_t i = 0; i < held_.size(); ++i) force[rock_of_[i]] = held_[i].force;
}

std::vector<RemovedPoint> ResolvedRocks::make_room() {
  const Rocks& all = rocks_.rocks();
  struct Body {
    Vec3 x, semi_axes;
    Quat to_body;
    double m, radius;
  };
  std::vector<Body> inside;
  for (std::size_t r = 0; r < all.count(); ++r) {
    const double part = core(r);
    if (part == 0) continue;
    const RockShape& shape = rocks_.shapes()[static_cast<std::size_t>(all.shape[r])];
    inside.push_back(
        {all.x[r], part * rocks_.semi_axes(r), all.q[r].conjugate(), shape.blockiness, part * all.radius[r]});
  }
  if (inside.empty()) return {};
  const Domain& domain = rocks_.scene().domain;
  return fluid_.remove_if([&](const Vec3&, const Vec3& x) {
    return std::any_of(inside.begin(), inside.end(), [&](const Body& body) {
      const Vec3 d = domain.nearest_image(x - body.x);
      return d.squaredNorm() < body.radius * body.radius &&
             superquadric_function(body.semi_axes, body.m, body.to_body * d) < 1;
    });
  });
}

std::size_t ResolvedRocks::memory_bytes() const {
  return held_.capacity() * sizeof(Held) + bodies_.capacity() * sizeof(FluidBody);
}

void ResolvedRocks::exchange(StateArchive& a) {
  // What follow_rocks asks of the last step.
  std::vector<std::uint64_t> id;
  std::vector<Vec3> at, v, w, from, force;
  std::vector<Quat> q;
  for (const Held& held : held_) {
    id.push_back(held.id);
    at.push_back(held.now.at);
    q.push_back(held.now.q);
    v.push_back(held.twist.v);
    w.push_back(held.twist.w);
    from.push_back(held.twist.at);
    force.push_back(held.force);
  }
  a.values("held_id", id);
  a.values("held_at", at);
  a.values("held_q", q);
  a.values("held_v", v);
  a.values("held_w", w);
  a.values("held_from", from);
  a.values("held_force", force);
  a.value("resolved_impulse", impulse_);
  a.value("most_whole", extent_.most_whole);
  if (lubrication_) lubrication_->exchange(a);
  a.value("most_partly", extent_.most_partly);
  held_.resize(id.size());
  for (std::size_t i = 0; i < id.size(); ++i) {
    held_[i].id = id[i];
    held_[i].now = {q[i], Vec3::Zero(), at[i]};
    held_[i].twist = {v[i], w[i], from[i]};
    held_[i].force = force[i];
  }
}

}  // namespace sluice
