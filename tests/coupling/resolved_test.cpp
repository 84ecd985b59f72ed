// Rocks of many cells that the water meets with their own shape.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "coupling/pool.h"

namespace sluice {
namespace {

TEST(Experiment, Archimedes) {
  const double n = std::atof(std::getenv("N")), h = 0.02, d = n * h;
  CouplingConfig config;
  config.resolve_from = 3;
  const double width = (std::ceil(n) + 8) * h;
  Pool pool(width, width, h, {.size = d, .density = 1000 * std::atof(std::getenv("RHO"))}, config);
  NewRock rock;
  rock.x = Vec3(0.5 * width, 0.5 * width + 0.003, 0.5 * width + 0.0041);
  rock.size = d;
  pool.rocks->add(rock);
  double displaced = 0;
  for (const RemovedPoint& p : pool.coupling->make_room()) displaced += p.mass;
  const double volume = std::numbers::pi / 6 * d * d * d;
  std::printf("d/h %.1f displaced %.4f of the rock's volume\n", n, displaced / (1000 * volume));
  const bool held = std::getenv("HELD") != nullptr;
  double sum = 0, sum2 = 0;
  int count = 0;
  for (int i = 0; pool.t < 1.5; ++i) {
    pool.step(held ? Pool::Rocks::held : Pool::Rocks::falling);
    const double f = pool.coupling->force()[0].z() / (1000 * 9.81 * volume);
    if (pool.t > 1) {
      sum += f;
      sum2 += f * f;
      ++count;
    }
    if (i % 200 == 0)
      std::printf("t %.3f f %.4f z %.4f v %.4f\n", pool.t, f, pool.rocks->rocks().x[0].z() - rock.x.z(),
                  pool.rocks->rocks().v[0].z());
  }
  const double mean = sum / count;
  std::printf("mean %.4f rms %.4f depth %.4f wet %.3f\n", mean, std::sqrt(sum2 / count - mean * mean),
              2 * pool.centroid(), pool.coupling->wetted_fraction()[0]);
}

}  // namespace
}  // namespace sluice
