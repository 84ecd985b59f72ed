#pragma once
/// Where rock and water come from. Every inflow is exact in mass: what entered is rate x time less what
/// waits, to rounding; what waits is carried over, never dropped.

#include <string>

#include "base/state_archive.h"

namespace sluice {

/// Mass of one phase through one inflow since the start [kg].
struct InflowBudget {
  double requested = 0;  ///< rate x time
  double entered = 0;    ///< as stored by the system that took it, summed in double
  double waiting = 0;    ///< not yet placed: requested - entered
};

class Inflow {
 public:
  virtual ~Inflow() = default;
  virtual const std::string& name() const = 0;
  virtual const char* kind() const = 0;  ///< "conveyor", "pipe jet", ...
  /// Feeds what is due at time t + dt [s].
  virtual void advance(double t, double dt) = 0;
  virtual InflowBudget rock() const = 0;
  virtual InflowBudget water() const = 0;             ///< water and fines together
  virtual InflowBudget fines() const = 0;             ///< fines alone, a part of water()
  virtual std::string warning() const { return ""; }  ///< "feed: 3.1 kg wait for room at the belt", or ""
  virtual void exchange(StateArchive& archive) = 0;
};

}  // namespace sluice
