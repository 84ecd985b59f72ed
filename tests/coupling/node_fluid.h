#pragma once
/// A fluid that is only nodes: what the coupling sees, with nothing else going on.

#include "fluid/fluid_system.h"

namespace sluice {

class NodeFluid : public FluidSystem {
 public:
  /// Nodes at the corners of cubes of `spacing` that fill the box, each full of water at velocity v.
  NodeFluid(const Box& box, double spacing, const Vec3& v) {
    limits_.sound_speed = 50;
    nodes_.spacing = spacing;
    for (double z = box.lo.z(); z < box.hi.z() - 1e-9; z += spacing)
      for (double y = box.lo.y(); y < box.hi.y() - 1e-9; y += spacing)
        for (double x = box.lo.x(); x < box.hi.x() - 1e-9; x += spacing) add_node(Vec3(x, y, z), v);
  }

  void add_node(const Vec3& x, const Vec3& v) {
    const double volume = nodes_.spacing * nodes_.spacing * nodes_.spacing;
    nodes_.x.push_back(x);
    nodes_.mass.push_back(model_.density * volume);
    nodes_.v.push_back(v);
    nodes_.open_volume.push_back(volume);
    nodes_.pressure.push_back(0);
    nodes_.fill.push_back(1);
    nodes_.viscosity.push_back(model_.viscosity);
    nodes_.density.push_back(model_.density);
  }

  FluidNodes nodes_;
  std::vector<Vec3> acceleration_;     ///< of the nodes; empty = none
  std::vector<double> void_fraction_;  ///< as last set
  Vec3 impulse_ = Vec3::Zero();        ///< received since start
  FluidModel model_;
  FluidStepLimits limits_;
  std::vector<WallLoad> loads_;

  double spacing() const override { return nodes_.spacing; }
  const FluidStepLimits& limits() const override { return limits_; }
  const FluidModel& model() const override { return model_; }
  bool sticks_to_walls() const override { return false; }
  double point_volume() const override { return std::pow(nodes_.spacing / 2, 3); }
  std::uint64_t add(const NewPoint&) override { return 0; }
  std::size_t count() const override { return 0; }
  WaterPoints points() const override { return {}; }
  std::vector<RemovedPoint> remove_if(const std::function<bool(const Vec3&, const Vec3&)>&) override {
    return {};
  }
  std::vector<RemovedPoint> remove_outside() override { return {}; }
  void points_to_grid(double, double) override {}
  void walls(double) override {}
  void grid_to_points(double) override {}
  void read_nodes(FluidNodes& nodes) const override { nodes = nodes_; }
  void read_accelerations(std::vector<Vec3>& a) const override {
    a = acceleration_.empty() ? std::vector<Vec3>(nodes_.count(), Vec3::Zero()) : acceleration_;
  }
  void add_impulse(std::span<const Vec3> impulse) override {
    for (std::size_t i = 0; i < impulse.size(); ++i) {
      nodes_.v[i] += impulse[i] / nodes_.mass[i];
      impulse_ += impulse[i];
    }
  }
  void set_bodies(std::span<const FluidBody>) override {}
  const std::vector<BodyLoad>& body_loads() const override {
    static const std::vector<BodyLoad> none;
    return none;
  }
  void set_void_fraction(std::span<const double> v) override { void_fraction_.assign(v.begin(), v.end()); }
  const std::vector<WallLoad>& wall_loads() const override { return loads_; }
  Vec3 momentum() const override {
    Vec3 p = Vec3::Zero();
    for (std::size_t i = 0; i < nodes_.count(); ++i) p += nodes_.mass[i] * nodes_.v[i];
    return p;
  }
  Vec3 impulse_from_gravity() const override { return Vec3::Zero(); }
  Vec3 momentum_added() const override { return Vec3::Zero(); }
  Vec3 momentum_removed() const override { return Vec3::Zero(); }
  double kinetic_energy() const override { return 0; }
  double kinetic_added() const override { return 0; }
  double kinetic_removed() const override { return 0; }
  double wall_work() const override { return 0; }
  double largest_speed() const override { return 0; }
  double total_mass() const override { return 0; }
  double total_fines() const override { return 0; }
  std::uint64_t state_hash() const override { return 0; }
  std::size_t memory_bytes() const override { return 0; }
  void exchange(StateArchive&) override {}
};

}  // namespace sluice
