#include "analysis/budgets.h"

namespace sluice {

double PhaseBudget::left_sum() const {
  double sum = 0;
  for (const LeftMass& l : left) sum += l.kg;
  return sum;
}

MassBudgets mass_budgets(const Exits& exits, const DemSystem* rocks, const FluidSystem* water) {
  MassBudgets b;
  const auto leave = [&](const ExitTally& tally) {
    b.rock.left.push_back({tally.config().name, tally.rock_kg()});
    b.water.left.push_back({tally.config().name, tally.water_kg()});
    b.fines.left.push_back({tally.config().name, tally.fines_kg()});
  };
  for (const ExitTally& tally : exits.tallies()) leave(tally);
  leave(exits.outside());
  if (rocks != nullptr)
    for (double m : rocks->rocks().mass) b.rock.inside += m;
  if (water != nullptr) {
    b.water.inside = water->total_mass();
    b.fines.inside = water->total_fines();
  }
  return b;
}

Vec3 momentum_residual(const MomentumTerms& m) {
  return (m.now - m.at_start) - (m.gravity + m.entered + m.from_other - m.left - m.to_walls);
}

Vec3 impulse_to_walls(const std::vector<WallLoad>& loads) {
  Vec3 sum = Vec3::Zero();
  for (const WallLoad& load : loads) sum += load.impulse;
  return sum;
}

Vec3 momentum_left(const Exits& exits) {
  Vec3 sum = exits.outside().rock_momentum() + exits.outside().water_momentum();
  for (const ExitTally& tally : exits.tallies()) sum += tally.rock_momentum() + tally.water_momentum();
  return sum;
}

}  // namespace sluice
