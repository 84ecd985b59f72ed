// Motions of walls: poses and velocities belong together, keyframes are met, starts are smooth.
#include "geometry/wall_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/wall.h"

namespace sluice {
namespace {

using std::numbers::pi;

WallMotion screen() {
  WallMotion m;
  m.direction = {1, 0, 1};
  m.stroke = 0.008;
  m.cross_direction = {-1, 0, 1};
  m.cross_stroke = 0.003;
  m.frequency = 15;
  m.phase = 0.4;
  return m;
}

WallMotion drum() {
  WallMotion m;
  m.kind = MotionKind::rotation;
  m.axis = {0.2, 2, -0.5};
  m.centre = {0.3, -0.2, 1};
  m.speed = -3;
  return m;
}

WallMotion gate(AfterLast after) {
  WallMotion m;
  m.kind = MotionKind::keyframes;
  m.centre = {0.1, 0.2, 0.3};
  m.after_last = after;
  m.keyframes = {{0.5, {0, 0, 0}, {0, 0, 0}},
                 {1, {0.1, 0, 0.2}, {0, 1, 0}},
                 {1.2, {0.2, -0.1, 0.2}, {0.3, 2, 0.1}},
                 {2.5, {0, 0, 0}, {0, 0, 0}}};
  return m;
}

std::vector<WallMotion> all_kinds() {
  std::vector<WallMotion> all{screen(), drum(), gate(AfterLast::hold), gate(AfterLast::repeat)};
  for (std::size_t k : {0, 1}) {
    all.push_back(all[k]);
    all.back().start = 0.3;
    all.back().ramp = 0.8;
  }
  return all;
}

TEST(WallMotion, HasTheDerivativeOfItsPoseAsVelocity) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1), moment(0, 4);
  for (const WallMotion& m : all_kinds())
    for (int k = 0; k < 200; ++k) {
      const Vec3 rest(place(random), place(random), place(random));
      const double t = moment(random), h = 1e-5;
      // A corner of the acceleration (a key, a start) costs one order.
      const Vec3 slope = (pose_at(m, t + h).to_space(rest) - pose_at(m, t - h).to_space(rest)) / (2 * h);
      const Vec3 v = twist_at(m, t).velocity(pose_at(m, t).to_space(rest));
      EXPECT_LT((v - slope).norm(), 2e-4) << static_cast<int>(m.kind) << " t=" << t;
    }
}

TEST(WallMotion, IsRigidAndComesBackToRest) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(-1, 1), moment(0, 4);
  for (const WallMotion& m : all_kinds())
    for (int k = 0; k < 100; ++k) {
      const Vec3 a(place(random), place(random), place(random)), b(place(random), place(random), 0);
      const Pose pose = pose_at(m, moment(random));
      EXPECT_LT((pose.to_rest(pose.to_space(a)) - a).norm(), 1e-14);
      EXPECT_NEAR((pose.to_space(a) - pose.to_space(b)).norm(), (a - b).norm(), 1e-14);
    }
}

TEST(WallMotion, IsAlongALineWithHalfTheStrokeToEachSide) {
  WallMotion m;
  m.direction = {3, 0, 4};
  m.stroke = 0.02;
  m.frequency = 10;
  EXPECT_LT((pose_at(m, 0.025).at - 0.01 * Vec3(0.6, 0, 0.8)).norm(), 1e-15);
  EXPECT_LT((pose_at(m, 0.075).at + 0.01 * Vec3(0.6, 0, 0.8)).norm(), 1e-15);
  EXPECT_EQ(pose_at(m, 0).at, Vec3(0, 0, 0));
  EXPECT_NEAR(twist_at(m, 0).v.norm(), 0.01 * 2 * pi * 10, 1e-15);
}

TEST(WallMotion, OfTwoEqualStrokesIsACircle) {
  WallMotion m;
  m.direction = Vec3::UnitX();
  m.cross_direction = Vec3::UnitZ();
  m.stroke = m.cross_stroke = 0.01;
  m.frequency = 16;
  for (double t : {0.0, 0.01, 0.023, 0.4}) {
    EXPECT_NEAR(pose_at(m, t).at.norm(), 0.005, 1e-16);
    EXPECT_NEAR(twist_at(m, t).v.norm(), 0.005 * 2 * pi * 16, 1e-14);
  }
  // From the cross direction towards the direction.
  EXPECT_LT((pose_at(m, 0).at - Vec3(0, 0, 0.005)).norm(), 1e-16);
  EXPECT_LT((pose_at(m, 0.25 / 16).at - Vec3(0.005, 0, 0)).norm(), 1e-16);
}

TEST(WallMotion, TurnsRightHandedAtItsSpeed) {
  WallMotion m;
  m.kind = MotionKind::rotation;
  m.axis = Vec3::UnitZ();
  m.centre = {1, 0, 0};
  m.speed = pi;
  EXPECT_LT((pose_at(m, 0.5).to_space({2, 0, 3}) - Vec3(1, 1, 3)).norm(), 1e-15);
  EXPECT_LT((pose_at(m, 200).to_space({2, 0, 3}) - Vec3(2, 0, 3)).norm(), 1e-12);
}

TEST(WallMotion, StandsUntilItsStartAndRisesSmoothly) {
  for (WallMotion m : {screen(), drum()}) {
    m.start = 0.5;
    m.ramp = 1;
    const Vec3 rest(0.4, 0.1, -0.2);
    EXPECT_EQ(pose_at(m, 0.5).to_space(rest), pose_at(m, 0).to_space(rest));
    EXPECT_EQ(twist_at(m, 0.499).velocity(rest), Vec3(0, 0, 0));
    EXPECT_LT(twist_at(m, 0.501).velocity(rest).norm(), 1e-5);
    // After the ramp it is the motion itself; a rotation has lost half the ramp's time.
    WallMotion plain = m;
    plain.ramp = 0;
    const double late = m.kind == MotionKind::rotation ? 0.5 : 0.0;
    EXPECT_LT((pose_at(m, 1.9).to_space(rest) - pose_at(plain, 1.9 - late).to_space(rest)).norm(), 1e-14);
  }
}

TEST(Keyframes, ArePassedExactlyAndWithoutAJumpOfVelocity) {
  for (AfterLast after : {AfterLast::hold, AfterLast::repeat}) {
    const WallMotion m = gate(after);
    for (const WallKeyframe& key : m.keyframes) {
      const Pose pose = pose_at(m, key.time);
      EXPECT_LT((pose.at - m.centre - key.shift).norm(), 1e-15);
      const double angle = key.turn.norm();
      const Vec3 axis = angle > 0 ? Vec3(key.turn / angle) : Vec3(Vec3::UnitX());
      EXPECT_LT(pose.q.angularDistance(Quat(Eigen::AngleAxisd(angle, axis))), 1e-7);
      const Twist before = twist_at(m, key.time - 1e-9), behind = twist_at(m, key.time + 1e-9);
      if (after == AfterLast::repeat && key.time == 0.5) continue;  // it sets out from rest
      EXPECT_LT((before.v - behind.v).norm(), 1e-6);
      EXPECT_LT((before.w - behind.w).norm(), 1e-6);
    }
  }
}

TEST(Keyframes, HoldOrRepeat) {
  const WallMotion hold = gate(AfterLast::hold), repeat = gate(AfterLast::repeat);
  const Vec3 rest(0.5, 0.4, 0.3);
  EXPECT_LT((pose_at(hold, 7).to_space(rest) - rest).norm(), 1e-15);
  EXPECT_EQ(twist_at(hold, 7).v, Vec3(0, 0, 0));
  EXPECT_LT((pose_at(repeat, 7.1).to_space(rest) - pose_at(repeat, 1.1).to_space(rest)).norm(), 1e-14);
}

TEST(Keyframes, OnALineInTimeMoveAtConstantSpeedAndTurnMoreThanOnce) {
  WallMotion m;
  m.kind = MotionKind::keyframes;
  for (int k = 0; k < 6; ++k)
    m.keyframes.push_back({0.5 * k + 0.1 * (k % 2), Vec3(1, 2, 0) * (0.5 * k + 0.1 * (k % 2)),
                           Vec3(0, 0, 4) * (0.5 * k + 0.1 * (k % 2))});
  for (double t = 0.7; t < 1.9; t += 0.07) {
    EXPECT_LT((pose_at(m, t).at - t * Vec3(1, 2, 0)).norm(), 1e-14);
    EXPECT_LT((twist_at(m, t).w - Vec3(0, 0, 4)).norm(), 1e-12);
  }
}

TEST(TwistBetween, TakesPointsFromOnePoseToTheNext) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> place(-1, 1), moment(0.6, 2);
  for (const WallMotion& m : all_kinds())
    for (int k = 0; k < 100; ++k) {
      const double t = moment(random), dt = 1e-4;
      const Vec3 rest(place(random), place(random), place(random));
      const Pose before = pose_at(m, t), now = pose_at(m, t + dt);
      const Vec3 from = before.to_space(rest), to = now.to_space(rest);
      EXPECT_LT((velocity_between(before, now, to, dt) - (to - from) / dt).norm(), 1e-10);
      // The twist is right at the middle of the way.
      const Vec3 v = twist_between(before, now, dt).velocity(0.5 * (from + to));
      EXPECT_LT((v - (to - from) / dt).norm(), 1e-6);
    }
}

TEST(MotionRange, IsThatOfTheClosedForms) {
  const std::vector<Vec3> rest{{1, 0, 0}, {1, 0.5, 0}};
  WallMotion m;
  m.direction = Vec3::UnitX();
  m.stroke = 0.01;
  m.frequency = 15;
  const double w = 2 * pi * 15;
  MotionRange range = motion_range(m, rest);
  EXPECT_NEAR(range.speed, 0.005 * w, 2e-3 * 0.005 * w);
  EXPECT_NEAR(range.acceleration, 0.005 * w * w, 2e-3 * 0.005 * w * w);
  EXPECT_NEAR(range.swept.lo.x(), 0.995, 1e-5);
  EXPECT_NEAR(range.swept.hi.x(), 1.005, 1e-5);

  m = {};
  m.kind = MotionKind::rotation;
  m.axis = Vec3::UnitY();
  m.speed = 4;
  range = motion_range(m, rest);
  EXPECT_NEAR(range.speed, 4, 1e-12);
  EXPECT_NEAR(range.acceleration, 16, 1e-4);
  EXPECT_NEAR(range.swept.lo.z(), -1, 2e-3);
  EXPECT_NEAR(range.swept.hi.y(), 0.5, 1e-12);
}

TEST(MeshAt, IsTheMeshWhereTheWallIs) {
  Wall wall;
  wall.mesh = make_box("box", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  EXPECT_EQ(mesh_at(wall, 3).vertices, wall.mesh.vertices);
  wall.motion = drum();
  const TriMesh mesh = mesh_at(wall, 3);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_LE((mesh.vertices[v] - pose_at(*wall.motion, 3).to_space(wall.mesh.vertices[v])).norm(), 1e-14);
}

}  // namespace
}  // namespace sluice
