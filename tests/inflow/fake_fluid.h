#pragma once
/// A fluid that only keeps its points: what emitters and exits need.

#include <vector>

#include "fluid/fluid_system.h"

namespace sluice::test {

class FakeFluid : public FluidSystem {
 public:
  explicit FakeFluid(double spacing, FluidModel model = {}) : spacing_(spacing), model_(model) {
    limits_.sound_speed = 20;
  }

  double spacing() const override { return 2 * spacing_; }
  const FluidStepLimits& limits() const override { return limits_; }
  const FluidModel& model() const override { return model_; }
  bool sticks_to_walls() const override { return false; }
  double point_volume() const override { return spacing_ * spacing_ * spacing_; }

  std::uint64_t add(const NewPoint& p) override {
    added_ += static_cast<double>(static_cast<float>(p.mass)) * p.v;
    points_.id.push_back(next_);
    points_.x.push_back(p.x);
    points_.v.push_back(p.v);
    points_.mass.push_back(static_cast<double>(static_cast<float>(p.mass)));
    points_.fines_mass.push_back(static_cast<double>(static_cast<float>(p.fines_mass)));
    points_.J.push_back(p.J);
    points_.pressure.push_back(pressure_of(model_.density, limits_.sound_speed, p.J));
    before_.push_back(p.x);
    return next_++;
  }
  std::size_t count() const override { return points_.count(); }
  WaterPoints points() const override { return points_; }
  /// Moves every point along its velocity.
  void drift(double dt) {
    before_ = points_.x;
    for (std::size_t i = 0; i < count(); ++i) points_.x[i] += dt * points_.v[i];
  }
  std::vector<RemovedPoint> remove_if(
      const std::function<bool(const Vec3& before, const Vec3& now)>& leaves) override {
    std::vector<RemovedPoint> removed;
    WaterPoints kept;
    std::vector<Vec3> kept_before;
    for (std::size_t i = 0; i < count(); ++i) {
      if (leaves(before_[i], points_.x[i])) {
        removed_ += points_.mass[i] * points_.v[i];
        removed.push_back(
            {points_.id[i], points_.x[i], points_.v[i], points_.mass[i], points_.fines_mass[i]});
        continue;
      }
      kept.id.push_back(points_.id[i]);
      kept.x.push_back(points_.x[i]);
      kept.v.push_back(points_.v[i]);
      kept.mass.push_back(points_.mass[i]);
      kept.fines_mass.push_back(points_.fines_mass[i]);
      kept.J.push_back(points_.J[i]);
      kept.pressure.push_back(points_.pressure[i]);
      kept_before.push_back(before_[i]);
    }
    points_ = kept;
    before_ = kept_before;
    return removed;
  }
  std::vector<RemovedPoint> remove_outside() override {
    return remove_if(
        [this](const Vec3&, const Vec3& now) { return !domain.empty() && !domain.contains(now); });
  }

  void points_to_grid(double, double) override {}
  void walls(double) override {}
  void grid_to_points(double dt) override { drift(dt); }
  void read_nodes(FluidNodes& nodes) const override { nodes = {}; }
  void read_accelerations(std::vector<Vec3>& acceleration) const override { acceleration.clear(); }
  void add_impulse(std::span<const Vec3>) override {}
  void set_bodies(std::span<const FluidBody>) override {}
  const std::vector<BodyLoad>& body_loads() const override {
    static const std::vector<BodyLoad> none;
    return none;
  }
  void set_void_fraction(std::span<const double>) override {}
  const std::vector<WallLoad>& wall_loads() const override { return loads_; }
  Vec3 momentum() const override {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < count(); ++i) sum += points_.mass[i] * points_.v[i];
    return sum;
  }
  Vec3 momentum_added() const override { return added_; }
  Vec3 momentum_removed() const override { return removed_; }
  Vec3 impulse_from_gravity() const override { return Vec3::Zero(); }
  double kinetic_energy() const override { return 0; }
  double kinetic_added() const override { return 0; }
  double kinetic_removed() const override { return 0; }
  double wall_work() const override { return 0; }
  double largest_speed() const override { return 0; }
  double total_mass() const override {
    double sum = 0;
    for (double m : points_.mass) sum += m;
    return sum;
  }
  double total_fines() const override {
    double sum = 0;
    for (double m : points_.fines_mass) sum += m;
    return sum;
  }
  std::uint64_t state_hash() const override { return 0; }
  std::size_t memory_bytes() const override { return 0; }
  void exchange(StateArchive&) override {}

  Box domain;  ///< empty: endless

 private:
  double spacing_;
  FluidModel model_;
  FluidStepLimits limits_;
  WaterPoints points_;
  std::vector<Vec3> before_;
  Vec3 added_ = Vec3::Zero(), removed_ = Vec3::Zero();
  std::vector<WallLoad> loads_;
  std::uint64_t next_ = 0;
};

}  // namespace sluice::test
