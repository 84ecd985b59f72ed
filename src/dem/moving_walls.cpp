#include "dem/moving_walls.h"

#include <algorithm>

namespace sluice {

namespace {
Walls walls_of_motion(const Walls& walls, const std::optional<WallMotion>& motion) {
  std::vector<Wall> some = walls.all();
  for (Wall& wall : some)
    if (!(wall.motion == motion)) wall.mesh = {};
  return Walls(std::move(some));
}
}  // namespace

Walls still_walls(const Walls& walls) {
  return walls_of_motion(walls, std::nullopt);
}

std::vector<MovingWalls> moving_walls(const Walls& walls) {
  std::vector<MovingWalls> moving;
  for (const Wall& wall : walls.all()) {
    const auto known = [&](const MovingWalls& m) { return m.motion == *wall.motion; };
    if (!wall.motion || std::any_of(moving.begin(), moving.end(), known)) continue;
    Walls own = walls_of_motion(walls, wall.motion);
    WallSurface surface(own);
    moving.push_back({*wall.motion, std::move(own), std::move(surface), {}, {}, {}});
    moving.back().place(0);
  }
  return moving;
}

void MovingWalls::place(double t) {
  before = now = pose_at(motion, t);
  twist = {};
}

void MovingWalls::move(double t, double dt) {
  before = pose_at(motion, t);
  now = pose_at(motion, t + dt);
  twist = twist_between(before, now, dt);
}

SurfaceMotion MovingWalls::surface_motion(const WallTouch& in_space, double dt) const {
  SurfaceMotion moves;
  moves.belt = along_surface(now.q * walls.surface_velocity(in_space.wall, in_space.point), in_space.normal);
  moves.velocity = velocity_between(before, now, in_space.point, dt) + moves.belt;
  moves.spin = twist.w;
  return moves;
}

WallTouch MovingWalls::to_space(const WallTouch& touch) const {
  WallTouch out = touch;
  out.normal = now.q * touch.normal;
  out.point = now.to_space(touch.point);
  out.spring = now.q * touch.spring;
  out.turned = now.q * touch.turned;
  for (Vec3& stretch : out.rings) stretch = now.q * stretch;
  return out;
}

void MovingWalls::keep_history(const WallTouch& in_space, WallTouch& touch) const {
  touch.spring = now.q.conjugate() * in_space.spring;
  touch.turned = now.q.conjugate() * in_space.turned;
  touch.rings = in_space.rings;
  for (Vec3& stretch : touch.rings) stretch = now.q.conjugate() * stretch;
}

}  // namespace sluice
