#pragma once
/// Random numbers that are the same on every machine and can be saved: PCG-XSH-RR 64/32 (O'Neill 2014).
/// The distributions of the standard library differ between libraries, so ours are here.

#include <cstdint>

#include "base/vec.h"

namespace sluice {

/// 64-bit mix (splitmix64 finaliser, Steele et al. 2014): a hash of one word.
inline std::uint64_t mix64(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

class Random {
 public:
  Random() : Random(0) {}
  /// @param stream  independent sequences from one seed (one per emitter, say)
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);
  std::uint32_t next();
  double uniform();                      ///< in [0, 1), 53 bits
  double uniform(double lo, double hi);  ///< in [lo, hi)
  double normal();                       ///< mean 0, variance 1 (Box-Muller, one value a call)
  Vec3 on_sphere();                      ///< unit vector, uniform over the sphere
  Quat rotation();                       ///< uniform over all rotations (Shoemake 1992)

  std::uint64_t state = 0;  ///< public so that a checkpoint can hold it
  std::uint64_t increment = 1;
};

}  // namespace sluice
