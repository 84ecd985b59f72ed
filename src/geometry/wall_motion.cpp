#include "geometry/wall_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

namespace {

/// A quantity that depends on time, and its derivative.
struct Moved {
  double value, rate;
};

/// From 0 at u = 0 to 1 at u = 1 with neither speed nor acceleration at the ends, over `ramp` [s].
Moved rise(double t, double ramp) {
  if (t >= ramp) return {1, 0};
  const double u = t / ramp;
  return {u * u * u * (10 - 15 * u + 6 * u * u), 30 * u * u * (1 - u) * (1 - u) / ramp};
}

/// Integral of the rise [s].
double risen(double t, double ramp) {
  if (t >= ramp) return t - 0.5 * ramp;
  const double u = t / ramp;
  return ramp * u * u * u * u * (2.5 - 3 * u + u * u);
}

Quat rotation_of(const Vec3& turn) {
  const double angle = turn.norm();
  if (angle == 0) return Quat::Identity();
  return Quat(Eigen::AngleAxisd(angle, turn / angle));
}

/// Angular velocity of exp(turn) whose rotation vector changes at `rate` (left Jacobian of SO(3)).
Vec3 spin_of(const Vec3& turn, const Vec3& rate) {
  constexpr double small = 1e-3;  // below it the series' next term is under 1e-15
  const double angle2 = turn.squaredNorm(), angle = std::sqrt(angle2);
  const double half = std::sin(0.5 * angle);
  const double b = angle > small ? 2 * half * half / angle2 : 0.5 - angle2 / 24;
  const double c = angle > small ? (angle - std::sin(angle)) / (angle2 * angle) : 1.0 / 6 - angle2 / 120;
  return rate + b * turn.cross(rate) + c * turn.cross(turn.cross(rate));
}

struct Frame {
  Vec3 shift, turn, shift_rate, turn_rate;
};

/// Slope at key k of the parabola through it and its neighbours.
template <class Value>
Vec3 slope(const WallMotion& m, std::size_t k, const Value& value) {
  const auto& keys = m.keyframes;
  const std::size_t last = keys.size() - 1;
  const bool end = k == 0 || k == last;
  if (end && m.after_last == AfterLast::hold) return Vec3::Zero();
  const std::size_t before = end ? last - 1 : k - 1, after = end ? 1 : k + 1;
  const double h1 = end ? keys[last].time - keys[before].time : keys[k].time - keys[before].time;
  const double h2 = end ? keys[1].time - keys[0].time : keys[after].time - keys[k].time;
  const Vec3 d1 = (value(keys[end ? last : k]) - value(keys[before])) / h1;
  const Vec3 d2 = (value(keys[after]) - value(keys[end ? 0 : k])) / h2;
  return (h2 * d1 + h1 * d2) / (h1 + h2);
}

Frame frame_at(const WallMotion& m, double t) {
  const auto& keys = m.keyframes;
  const double first = keys.front().time, last = keys.back().time;
  if (t > last && m.after_last == AfterLast::repeat) t = first + std::fmod(t - first, last - first);
  if (t < first) return {keys.front().shift, keys.front().turn, Vec3::Zero(), Vec3::Zero()};
  if (t >= last && m.after_last == AfterLast::hold)
    return {keys.back().shift, keys.back().turn, Vec3::Zero(), Vec3::Zero()};
  std::size_t k = 0;
  while (k + 2 < keys.size() && t >= keys[k + 1].time) ++k;
  const double h = keys[k + 1].time - keys[k].time, u = (t - keys[k].time) / h;
  const auto between = [&](const auto& value, Vec3& at, Vec3& rate) {
    const Vec3 m0 = h * slope(m, k, value), m1 = h * slope(m, k + 1, value);
    const Vec3 p0 = value(keys[k]), step = value(keys[k + 1]) - p0;
    // Hermite's cubic about the straight line between the keys.
    const Vec3 c2 = 3 * step - 2 * m0 - m1, c3 = m0 + m1 - 2 * step;
    at = p0 + u * (m0 + u * (c2 + u * c3));
    rate = (m0 + u * (2 * c2 + u * 3 * c3)) / h;
  };
  Frame frame;
  between([](const WallKeyframe& key) { return key.shift; }, frame.shift, frame.shift_rate);
  between([](const WallKeyframe& key) { return key.turn; }, frame.turn, frame.turn_rate);
  return frame;
}

/// Shift of a vibration and its rate, `t` [s] after its start.
std::array<Vec3, 2> vibration_at(const WallMotion& m, double t) {
  const double w = 2 * std::numbers::pi * m.frequency, angle = w * t + m.phase;
  const double s = std::sin(angle), c = std::cos(angle);
  const Vec3 a = 0.5 * m.stroke * m.direction.normalized();
  const Vec3 b = 0.5 * m.cross_stroke * m.cross_direction.normalized();
  const Moved part = rise(t, m.ramp);
  const Vec3 full = s * a + c * b;
  return {part.value * full, part.rate * full + part.value * w * (c * a - s * b)};
}

}  // namespace

Pose pose_at(const WallMotion& m, double t) {
  Pose pose;
  const double since = std::max(0.0, t - m.start);
  switch (m.kind) {
    case MotionKind::vibration:
      pose.at = vibration_at(m, since)[0];
      break;
    case MotionKind::rotation:
      pose.centre = pose.at = m.centre;
      pose.q = Quat(Eigen::AngleAxisd(m.speed * risen(since, m.ramp), m.axis.normalized()));
      break;
    case MotionKind::keyframes: {
      const Frame frame = frame_at(m, t);
      pose.centre = m.centre;
      pose.at = m.centre + frame.shift;
      pose.q = rotation_of(frame.turn);
      break;
    }
  }
  return pose;
}

Twist twist_at(const WallMotion& m, double t) {
  Twist twist;
  twist.at = pose_at(m, t).at;
  const double since = t - m.start;
  switch (m.kind) {
    case MotionKind::vibration:
      if (since >= 0) twist.v = vibration_at(m, since)[1];
      break;
    case MotionKind::rotation:
      if (since >= 0) twist.w = m.speed * rise(since, m.ramp).value * m.axis.normalized();
      break;
    case MotionKind::keyframes: {
      const Frame frame = frame_at(m, t);
      twist.v = frame.shift_rate;
      twist.w = spin_of(frame.turn, frame.turn_rate);
      break;
    }
  }
  return twist;
}

Twist twist_between(const Pose& before, const Pose& now, double dt) {
  const Eigen::AngleAxisd turned(now.q * before.q.conjugate());
  return {(now.at - before.at) / dt, turned.angle() / dt * turned.axis(), 0.5 * (before.at + now.at)};
}

Vec3 velocity_between(const Pose& before, const Pose& now, const Vec3& x, double dt) {
  // The centre's way and the arm's apart: without a turn nothing is left of the arm's rounding.
  const Vec3 arm = now.q.conjugate() * (x - now.at);
  return ((now.at - before.at) + (now.q * arm - before.q * arm)) / dt;
}

double shortest_time(const WallMotion& m) {
  switch (m.kind) {
    case MotionKind::vibration:
      return 1 / m.frequency;
    case MotionKind::rotation:
      return 2 * std::numbers::pi / std::abs(m.speed);
    case MotionKind::keyframes:
      break;
  }
  double shortest = m.keyframes.back().time - m.keyframes.front().time;
  for (std::size_t k = 1; k < m.keyframes.size(); ++k)
    shortest = std::min(shortest, m.keyframes[k].time - m.keyframes[k - 1].time);
  return shortest;
}

MotionRange motion_range(const WallMotion& m, std::span<const Vec3> rest) {
  constexpr int samples = 64;  // a period, or from one keyframe to the next: peaks to 1e-3
  std::vector<double> moments;
  if (m.kind == MotionKind::keyframes) {
    for (std::size_t k = 1; k < m.keyframes.size(); ++k)
      for (int i = 0; i < samples; ++i)
        moments.push_back(m.keyframes[k - 1].time +
                          (m.keyframes[k].time - m.keyframes[k - 1].time) * (i + 0.5) / samples);
    for (const WallKeyframe& key : m.keyframes) moments.push_back(key.time);
  } else {
    for (int i = 0; i < samples; ++i)
      moments.push_back(m.start + m.ramp + shortest_time(m) * (i + 0.5) / samples);
  }
  const double h = 1e-4 * shortest_time(m);
  MotionRange range;
  for (double t : moments) {
    const Pose pose = pose_at(m, t), earlier = pose_at(m, t - h), later = pose_at(m, t + h);
    const Twist twist = twist_at(m, t), before = twist_at(m, t - h), after = twist_at(m, t + h);
    Box& bounds = range.bounds.emplace_back();
    for (const Vec3& r : rest) {
      const Vec3 x = pose.to_space(r);
      bounds.include(x);
      range.speed = std::max(range.speed, twist.velocity(x).norm());
      const Vec3 change = after.velocity(later.to_space(r)) - before.velocity(earlier.to_space(r));
      range.acceleration = std::max(range.acceleration, change.norm() / (2 * h));
    }
    range.swept.include(bounds);
  }
  return range;
}

}  // namespace sluice
