#pragma once
/// What makes a run stop although no part of it has noticed: energy that nothing gave, and a step that has
/// become too long. NaN, overlaps, and speeds beyond a part's limits are seen where they arise.
///
///   rocks  created energy (DemEnergy) against all energy that ever passed through them
///   water  kinetic energy against what gravity, emitters and rocks can have given it; not where a wall
///          drags water along, whose work is not known
///
/// Looks are some hundred rock steps or twenty water steps apart: they cost well below 1 % of a step.

#include "base/state_archive.h"
#include "simulation/parts.h"
#include "simulation/time_step.h"

namespace sluice {

/// Share of all energy that may come from nowhere. The scheme's own error: at most 5 % for blocks on faces
/// (validation/bed-energy-*), 15 % for undamped beds at 16 steps a contact, 1 % at the default of 30.
inline constexpr double most_created = 0.2;
/// Energy below which nothing is said: that of a fall through this share of a rock's own size, or of all
/// water at this share of its expected speed (a tenth of the speed of sound), squared.
inline constexpr double least_created = 0.01;

class Watch {
 public:
  /// @param parts  must outlive the watch
  Watch(const Parts& parts, const TimeStep& step);
  /// After the step that ends at t [s], the `steps`-th of the run.
  /// @throws NumericalError
  void look(double t, std::uint64_t steps);
  /// Of all energy that passed through the rocks, what came from nowhere; 0 without rocks.
  double created_by_rocks() const;
  void exchange(StateArchive& archive);

 private:
  void look_at_rocks(double t) const;
  void look_at_step(double t) const;
  void look_at_water(double t);

  const Parts& parts_;
  TimeStep step_;
  std::uint64_t rock_interval_ = 0, water_interval_ = 0;  ///< scene steps from look to look; 0 = never
  double water_step_ = 0;                                 ///< longest that the water allowed at the start [s]
  double looked_at_ = 0;                                  ///< water [s]
  Vec3 momentum_ = Vec3::Zero();                          ///< of water then [N s]
  double water_gravity_work_ = 0;                         ///< since start [J]
};

}  // namespace sluice
