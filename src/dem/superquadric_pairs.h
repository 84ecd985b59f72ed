#pragma once
/// Many pairs of superquadrics at a time: what superquadric_pair does, as many side by side as the processor
/// has lanes. The result of a pair does not depend on its place in the list or on its neighbours.

#include <cstdint>
#include <span>

#include "dem/superquadric_contact.h"

namespace sluice {

/// Two bodies by index, and where the second is from the first.
struct BodyPair {
  std::uint32_t a = 0, b = 0;
  Vec3 d = Vec3::Zero();  ///< centre of b (its nearest image) - centre of a [m]
};

/// One entry of memory, geometry and outcome a pair. `geometry` is written unless separated; its point is
/// next to a (not to an image of b). Agrees with superquadric_pair within the tolerances of both.
void superquadric_pairs(std::span<const Superquadric> bodies, std::span<const BodyPair> pairs,
                        std::span<PairMemory> memory, std::span<ContactGeometry> geometry,
                        std::span<PairOutcome> outcome);

}  // namespace sluice
