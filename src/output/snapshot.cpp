#include "output/snapshot.h"

namespace sluice {

RockSnapshot snapshot_rocks(const DemSystem& dem) {
  const Rocks& rocks = dem.rocks();
  RockSnapshot s;
  s.id = rocks.id;
  s.x = rocks.x;
  s.v = rocks.v;
  s.q = rocks.q;
  s.size = rocks.size;
  s.mass = rocks.mass;
  s.shape = rocks.shape;
  s.wetted = rocks.wetted;
  s.semi_axes.reserve(rocks.count());
  s.blockiness.reserve(rocks.count());
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    s.semi_axes.push_back(dem.semi_axes(i));
    s.blockiness.push_back(dem.shapes()[static_cast<std::size_t>(rocks.shape[i])].blockiness);
    // rocks that entered after the last coupling step have no fraction yet
  }
  return s;
}

Snapshot take_snapshot(double time, const Vec3& gravity, const DemSystem* rocks, const FluidSystem* water,
                       const Walls& walls) {
  Snapshot s;
  s.time = time;
  if (gravity.norm() > 0) s.up = -gravity.normalized();
  if (rocks) s.rocks = snapshot_rocks(*rocks);
  if (water) {
    s.water = water->points();
    s.water_point_volume = water->point_volume();
  }
  s.walls = &walls.all();
  return s;
}

}  // namespace sluice
