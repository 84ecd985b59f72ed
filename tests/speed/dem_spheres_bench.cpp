/// Speed of spheres in dense, sheared beds (dem_scenes.h), with history and rebuilds of the list.

#include "speed/dem_bed_bench.h"

namespace sluice::speed {
namespace {

const bool registered = [] {
  const auto add = [](const char* name, BedRecipe recipe) {
    benchmark::RegisterBenchmark(name, BedBench(std::move(recipe), {}))->Unit(benchmark::kMillisecond);
  };
  add("dem_spheres/dense_200k", dense_200k());
  add("dem_spheres/poly5_50k", poly5_50k());
  add("dem_spheres/poly50_50k", poly50_50k());
  return true;
}();

}  // namespace
}  // namespace sluice::speed
