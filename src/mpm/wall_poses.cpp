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
    const auto known = std::find(motions_.begin(), motions_.end(), *wall.motion);
    body_of_[w] = static_cast<int>(known - motions_.begin());
    if (known == motions_.end()) motions_.push_back(*wall.motion);
  }
  bodies_.resize(motions_.size());
}

bool WallPoses::place(double t, double dt) {
  bool moved = moved_;
  moved_ = false;
  for (std::size_t b = 0; b < motions_.size(); ++b) {
    Body& body = bodies_[b];
    const Pose earlier = pose_at(motions_[b], t - dt), now = pose_at(motions_[b], t);
    moved = moved || !same(now, body.now);
    body.now = now;
    body.next = pose_at(motions_[b], t + dt);
    body.last = twist_between(earlier, now, dt);
    body.twist = twist_between(now, body.next, dt);
  }
  return moved;
}

void WallPoses::set_bodies(std::span<const FluidBody> bodies, const Domain& domain, double sight) {
  moved_ = moved_ || bodies.size() + bodies_.size() > motions_.size();
  bodies_.resize(motions_.size());
  body_of_.resize(walls_.size());
  image_of_.clear();
  round_.clear();
  const auto add = [&](std::size_t i, const Vec3& shift) {
    const FluidBody& of = bodies[i];
    Body body{of.now, of.next, of.last, of.twist};
    for (Vec3* place : {&body.now.at, &body.next.at, &body.last.at, &body.twist.at}) *place += shift;
    round_.push_back({of.semi_axes, of.blockiness, of.reach, body.now, static_cast<int>(body_of_.size())});
    body_of_.push_back(static_cast<int>(bodies_.size()));
    image_of_.push_back(static_cast<int>(i));
    bodies_.push_back(body);
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) add(i, Vec3::Zero());
  // Images whose walls can be met from inside the domain.
  const Vec3 length = domain.box.size();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (int image = 0; image < 27; ++image) {
      const Vec3i step(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
      bool there = image != 13;
      for (int k = 0; k < 3; ++k) {
        const double x = bodies[i].now.at[k] + step[k] * length[k], reach = bodies[i].reach + sight;
        there = there && (step[k] == 0 || domain.periodic(k)) && x + reach > domain.box.lo[k] &&
                x - reach < domain.box.hi[k];
      }
      if (there) add(i, step.cast<double>().cwiseProduct(length));
    }
}

Vec3 WallPoses::surface_velocity(int wall, const Vec3& x) const {
  const Vec3 belt = free_body(wall) < 0 ? walls_.surface_velocity(wall, x) : Vec3(Vec3::Zero());
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
