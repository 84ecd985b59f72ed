#pragma once
/// Where the walls that move are during a step of the fluid, and how their surfaces move.
///
/// All of it is a function of the step's times: the poses at its start and end, and one step before. In the
/// step the fluid meets the walls where they are at its start; a path is followed in the wall's own frame,
/// from its pose at the start to that at the end, so that a wall never passes a point.
///
/// Bodies that come, go and move by themselves stand behind the scene's walls: body i of set_bodies is wall
/// walls.size() + i, and so is each of its images through periodic faces, which follow them.

#include <span>
#include <vector>

#include "base/domain.h"
#include "fluid/fluid_body.h"
#include "geometry/wall.h"
#include "mpm/round_body.h"

namespace sluice {

class WallPoses {
 public:
  /// Walls that move and block water. @param walls  must outlive this
  explicit WallPoses(const Walls& walls);
  bool any() const { return !bodies_.empty(); }

  /// Places the walls for a step from t to t + dt. @return false where none is elsewhere than in the last
  /// call
  bool place(double t, double dt);
  /// From now on these bodies are there, besides the walls, and no others.
  /// @param sight  from how far walls are met [m]
  void set_bodies(std::span<const FluidBody> bodies, const Domain& domain, double sight);

  /// Walls of one motion are one body; -1: the wall stands.
  int body_of(int wall) const { return body_of_[static_cast<std::size_t>(wall)]; }
  /// Index of a wall among the bodies of set_bodies; -1: it is one of the scene's walls.
  int free_body(int wall) const {
    const int scene = static_cast<int>(walls_.size());
    return wall < scene ? -1 : image_of_[static_cast<std::size_t>(wall - scene)];
  }
  /// Where a wall that is a body stands at the start of the step [m]. @pre free_body(wall) >= 0
  const Vec3& centre(int wall) const { return at(body_of(wall)).now.at; }
  bool is_ball(int wall) const {
    return free_body(wall) >= 0 && round_[static_cast<std::size_t>(round_of(body_of(wall)))].is_ball();
  }
  const std::vector<RoundBody>& round() const { return round_; }  ///< the bodies and their images [m]
  /// Index in round() of a body; negative for one of the scene's motions.
  int round_of(int body) const { return body - static_cast<int>(motions_.size()); }
  /// A place of a body's own frame that is at x at the end of the step, and back.
  Vec3 to_rest_at_end(int body, const Vec3& x) const { return at(body).next.to_rest(x); }
  Vec3 from_rest_at_end(int body, const Vec3& rest) const { return at(body).next.to_space(rest); }
  Vec3 turned_from_rest_at_end(int body, const Vec3& n) const { return at(body).next.q * n; }
  /// A place of the resting wall at the start of the step [m].
  Vec3 to_space(int wall, const Vec3& rest) const {
    const int body = body_of(wall);
    return body < 0 ? rest : at(body).now.to_space(rest);
  }
  /// Where, at the start of the step, the body was that is at x at its end [m].
  Vec3 to_start(int body, const Vec3& x) const { return at(body).now.to_space(at(body).next.to_rest(x)); }
  Vec3 to_end(int body, const Vec3& x) const { return at(body).next.to_space(at(body).now.to_rest(x)); }
  Vec3 turned_to_end(int body, const Vec3& n) const {
    return at(body).next.q * (at(body).now.q.conjugate() * n);
  }

  /// Velocity of the body, in this step and by how much it is more than in the last one; zero for walls that
  /// stand [m/s].
  Vec3 velocity(int wall, const Vec3& x) const {
    const int body = body_of(wall);
    return body < 0 ? Vec3(Vec3::Zero()) : at(body).twist.velocity(x);
  }
  Vec3 change(int wall, const Vec3& x) const {
    const int body = body_of(wall);
    return body < 0 ? Vec3(Vec3::Zero()) : Vec3(at(body).twist.velocity(x) - at(body).last.velocity(x));
  }
  /// Of the surface: of the body, and of a belt along it [m/s].
  Vec3 surface_velocity(int wall, const Vec3& x) const;
  /// Work of a load on a wall over the step [J]. @param angular_impulse  about the origin [N m s]
  double work(int wall, const Vec3& impulse, const Vec3& angular_impulse) const;
  double fastest() const { return fastest_; }  ///< speed of any point of these walls, ever [m/s]

 private:
  struct Body {
    Pose now, next;     ///< at the start and the end of the step
    Twist last, twist;  ///< of the last step and of this one
  };
  const Body& at(int body) const { return bodies_[static_cast<std::size_t>(body)]; }

  const Walls& walls_;
  std::vector<WallMotion> motions_;
  std::vector<Body> bodies_;  ///< of each motion, then those of set_bodies and their images
  std::vector<int> body_of_;  ///< per wall
  std::vector<RoundBody> round_;
  std::vector<int> image_of_;  ///< per wall behind the scene's: index in set_bodies
  double fastest_ = 0;
  bool moved_ = true;  ///< since the last call of place
};

}  // namespace sluice
