/// Speed of superquadrics in dense, sheared beds (dem_scenes.h): semi-axes 7.5 : 5 : 4 as in the figures that
/// other codes are known for, and 4 : 2 : 1.

#include "speed/dem_bed_bench.h"

namespace sluice::speed {
namespace {

const bool registered = [] {
  const auto add = [](const char* name, const RockShape& shape) {
    // The descent of the reference is good to 1e-5 of a kick; two pairs of flat faces in a thousand have
    // more than one common normal.
    const BedTolerance tolerance{.step = 1e-4, .wrong_share = 4e-3, .contact_share = 2e-3};
    benchmark::RegisterBenchmark(name, BedBench(superquadrics_30k(shape), tolerance))
        ->Unit(benchmark::kMillisecond);
  };
  add("dem_superquadrics/m2_30k", make_superquadric(1.5, 0.8, 2));
  add("dem_superquadrics/m4_30k", make_superquadric(1.5, 0.8, 4));
  add("dem_superquadrics/m8_30k", make_superquadric(1.5, 0.8, 8));
  add("dem_superquadrics/m8_aspect4_30k", make_superquadric(2, 0.5, 8));
  return true;
}();

}  // namespace
}  // namespace sluice::speed
