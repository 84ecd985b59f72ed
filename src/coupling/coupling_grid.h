#pragma once
/// The coupling grid: levels of nodes with spacing h, 2h, 4h, ... A rock uses the level on which the
/// kernel (trilinear, 2 spacings wide) is at least the stated multiple of its size, so that no rock
/// needs more than eight nodes. Periodic axes hold a whole number of cells.
///
/// Fluid nodes are averaged onto the finest level in use, that one on to the next coarser one in use, and so
/// on, each with trilinear weights. What a level's node gives back goes down the same way, in proportion
/// to mass: sums are exact in both directions. Only nodes that fluid reaches are visited or cleared.

#include <array>
#include <cstdint>
#include <vector>

#include "base/domain.h"
#include "fluid/fluid_system.h"

namespace sluice {

/// Eight nodes and weights (sum 1) of a place on a level.
struct LevelWeights {
  std::array<int, 8> node{};
  std::array<double, 8> weight{};
};

/// Sums at the nodes of one level; arrays of #nodes.
struct CouplingLevel {
  Vec3 spacing = Vec3::Zero();           ///< [m]
  Vec3i nodes = Vec3i::Zero();           ///< per axis
  std::vector<double> solids;            ///< volume of rock, wherever water is or not [m3]
  std::vector<double> mass;              ///< of fluid [kg]
  std::vector<Vec3> momentum;            ///< of fluid [kg m/s]
  std::vector<double> density;           ///< mass-weighted sum [kg2/m3]
  std::vector<double> viscosity;         ///< mass-weighted sum [kg Pa s]
  std::vector<Vec3> acceleration;        ///< mass-weighted sum of Du/Dt [kg m/s2]
  std::vector<double> displaced;         ///< wetted volume of rock [m3]
  std::vector<Vec3> impulse;             ///< to be given to the fluid [N s]
  std::vector<double> drag_sum;          ///< sum of b w [kg]
  std::vector<Vec3> drag_rock_momentum;  ///< sum of b w v_rock [kg m/s]
  std::vector<int> wet;                  ///< nodes with fluid, in the order in which it reached them
  std::vector<LevelWeights> up;          ///< of each of its nodes on the next coarser level in use

  double cell_volume() const { return spacing.prod(); }
};

class CouplingGrid {
 public:
  /// @param narrowest, widest  kernels that rocks of the scene ask for [m]; decide which levels are in use
  CouplingGrid(const Domain& domain, double fluid_spacing, double narrowest, double widest);

  /// Level whose kernel is at least `width` [m]. The widest level has two cells along the domain's
  /// longest side.
  int level_for(double width) const;
  CouplingLevel& level(int l) { return levels_[static_cast<std::size_t>(l)]; }
  const CouplingLevel& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }
  bool in_use(int l) const { return !level(l).mass.empty(); }
  int level_count() const { return static_cast<int>(levels_.size()); }
  LevelWeights weights(int l, const Vec3& x) const;
  double kernel_width(int l) const { return 2 * level(l).spacing.minCoeff(); }  ///< [m]

  void clear_solids();
  /// Averages the fluid's nodes on to every level in use; what the levels held of the fluid is dropped.
  void gather(const FluidNodes& nodes);
  /// The same nodes' acceleration. @pre gather was called with these nodes
  void gather_acceleration(const FluidNodes& nodes, const std::vector<Vec3>& acceleration);
  /// Impulse [N s] and displaced volume [m3] of each fluid node from all levels. @pre as above
  void scatter(const FluidNodes& nodes, std::vector<Vec3>& impulse, std::vector<double>& displaced);
  std::size_t memory_bytes() const;

 private:
  void make(int l);
  Vec3 place_of(int l, int node) const;

  Domain domain_;
  double fluid_spacing_;
  int finest_ = 0, coarsest_ = 0;  ///< levels in use
  std::vector<CouplingLevel> levels_;
  std::vector<LevelWeights> of_fluid_;  ///< of each fluid node on the finest level in use
};

}  // namespace sluice
