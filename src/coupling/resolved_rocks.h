#pragma once
/// Rocks much larger than the fluid's spacing: each is a body that the fluid meets with its own shape, as it
/// meets a wall that moves. Its water never enters it; pressure and friction on its surface move and turn it.
///
/// The fluid's step follows the rocks' last one: it meets a rock on its way from where it was before that
/// step to where it is now, so that the water is never jumped over, and the load is held over the rocks' next
/// step. Sound crosses less than a cell in that time, so that a light body carries its added mass without
/// iterations.

#include <vector>

#include "base/state_archive.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

class ResolvedRocks {
 public:
  /// @param from_size  smallest size that is resolved [m]. Both systems must outlive this.
  ResolvedRocks(double from_size, DemSystem& rocks, FluidSystem& fluid);
  bool resolves(std::size_t rock) const { return rocks_.rocks().size[rock] >= from_size_; }

  /// Puts them into the fluid. @param dt  of the step [s]; substep k of n of the fluid in it
  void place(double dt, int k, int n);
  /// Keeps what they received in that substep.
  void take_loads();
  /// Writes force [N] and torque [N m] of the step into the entries of the rocks that are resolved.
  void mean_loads(double dt, std::vector<Vec3>& force, std::vector<Vec3>& torque) const;
  const Vec3& impulse() const { return impulse_; }  ///< on all since start [N s]

  /// Takes water that lies inside out of the fluid. To be called where rocks were put into water.
  std::vector<RemovedPoint> make_room();
  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);

 private:
  /// A rock in the fluid, in ascending id.
  struct Held {
    std::uint64_t id = 0;
    Pose before, now;  ///< one rock step apart
    Twist last, twist;
  };
  void follow_rocks(double dt);

  double from_size_;
  DemSystem& rocks_;
  FluidSystem& fluid_;
  std::vector<Held> held_;
  std::vector<std::size_t> rock_of_;  ///< index of each held rock, until the rocks move
  std::vector<FluidBody> bodies_;
  std::vector<BodyLoad> loads_;  ///< of the step
  Vec3 impulse_ = Vec3::Zero();
};

}  // namespace sluice
