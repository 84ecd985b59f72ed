#pragma once
/// Rigid motion of a wall, as a function of time alone: the same pose on every thread and after a restart.
///
///   vibration   s(t) = a sin(2 pi f t + phase) + b cos(2 pi f t + phase), half strokes a and b: a line, and
///               with a second stroke across it the ellipse or circle of a screen box
///   rotation    about an axis through a centre, at constant speed
///   keyframes   shift and turn at given times, cubic in between with the slopes of Catmull and Rom (1974),
///               for unequal intervals those of the parabola through three keys; a turn is a rotation vector
///
/// The CAD is the wall at rest: the middle of a vibration, the first moment of a rotation, a keyframe
/// without shift and turn. A belt's surface velocity comes on top, in the wall's own frame.

#include <span>
#include <vector>

#include "base/pose.h"
#include "base/schema.h"

namespace sluice {

enum class MotionKind { vibration, rotation, keyframes };
enum class AfterLast { hold, repeat };

/// One entry of `keyframes:`.
struct WallKeyframe {
  double time = 0;            ///< [s]
  Vec3 shift = Vec3::Zero();  ///< of the centre from its place at rest [m]
  Vec3 turn = Vec3::Zero();   ///< axis times angle; about one axis any number of turns [rad]
  void keys(Schema& s);
  bool operator==(const WallKeyframe&) const = default;
};

/// Keys under `walls: NAME: motion:`.
struct WallMotion {
  MotionKind kind = MotionKind::vibration;
  double start = 0;  ///< the wall stands until then [s]
  double ramp = 0;   ///< time in which it comes to its full speed or stroke [s]
  // vibration
  Vec3 direction = Vec3::UnitX();
  double stroke = 0;  ///< from end to end [m]
  Vec3 cross_direction = Vec3::UnitZ();
  double cross_stroke = 0;  ///< a quarter of a period ahead; 0 = vibration along a line [m]
  double frequency = 0;     ///< [Hz]
  double phase = 0;         ///< [rad]
  // rotation
  Vec3 axis = Vec3::UnitY();
  double speed = 0;            ///< right-handed about the axis [rad/s]
  Vec3 centre = Vec3::Zero();  ///< of rotation, and of the keyframes' turns; rest frame [m]
  // keyframes
  std::vector<WallKeyframe> keyframes;
  AfterLast after_last = AfterLast::hold;

  void keys(Schema& s);
  bool operator==(const WallMotion&) const = default;
};

/// @pre directions and axis are not zero; keyframes: two or more, times ascending
Pose pose_at(const WallMotion& motion, double t);
/// Derivative of pose_at. Where the motion has a corner (a start without a ramp), that after it.
Twist twist_at(const WallMotion& motion, double t);
/// The constant twist that takes one pose to the next in `dt` [s], about the middle of their centres.
Twist twist_between(const Pose& before, const Pose& now, double dt);
/// Velocity of the material point that is now at x, from its displacement since `before` [m/s].
Vec3 velocity_between(const Pose& before, const Pose& now, const Vec3& x, double dt);

/// The shortest time in which something happens: a period, a turn, the time between two keyframes [s].
double shortest_time(const WallMotion& motion);

/// Where a motion takes points, how fast and with what acceleration: largest over its course, sampled.
struct MotionRange {
  Box swept;                ///< [m]
  double speed = 0;         ///< [m/s]
  double acceleration = 0;  ///< [m/s2]
  std::vector<Box> bounds;  ///< of the points at each sampled moment [m]
};
MotionRange motion_range(const WallMotion& motion, std::span<const Vec3> rest);

}  // namespace sluice
