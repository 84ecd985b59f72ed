/// Water in vessels that move.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/memory_archive.h"
#include "base/parallel.h"
#include "geometry/make_shapes.h"
#include "mpm/water_scenes.h"

namespace sluice {
namespace {

constexpr double h = 0.02;
const Box vessel{Vec3(0.003, -0.007, 0.005), Vec3(0.003 + 6 * h, -0.007 + 3 * h, 0.005 + 6 * h)};

/// A closed box that moves, with water up to a share of its height.
struct Vessel {
  Vessel(const WallMotion& motion, double filled, const Vec3& gravity,
         Precision precision = Precision::single) {
    Wall wall;
    wall.name = "vessel";
    wall.mesh = make_box("vessel", vessel);
    wall.motion = motion;
    std::vector<Wall> all;
    all.push_back(std::move(wall));
    walls = Walls(std::move(all));
    MpmConfig config;
    config.spacing = h;
    config.fastest_bulk_speed = 1;
    config.deepest = gravity.norm() > 0 ? 3 * h : 0;
    config.wall_slip = WallSlip::slip;
    config.precision = precision;
    config.keep_tension = filled == 1;
    water = make_mpm(config, open_box(Vec3::Constant(-0.3), Vec3::Constant(0.5)), gravity, walls);
    Box body = vessel;
    body.hi.z() = vessel.lo.z() + filled * vessel.size().z();
    const double c = water->limits().sound_speed;
    fill_with_water(
        *water, h / 2,
        {.box = body,
         .velocity = [&](const Vec3& x) { return twist_at(motion, 0).velocity(x); },
         .J = [&](const Vec3& x) { return std::exp(gravity.z() * (body.hi.z() - x.z()) / (c * c)); }});
  }
  void run_to(double end) {
    for (const double dt = water->limits().step; t < end; t += dt) step_water(*water, t, dt);
  }
  /// Largest distance of a point outside of the vessel where it is now [h].
  double farthest_out() const {
    const Pose pose = pose_at(*walls.all()[0].motion, t);
    double out = 0;
    for (const Vec3& x : water->points().x) {
      const Vec3 rest = pose.to_rest(x);
      out = std::max({out, (vessel.lo - rest).maxCoeff(), (rest - vessel.hi).maxCoeff()});
    }
    return out / h;
  }

  Walls walls;
  std::unique_ptr<FluidSystem> water;
  double t = 0;
};

WallMotion shaken(const Vec3& direction, double stroke, double frequency) {
  WallMotion motion;
  motion.kind = MotionKind::vibration;
  motion.direction = direction;
  motion.stroke = stroke;
  motion.frequency = frequency;
  return motion;
}

/// Turns about y by an angle, or is carried, from rest to rest within `time`.
WallMotion carried(double time, const Vec3& shift, double angle) {
  WallMotion motion;
  motion.kind = MotionKind::keyframes;
  motion.centre = vessel.centre();
  const auto key = [&](double at, double share) {
    WallKeyframe frame;
    frame.time = at;
    frame.shift = share * shift;
    frame.turn = Vec3(0, share * angle, 0);
    motion.keyframes.push_back(frame);
  };
  key(-1, 0);
  key(0, 0);
  key(time / 2, 0.5);
  key(time, 1);
  key(time + 1, 1);
  return motion;
}

TEST(MovingVessel, CarriesWhatFillsItAlong) {
  for (const Vec3& direction : {Vec3(Vec3::UnitX()), Vec3(1, 0, 1).normalized()}) {
    const WallMotion motion = shaken(direction, 0.02, 4);
    Vessel full(motion, 1, Vec3::Zero());
    const double mass = full.water->total_mass(),
                 fastest = motion_range(motion, full.walls.mesh().vertices).speed;
    double worst = 0;
    while (full.t < 0.25) {
      full.run_to(full.t + 0.005);
      const double speed = full.water->momentum().dot(direction) / mass;
      worst = std::max(worst,
                       std::abs(speed - twist_at(motion, full.t).velocity(vessel.centre()).dot(direction)));
    }
    EXPECT_LT(worst, 0.05 * fastest);
    EXPECT_LT(full.farthest_out(), 1e-3);
    // What moved the water is what the walls were given back.
    const Vec3 given = full.water->momentum() - full.water->momentum_added();
    EXPECT_LT((given + full.water->wall_loads()[0].impulse).norm(), 1e-4 * mass * fastest);
  }
}

TEST(MovingVessel, DoesTheWorkThatLiftsItsWater) {
  const double rise = 0.1;
  const WallMotion motion = carried(0.3, Vec3(0, 0, rise), 0);
  Vessel lift(motion, 0.6, Vec3(0, 0, -9.81));
  const double mass = lift.water->total_mass(), kinetic = lift.water->kinetic_energy();
  lift.run_to(0.3);
  const double lifted = mass * 9.81 * (pose_at(motion, lift.t).at - pose_at(motion, 0).at).z();
  EXPECT_NEAR(lift.water->wall_work(), lifted + lift.water->kinetic_energy() - kinetic, 0.02 * lifted);
  EXPECT_LT(lift.farthest_out(), 1e-3);
}

TEST(MovingVessel, LosesNothingWhenItTilts) {
  for (const Precision precision : {Precision::single, Precision::reference}) {
    Vessel tilted(carried(0.2, Vec3::Zero(), std::numbers::pi / 6), 0.6, Vec3(0, 0, -9.81), precision);
    const double mass = tilted.water->total_mass();
    const std::size_t points = tilted.water->points().count();
    double out = 0;
    while (tilted.t < 0.25) {
      tilted.run_to(tilted.t + 0.02);
      out = std::max(out, tilted.farthest_out());
    }
    EXPECT_LT(out, 1e-3);
    EXPECT_EQ(tilted.water->points().count(), points);
    EXPECT_NEAR(tilted.water->total_mass(), mass, 1e-12 * mass);  // summed in another order
    EXPECT_LT(std::sqrt(2 * tilted.water->kinetic_energy() / mass), 0.5);
  }
}

TEST(MovingVessel, LeavesTheSameBitsForAnyNumberOfThreadsAndAfterARestart) {
  const WallMotion motion = carried(0.3, Vec3(0.02, 0, 0.01), 0.3);
  const Vec3 gravity(0, 0, -9.81);
  std::vector<std::uint64_t> hashes;
  for (int threads : {1, 2, 3}) {
    set_thread_count(threads);
    Vessel run(motion, 0.6, gravity);
    run.run_to(0.04);
    hashes.push_back(run.water->state_hash());
  }
  set_thread_count(2);
  Vessel first(motion, 0.6, gravity);
  first.run_to(0.02);
  MemoryArchive saved;
  first.water->exchange(saved);
  Vessel again(motion, 0.6, gravity);
  saved.rewind_to_load();
  again.water->exchange(saved);
  again.t = first.t;
  again.run_to(0.04);
  hashes.push_back(again.water->state_hash());
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

// Cells do not see where water goes that is squeezed between walls: it does not shoot out of nothing.
TEST(ClosingWalls, HoldTheLastOfTheWaterBetweenThem) {
  const double from = 1.4 * h, to = 0.03 * h, side = 5.3 * h, closing = 0.1;
  Wall floor, plate;
  floor.name = "floor";
  floor.mesh = make_rectangle("floor", {Vec3(-0.3, -0.3, 0.004), Vec3(0.3, -0.3, 0.004),
                                        Vec3(0.3, 0.3, 0.004), Vec3(-0.3, 0.3, 0.004)});
  plate.name = "plate";
  const double z = 0.004 + from;
  plate.mesh = make_box("plate", {Vec3(0.003, 0.001, z), Vec3(0.003 + side, 0.001 + side, z + 3 * h)});
  WallMotion motion = carried(closing, Vec3(0, 0, to - from), 0);
  plate.motion = motion;
  std::vector<Wall> all{floor, plate};
  const Walls walls(std::move(all));
  MpmConfig config;
  config.spacing = h;
  config.fastest_bulk_speed = 1;
  const auto water =
      make_mpm(config, open_box(Vec3::Constant(-0.3), Vec3::Constant(0.3)), Vec3(0, 0, -9.81), walls);
  fill_with_water(*water, h / 2, {.box = {Vec3(0, 0, 0.004), Vec3(0.006 + side, 0.002 + side, 0.004 + h)}});
  const auto fastest_below = [&] {
    double fastest = 0;
    const WaterPoints p = water->points();
    for (std::size_t i = 0; i < p.count(); ++i)
      if (p.x[i].x() > 0.003 && p.x[i].x() < 0.003 + side && p.x[i].y() > 0.001 && p.x[i].y() < 0.001 + side)
        fastest = std::max(fastest, p.v[i].norm());
    return fastest;
  };
  double t = 0;
  for (const double dt = water->limits().step; t < 0.2; t += dt) step_water(*water, t, dt);
  EXPECT_LT(fastest_below(), 0.05);
  Vec3 gap = water->momentum() - water->momentum_added() - water->impulse_from_gravity();
  for (const WallLoad& load : water->wall_loads()) gap += load.impulse;
  EXPECT_LT(gap.norm(), 1e-4 * water->impulse_from_gravity().norm());
}

}  // namespace
}  // namespace sluice
