#pragma once
/// Rocks much larger than the fluid's spacing: each is a body that the fluid meets with its own shape, as it
/// meets a wall that moves. Its water never enters it; pressure and friction on its surface move and turn it.
///
/// Of a rock between `partly_from` and `from` only a core of the same shape is resolved, whose size rises
/// from nothing to all of it; the coupling treats the rest as it does small rocks.
///
/// The fluid's step follows the rocks' last one: it meets a rock on its way from where it was before that
/// step to where it is now, so that the water is never jumped over, and the load is held over the rocks' next
/// step. Sound crosses less than a cell in that time, so that a light body carries its added mass without
/// iterations.

#include <optional>
#include <vector>

#include "base/state_archive.h"
#include "coupling/lubrication.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

/// Which rocks are resolved, and how many were so at once at most.
struct ResolvedExtent {
  double partly_from = 0, from = 0;  ///< sizes [m]
  std::uint64_t most_partly = 0, most_whole = 0;
};

class ResolvedRocks {
 public:
  /// @param partly_from, from  sizes [m]. Both systems must outlive this.
  ResolvedRocks(double partly_from, double from, DemSystem& rocks, FluidSystem& fluid);
  /// Size of the part of a rock that is resolved, over its own, 0..1.
  double core(std::size_t rock) const;

  /// Puts them into the fluid. @param dt  of the step [s]; substep k of n of the fluid in it
  void place(double dt, int k, int n);
  /// Keeps what they received in that substep.
  void take_loads();
  /// Adds force [N] and torque [N m] of the step to the entries of the rocks.
  /// @param tau  over which filtered_force follows [s]
  void add_mean_loads(double dt, double tau, std::vector<Vec3>& force, std::vector<Vec3>& torque);
  /// Films between them and beside walls, from now on.
  void use_lubrication(double roughness);
  /// Adds the films' force over the step [N], if asked. @param wetted  share of each rock's skin;
  /// nodes  of the water, for its mean fines
  void add_films(const std::vector<double>& wetted, const FluidNodes& nodes, double dt,
                 std::vector<Vec3>& force);
  const std::vector<WallLoad>& film_loads() const;  ///< one per wall, or none
  /// Force on each rock in the last steps, filtered [N]; of all rocks, zero where not resolved. Valid between
  /// place and the rocks' next step.
  void filtered_force(std::vector<Vec3>& force) const;
  const Vec3& impulse() const { return impulse_; }  ///< on all since start [N s]

  /// Takes water that lies inside out of the fluid. To be called where rocks were put into water.
  std::vector<RemovedPoint> make_room();
  const ResolvedExtent& extent() const { return extent_; }
  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);

 private:
  /// A rock in the fluid, in ascending id.
  struct Held {
    std::uint64_t id = 0;
    Pose before, now;  ///< one rock step apart
    Twist last, twist;
    Vec3 force = Vec3::Zero();  ///< filtered [N]
  };
  void follow_rocks(double dt);

  ResolvedExtent extent_;
  DemSystem& rocks_;
  FluidSystem& fluid_;
  std::vector<Held> held_;
  std::vector<std::size_t> rock_of_;  ///< index of each held rock, until the rocks move
  std::vector<FluidBody> bodies_;
  std::vector<BodyLoad> loads_;  ///< of the step
  std::optional<Lubrication> lubrication_;
  Vec3 impulse_ = Vec3::Zero();
};

}  // namespace sluice
