#pragma once
/// Moisture and fines of a conveyor's feed: slurry that enters at the back of the band and rides the belt.
///
/// Rows of points across the burden, at belt speed, as thick as the slurry layer is (one point at least).

#include "base/random.h"
#include "fluid/fluid_system.h"
#include "inflow/belt_frame.h"
#include "inflow/feed_clock.h"
#include "inflow/inflow.h"

namespace sluice {

class BeltSlurry {
 public:
  /// @param clock  water and fines together;  @param fines_share  of that mass
  BeltSlurry(const BeltFrame& belt, const FeedClock& clock, double fines_share, const InflowTarget& target);
  void advance(double t_end);
  InflowBudget slurry() const;
  InflowBudget fines() const;
  void exchange(StateArchive& archive);

 private:
  BeltFrame belt_;
  FeedClock clock_;
  double fines_share_;
  FluidSystem* fluid_;
  Random random_;
  double spacing_ = 0, point_mass_ = 0, layer_ = 0;
  std::uint64_t rows_ = 1, layers_ = 1;  ///< points across the burden and over its thickness
  std::uint64_t points_ = 0;
  double requested_ = 0, fines_entered_ = 0;
};

}  // namespace sluice
