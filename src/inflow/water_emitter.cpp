#include "inflow/water_emitter.h"

#include "base/errors.h"

namespace sluice {

FluidSystem& fluid_of(const InflowTarget& target, const std::string& name, const Location& where) {
  if (target.water == nullptr)
    throw InputError(InputProblem{where, name, "gives water", "the process has no 'water' section",
                                  "add 'water' or take the entry out"});
  return *target.water;
}

WaterEmitter::WaterEmitter(std::string name, std::vector<Vec3> outlets, double flow, double start,
                           double stop, const InflowTarget& target)
    : random_(target.seed, static_cast<std::uint64_t>(target.index)),
      name_(std::move(name)),
      outlets_(std::move(outlets)),
      fluid_(target.water),
      point_mass_(stored_mass(fluid_->point_volume() * fluid_->model().density)),
      clock_{fluid_->model().density * flow, start, stop} {}

void WaterEmitter::advance(double t, double dt) {
  const double t_end = t + dt;
  requested_ = clock_.requested(t_end);
  while (requested_ >= static_cast<double>(points_ + 1) * point_mass_) {
    const std::size_t outlet = points_ % outlets_.size();
    const Placed p = place(outlet, points_ / outlets_.size(), t_end);
    fluid_->add({.x = outlets_[outlet] + p.x, .v = p.v, .mass = point_mass_, .J = p.J});
    momentum_ += point_mass_ * p.v;
    ++points_;
  }
}

InflowBudget WaterEmitter::water() const {
  const double entered = static_cast<double>(points_) * point_mass_;
  return {requested_, entered, requested_ - entered, momentum_};
}

void WaterEmitter::exchange(StateArchive& archive) {
  archive.value("points", points_);
  archive.value("requested", requested_);
  archive.value("momentum", momentum_);
  archive.value("random", random_.state);
}

}  // namespace sluice
