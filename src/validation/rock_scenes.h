#pragma once
/// Small scenes of rocks for the measures.

#include <array>
#include <memory>
#include <vector>

#include "dem/dem_system.h"

namespace sluice {

struct RockSetup {
  std::vector<Material> rocks{{"rock", 2700}};
  Material wall{"wall", 0};
  PairProperties pair{0.5, 0.5, 0};        ///< of all materials, walls too
  double smallest = 0.02, largest = 0.02;  ///< [m]
  double stiffness_per_size = 1e6;         ///< [N/m2]
  double tangential_ratio = 2.0 / 7.0;
  EndOfContact end = EndOfContact::no_tension;
  std::vector<RockShape> shapes{make_sphere()};
  Vec3 gravity = Vec3::Zero();                                    ///< [m/s2]
  Box box{Vec3::Constant(-100), Vec3::Constant(100)};             ///< of the domain [m]
  std::array<Face, 3> faces{Face::open, Face::open, Face::open};  ///< of both ends of an axis
};

/// A DemSystem with its walls and clock.
class RockScene {
 public:
  RockScene(const RockSetup& setup, std::vector<Wall> walls);
  void step(double dt) {
    dem->step(t, dt);
    t += dt;
    rock_steps += static_cast<double>(dem->rocks().count());
  }
  /// Forces of rocks that start in contact: without them the first half kick would be missing.
  void prime() { dem->step(t, 0); }
  const Rocks& rocks() const { return dem->rocks(); }
  double mass(std::size_t i) const { return dem->rocks().mass[i]; }  ///< [kg]

  Walls walls;
  std::unique_ptr<DemSystem> dem;
  double t = 0;  ///< [s]
  double rock_steps = 0;
};

/// Level square through z = height, of the material after the setup's rocks.
Wall level_wall(const RockSetup& setup, double height, double half_width = 50);
/// Six walls of a box.
Wall box_wall(const RockSetup& setup, const Box& box);

}  // namespace sluice
