#include "output/snapshot.h"

namespace sluice {

RockSnapshot snapshot_rocks(const DemSystem& dem, const std::vector<double>* wetted_fraction) {
  const Rocks& rocks = dem.rocks();
  RockSnapshot s;
  s.id = rocks.id;
  s.x = rocks.x;
  s.v = rocks.v;
  s.q = rocks.q;
  s.size = rocks.size;
  s.mass = rocks.mass;
  s.shape = rocks.shape;
  s.wetted.assign(rocks.count(), 0.0);
  s.semi_axes.reserve(rocks.count());
  s.blockiness.reserve(rocks.count());
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    s.semi_axes.push_back(dem.semi_axes(i));
    s.blockiness.push_back(dem.shapes()[static_cast<std::size_t>(rocks.shape[i])].blockiness);
    // rocks that entered after the last coupling step have no fraction yet
    if (wetted_fraction && i < wetted_fraction->size()) s.wetted[i] = (*wetted_fraction)[i];
  }
  return s;
}

Snapshot take_snapshot(double time, const Vec3& gravity, const DemSystem* rocks, const FluidSystem* water,
                       const Walls& walls, const std::vector<double>* wetted_fraction) {
  Snapshot s;
  s.time = time;
  if (gravity.norm() > 0) s.up = -gravity.normalized();
  if (rocks) s.rocks = snapshot_rocks(*rocks, wetted_fraction);
  if (water) {
    s.water = water->points();
    s.water_point_volume = water->point_volume();
  }
  s.walls = &walls.all();
  return s;
}

}  // namespace sluice
