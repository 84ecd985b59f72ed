#pragma once
/// Does everything add up? Mass of each phase and momentum, as run.json has them.

#include <string>
#include <vector>

#include "analysis/exits.h"

namespace sluice {

/// Mass that left through one exit [kg].
struct LeftMass {
  std::string exit;
  double kg = 0;
};

/// Mass of one phase since the run began [kg].
struct PhaseBudget {
  double initial = 0;    ///< initial fills
  double requested = 0;  ///< rate x time of all feeds
  double entered = 0;
  double waiting = 0;
  double inside = 0;
  std::vector<LeftMass> left;  ///< every exit, then "outside"

  double left_sum() const;
  /// initial + entered - inside - left: zero but for rounding.
  double lost() const { return (initial + entered) - (inside + left_sum()); }
};

struct MassBudgets {
  PhaseBudget rock, water, fines;  ///< water holds its fines
};

/// What is inside and what left; initial and feeds are the caller's to fill in. Null for an absent phase.
MassBudgets mass_budgets(const Exits& exits, const DemSystem* rocks, const FluidSystem* water);

/// Where the momentum of one phase, or of both, came from and went [N s].
struct MomentumTerms {
  Vec3 at_start = Vec3::Zero(), now = Vec3::Zero();
  Vec3 gravity = Vec3::Zero();     ///< received since start
  Vec3 entered = Vec3::Zero();     ///< brought by feeds
  Vec3 left = Vec3::Zero();        ///< taken through exits
  Vec3 to_walls = Vec3::Zero();    ///< given to walls
  Vec3 from_other = Vec3::Zero();  ///< received from the other phase
};

/// (now - at_start) - (gravity + entered + from_other - left - to_walls).
Vec3 momentum_residual(const MomentumTerms& terms);

/// Impulse that all walls received [N s].
Vec3 impulse_to_walls(const std::vector<WallLoad>& loads);
/// Momentum taken through all exits and the open faces, by both phases [N s].
Vec3 momentum_left(const Exits& exits);

}  // namespace sluice
