#include "mpm/wall_poses.h"

#include <algorithm>

namespace sluice {

namespace {
bool same(const Pose& a, const Pose& b) {
  return a.q.coeffs() == b.q.coeffs() && a.centre == b.centre && a.at == b.at;
}
}  // namespace

WallPoses::WallPoses(const Walls& walls) : walls_(walls), body_of_(walls.size(), -1) {
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wall& wall = walls.all()[w];
    if (!wall.motion || wall.blocks == BlocksPhase::rocks_only || wall.mesh.triangles.empty()) continue;
    fastest_ = std::max(fastest_, motion_range(*wall.motion, wall.mesh.vertices).speed);
    const auto known = std::find_if(bodies_.begin(), bodies_.end(),
                                    [&](const Body& body) { return body.motion == *wall.motion; });
    body_of_[w] = static_cast<int>(known - bodies_.begin());
    if (known == bodies_.end()) bodies_.push_back({*wall.motion, {}, {}, {}, {}});
  }
}

bool WallPoses::place(double t, double dt) {
  bool moved = !placed_;
  placed_ = true;
  for (Body& body : bodies_) {
    const Pose earlier = pose_at(body.motion, t - dt), now = pose_at(body.motion, t);
    moved = moved || !same(now, body.now);
    body.now = now;
    body.next = pose_at(body.motion, t + dt);
    body.last = twist_between(earlier, now, dt);
    body.twist = twist_between(now, body.next, dt);
  }
  return moved;
}

Vec3 WallPoses::surface_velocity(int wall, const Vec3& x) const {
  const Vec3 belt = walls_.surface_velocity(wall, x);
  const int body = body_of(wall);
  return body < 0 ? belt : Vec3(at(body).now.q * belt + at(body).twist.velocity(x));
}

double WallPoses::work(int wall, const Vec3& impulse, const Vec3& angular_impulse) const {
  const int body = body_of(wall);
  if (body < 0) return 0;
  const Twist& twist = at(body).twist;
  return impulse.dot(twist.velocity(Vec3::Zero())) + angular_impulse.dot(twist.w);
}

}  // namespace sluice
