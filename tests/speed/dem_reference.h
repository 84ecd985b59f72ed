#pragma once
/// The rocks' step by plain formulas in double, against which the benchmarks check the DemSystem.
///
/// Written from the equations and sharing nothing with src/dem: pairs from a grid of cells, tangential
/// springs in a sorted list, the common normal of two superquadrics by descent on their support functions,
/// walls as analytic planes. (For m above 4 the normal comes from superquadric_gap, one pair at a time and
/// without a memory, and the support functions confirm it.) It follows a system from its first step:
/// positions and velocities are the system's own, forces, springs and what follows from them are the
/// reference's, so that an error of one step is an error of that step. Two blocky rocks meet as the copies of
/// dem/faces.h do.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "dem/dem_system.h"
#include "dem/superquadric_contact.h"

namespace sluice::speed {

using Pairs = std::vector<std::array<int, 2>>;

/// Pairs (i < j, ascending) of spheres that overlap, in a periodic or open domain.
Pairs overlapping_spheres(const std::vector<Vec3>& x, const std::vector<double>& radius,
                          const Domain& domain);

/// A flat wall that does not move: rocks are on the side of its normal, above its polygon.
struct PlainWall {
  std::vector<Vec3> corners;  ///< of a convex polygon, counter-clockwise about the normal [m]
  Vec3 normal;                ///< unit
};

/// Largest departures in one step, in units of what contacts do in it.
struct Departure {
  double position = 0;       ///< over the farthest move
  double velocity = 0;       ///< over the mean change by contacts
  double turning = 0;        ///< angular momentum, likewise
  double wrong_share = 0;    ///< of rocks whose velocity or turning departs by more than the tolerance
  std::size_t contacts = 0;  ///< of the reference
  std::size_t wall_contacts = 0;
  std::size_t unproved = 0;  ///< pairs of blocky rocks whose normal the support functions do not confirm
};

class PlainRocks {
 public:
  /// @param dem  without a step so far; one pair of properties for all materials, no rolling resistance
  PlainRocks(const DemSystem& dem, double restitution, double friction, std::vector<PlainWall> walls = {});

  /// @pre dem.step(t, dt) was called once since the last call.  @param tolerance  for wrong_share
  Departure follow(const DemSystem& dem, double dt, double tolerance);

  /// Rocks at such places are not compared until the next call.
  void leave_out(std::function<bool(const Vec3&)> there) { left_out_ = std::move(there); }

 private:
  struct State {
    std::vector<Vec3> x, v, w;
    std::vector<Quat> q;
  };
  using Key = std::array<std::size_t, 3>;  ///< rock; rock or first_wall + wall; copy of a blocky rock
  struct Memory {
    Key key;
    Vec3 spring;  ///< [m]
  };
  struct Contact {
    Key key;
    int first, second;  ///< second is -1 at a wall
    double share = 1;   ///< of a whole contact's strength
    Vec3 normal, arm_first, arm_second;
    double overlap, size;  ///< size: harmonic mean of both [m]
  };
  void take_order_of(const Rocks& rocks);
  void find_contacts(const DemSystem& dem);
  void find_wall_contacts(const DemSystem& dem);
  bool common_normal(const Superquadric& a, const Superquadric& b, Contact& contact);
  void add_force(const DemSystem& dem, const Contact& contact, double dt);
  double mobility(const DemSystem& dem, int rock, const Vec3& arm, const Vec3& n) const;
  Vec3 turn_inertia(const DemSystem& dem, std::size_t rock, const Vec3& w, bool inverse) const;

  double zeta_, friction_;
  std::size_t unproved_ = 0;
  std::vector<PlainWall> walls_;
  std::function<bool(const Vec3&)> left_out_;
  std::vector<std::uint64_t> ids_;  ///< of the last step, in its order
  State before_;
  std::vector<Vec3> force_, torque_;  ///< of the last step [N], [N m]
  std::vector<Vec3> v_half_, w_half_;
  std::vector<Contact> contacts_;
  std::vector<Memory> memory_, new_memory_;
};

}  // namespace sluice::speed
