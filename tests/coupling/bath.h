#pragma once

#include <numbers>

#include "coupling/pool.h"

namespace sluice {

inline constexpr double h = 0.02;

inline CouplingConfig resolving() {
  CouplingConfig config;
  config.resolve_from = 3;
  return config;
}

inline double sphere_volume(double d) {
  return std::numbers::pi / 6 * d * d * d;
}

/// A pool that is `cells` wide and deep, with one rock in it, whose water has left its place.
struct Bath : Pool {
  Bath(double cells, const PoolRocks& of, NewRock rock, const CouplingConfig& config = resolving())
      : Pool(cells * h, cells * h, h, of, config) {
    rock.size = of.size;
    rocks->add(rock);
    for (const RemovedPoint& p : coupling->make_room()) displaced += p.mass / water->model().density;
  }
  double displaced = 0;  ///< [m3]
};

}  // namespace sluice
