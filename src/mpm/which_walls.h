#pragma once

namespace sluice {

/// Which walls a field knows: those that move go into one of their own, so that what stands is looked at
/// once.
enum class WhichWalls {
  all,          ///< all of the scene, where they are
  standing,     ///< those that do not move
  near_moving,  ///< those that move, bodies too, and beside them those that stand
};

}  // namespace sluice
