#pragma once
/// What every water outlet does alike: count the mass that is due, point by point.
///
/// All points of an emitter have one mass, that of the fluid's own points. Point k is due when k + 1 point
/// masses have been asked for; the open outlets take turns, so that less than one point ever waits,
/// whatever the number of outlets. A point that fell due in the middle of a step starts farther on.

#include <string>
#include <vector>

#include "base/random.h"
#include "fluid/fluid_system.h"
#include "inflow/feed_clock.h"
#include "inflow/inflow.h"

namespace sluice {

class WaterEmitter : public Inflow {
 public:
  const std::string& name() const override { return name_; }
  void advance(double t, double dt) override;
  InflowBudget rock() const override { return {}; }
  InflowBudget water() const override;
  InflowBudget fines() const override { return {}; }
  void exchange(StateArchive& archive) override;
  std::uint64_t points() const { return points_; }  ///< so far

 protected:
  /// One point on its way, relative to the middle of its outlet.
  struct Placed {
    Vec3 x = Vec3::Zero();  ///< [m]
    Vec3 v = Vec3::Zero();  ///< [m/s]
    double J = 1;           ///< below 1 under pressure
  };
  /// @param flow  of all outlets together [m3/s]
  WaterEmitter(std::string name, std::vector<Vec3> outlets, double flow, double start, double stop,
               const InflowTarget& target);
  /// Where point `k` of its outlet is at `t_end`.
  /// @param outlet  number of the outlet;  @param k  number of the point at this outlet
  virtual Placed place(std::size_t outlet, std::uint64_t k, double t_end) = 0;
  /// When point k of an outlet falls due [s].
  double due(std::size_t outlet, std::uint64_t k) const {
    return clock_.time_of(static_cast<double>(k * outlets_.size() + outlet + 1) * point_mass_);
  }

  Random random_;

 private:
  std::string name_;
  std::vector<Vec3> outlets_;
  FluidSystem* fluid_;
  double point_mass_;  ///< [kg]
  FeedClock clock_;
  std::uint64_t points_ = 0;
  double requested_ = 0;  ///< [kg]
  Vec3 momentum_ = Vec3::Zero();
};

/// The fluid of a scene, for an emitter that cannot do without. @throws InputError if there is none
FluidSystem& fluid_of(const InflowTarget& target, const std::string& name, const Location& where);

}  // namespace sluice
