#include "inflow/feed_clock.h"

namespace sluice {

// Not in the header: inlined next to a second one, g++ 12.2 (-O2, AVX) packs the two into one register and
// drops the rounding; FillWater.FillsTheBoxExactly fails then.
double stored_mass(double mass) {
  return static_cast<double>(static_cast<float>(mass));
}

}  // namespace sluice
