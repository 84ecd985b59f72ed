#pragma once
/// What the film between two resolved rocks, or a rock and a wall, does where it is thinner than the fluid's
/// cells: it resists being squeezed out and being drawn in. For spheres.
///
///   F = 6 pi mu R^2 (1 / gap - 1 / reach) v    for gap < reach, against the speed v at which the gap closes
///
/// R = R_a R_b / (R_a + R_b), or R_a beside a wall; reach is one cell, above which the grid sees the film
/// itself (Nguyen & Ladd 2002, Phys. Rev. E 66:046708). No gap counts as thinner than the roughness, and none
/// is left where they touch: there the contact law acts. Shear of the film is left out: its force and torque
/// grow with the logarithm of the gap alone.
///
/// The film's viscosity is that of the liquid at the rate v / gap, with the fines that the water has in the
/// mean. The force acts in the share of the two that is wet.
///
/// The impulse over a step is what the law does while all other forces stay: it never turns a speed around.
/// A rock with several films gives each an equal part of its mass, so that all of them do not either.

#include <vector>

#include "base/load.h"
#include "base/state_archive.h"
#include "dem/dem_system.h"
#include "fluid/fluid_model.h"

namespace sluice {

/// A rock that is resolved.
struct FilmRock {
  std::size_t rock = 0;
  double share = 1;  ///< in which films act: of its size that is resolved, times its skin that is wet
};

class Lubrication {
 public:
  /// @param reach  [m];  @param roughness  over the radius R. The system must outlive this.
  Lubrication(const DemSystem& rocks, std::size_t walls, double reach, double roughness);
  /// Adds the mean force over a step of dt [s] to those of all rocks [N]. @param force  without films
  void add(const std::vector<FilmRock>& rocks, const FluidModel& liquid, double fines, double dt,
           std::vector<Vec3>& force);
  const std::vector<WallLoad>& wall_loads() const { return loads_; }  ///< one per wall, since start
  void exchange(StateArchive& archive);

 private:
  /// The gap between a and b, or between a and a wall.
  struct Film {
    std::size_t a = 0, b = 0;      ///< indices of rocks
    int wall = -1;                 ///< then there is no b
    Vec3 normal = Vec3::Zero();    ///< from a
    Vec3 point = Vec3::Zero();     ///< on the wall
    double gap = 0, closing = 0;   ///< [m], [m/s]
    double radius = 0, share = 0;  ///< R [m]
  };
  void find_films(const std::vector<FilmRock>& rocks);

  const DemSystem& rocks_;
  double reach_, roughness_;
  std::vector<Film> films_;
  std::vector<int> count_;  ///< films of each rock
  std::vector<WallLoad> loads_;
};

}  // namespace sluice
