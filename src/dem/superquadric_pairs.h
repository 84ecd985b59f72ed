#pragma once
/// Many pairs of superquadrics at a time: what superquadric_pair does, as many side by side as the processor
/// has lanes. The result of a pair does not depend on its place in the list or on its neighbours.

#include <cstdint>
#include <span>

#include "dem/superquadric_contact.h"

namespace sluice {

/// How a superquadric lies in space, without its place: one cache line.
struct alignas(64) TurnedShape {
  Quat q = Quat::Identity();      ///< body to space
  Vec3 semi_axes = Vec3::Ones();  ///< [m]
  double m = 2;                   ///< blockiness, >= 2
};

/// Two bodies by index, and where the second is from the first.
struct BodyPair {
  Vec3 d = Vec3::Zero();  ///< centre of b (its nearest image) - centre of a [m]
  std::uint32_t a = 0, b = 0;
  std::uint32_t memory = 0;  ///< entry of the memories that is the pair's
};

/// One entry of geometry and outcome a pair; no two pairs share a memory. `geometry` is written where they
/// touch, and where the gap is found its overlap is minus that; else it is left as it was. Its point is
/// measured from the centre of a. Agrees with superquadric_pair within the tolerances of both.
void superquadric_pairs(std::span<const TurnedShape> bodies, std::span<const BodyPair> pairs,
                        std::span<PairMemory> memory, std::span<ContactGeometry> geometry,
                        std::span<PairOutcome> outcome);

}  // namespace sluice
