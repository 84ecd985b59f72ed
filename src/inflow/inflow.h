#pragma once
/// Where rock and water come from. Every inflow is exact in mass: what entered is rate x time less what
/// waits, to rounding; what waits is carried over, never dropped.

#include <cstdint>
#include <string>

#include "base/domain.h"
#include "base/state_archive.h"

namespace sluice {

class DemSystem;
class FluidSystem;

/// Mass of one phase through one inflow since the start [kg].
struct InflowBudget {
  double requested = 0;          ///< rate x time
  double entered = 0;            ///< as stored by the system that took it, summed in double
  double waiting = 0;            ///< not yet placed: requested - entered
  Vec3 momentum = Vec3::Zero();  ///< that came with what entered [N s]
};

/// What an inflow feeds, and where its random numbers come from.
struct InflowTarget {
  DemSystem* rocks = nullptr;    ///< null where the scene has no rocks
  FluidSystem* water = nullptr;  ///< null where the scene has no water
  Domain domain;
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s2]
  std::uint64_t seed = 0;            ///< of the run
  int index = 0;  ///< of this emitter in the process: its random stream, its rocks' `source`
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
