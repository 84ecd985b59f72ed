#include "dem/dem_state.h"

namespace sluice {

std::vector<NearWall> DemSystem::near_walls(std::size_t rock, double reach) const {
  const Implementation& s = *implementation_;
  const double radius = 0.5 * s.rocks.size[rock];
  std::vector<NearWall> out;
  WallScratch scratch;
  std::vector<int> triangles;
  const auto look = [&](const Walls& walls, const WallSurface& surface, const Vec3& x, const auto& keep) {
    walls.query().triangles_in(Box{x, x}.grown(radius + reach), triangles);
    std::erase_if(triangles, [&](int t) { return surface.triangle(t).patch < 0; });
    find_sphere_contacts(surface, triangles, x, radius + reach, {}, scratch);
    for (const WallTouch& touch : scratch.found) keep(touch);
  };
  const auto near = [&](const WallTouch& touch) {
    NearWall wall;
    wall.wall = touch.wall;
    wall.normal = touch.normal;
    wall.gap = reach - touch.overlap;
    wall.point = s.rocks.x[rock] + (radius + wall.gap) * touch.normal;
    return wall;
  };
  look(s.still, s.surface, s.rocks.x[rock], [&](const WallTouch& touch) {
    NearWall wall = near(touch);
    wall.velocity = along_surface(s.still.surface_velocity(touch.wall, touch.point), touch.normal);
    out.push_back(wall);
  });
  for (const MovingWalls& part : s.moving)
    look(part.walls, part.surface, part.now.to_rest(s.rocks.x[rock]), [&](const WallTouch& touch) {
      const WallTouch in_space = part.to_space(touch);
      NearWall wall = near(in_space);
      const Vec3 belt = part.now.q * part.walls.surface_velocity(touch.wall, touch.point);
      wall.velocity = part.twist.velocity(wall.point) + along_surface(belt, in_space.normal);
      out.push_back(wall);
    });
  return out;
}

}  // namespace sluice
