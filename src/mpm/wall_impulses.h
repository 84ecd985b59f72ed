#pragma once
/// Impulses on walls, gathered by one block's work and added up in block order afterwards.

#include <vector>

#include "base/load.h"

namespace sluice {

class WallImpulses {
 public:
  void clear() { entries_.clear(); }

  /// @param impulse  on the wall [N s], at the point `at` [m]
  void add(int wall, const Vec3& impulse, const Vec3& at) { add_turning(wall, impulse, at.cross(impulse)); }
  /// @param angular_impulse  about the origin [N m s]
  void add_turning(int wall, const Vec3& impulse, const Vec3& angular_impulse) {
    WallLoad& load = of(wall);
    load.impulse += impulse;
    load.angular_impulse += angular_impulse;
  }
  void add_impact(int wall, double energy) { of(wall).impact_energy += energy; }
  void add_sliding(int wall, double energy) { of(wall).sliding_energy += energy; }

  template <class Body>
  void for_each(const Body& body) const {
    for (const Entry& e : entries_) body(e.wall, e.load);
  }

 private:
  struct Entry {
    int wall = -1;
    WallLoad load;
  };
  WallLoad& of(int wall) {
    for (Entry& e : entries_)
      if (e.wall == wall) return e.load;
    entries_.push_back({wall, {}});
    return entries_.back().load;
  }
  std::vector<Entry> entries_;
};

}  // namespace sluice
