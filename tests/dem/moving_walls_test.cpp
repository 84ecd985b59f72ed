// Rocks on walls that vibrate, turn and travel.
#include "dem/moving_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/memory_archive.h"
#include "base/parallel.h"
#include "dem/dem_scenes.h"
#include "geometry/make_shapes.h"

namespace sluice {
namespace {

using namespace test;
using std::numbers::pi;

constexpr double g = 9.81;
constexpr double size = 0.02, radius = 0.01;

double sinking(const DemSystem& dem) {
  return dem.mass_of(0, 0, size) * g / (dem.limits().stiffness_per_size * size);
}

/// Vibration along `direction` with the greatest acceleration `peak` [m/s2].
WallMotion vibration(const Vec3& direction, double peak, double frequency) {
  WallMotion m;
  m.direction = direction;
  m.frequency = frequency;
  m.stroke = 2 * peak / std::pow(2 * pi * frequency, 2);
  return m;
}

WallMotion rotation(const Vec3& axis, double speed) {
  WallMotion m;
  m.kind = MotionKind::rotation;
  m.axis = axis;
  m.speed = speed;
  return m;
}

/// At constant velocity from the first key's neighbour to the last but one: 1 s to 9 s.
WallMotion travel(const Vec3& velocity) {
  WallMotion m;
  m.kind = MotionKind::keyframes;
  for (int k = 0; k <= 10; ++k) m.keyframes.push_back({1.0 * k, k * velocity, Vec3::Zero()});
  return m;
}

/// A floor in a box, of one motion; the floor with a belt's velocity.
Walls tray(const WallMotion& motion, const Vec3& belt = Vec3::Zero()) {
  Wall floor = plane_wall(0.1, 3), box;
  for (Vec3& x : floor.mesh.vertices) x.z() += 0.005;
  floor.surface_velocity = belt;
  box.material = 1;
  box.mesh = make_box("box", {Vec3(-0.1, -0.1, 0), Vec3(0.1, 0.1, 0.4)});
  floor.motion = box.motion = motion;
  return Walls({floor, box});
}

void drop_rocks(DemSystem& dem, int count, int shapes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < count; ++k) {
    NewRock rock;
    rock.x = {0.06 * ((k % 3) - 1), 0.06 * ((k / 3) % 3 - 1), 0.03 + 0.035 * (k / 9)};
    rock.v = 0.2 * Vec3(any(random), any(random), any(random));
    rock.q = Quat(any(random), any(random), any(random), any(random)).normalized();
    rock.shape = k % shapes;
    rock.size = size;
    dem.add(rock);
  }
}

/// All that energy went to or came from, less what was there at first.
double balance(const DemEnergy& e) {
  return e.kinetic + e.potential + e.elastic + e.dissipated_normal + e.dissipated_friction - e.wall_work;
}

TEST(VibratingFloor, BelowOneGCarriesWithWeightTimesItsAcceleration) {
  Wall floor = plane_wall(0.3, 4);
  floor.motion = vibration(Vec3::UnitZ(), 0.6 * g, 20);
  floor.motion->ramp = 0.1;
  const Walls walls = walls_of(floor);
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, size), walls);
  dem.add({.x = {0.01, 0.02, radius}, .size = size});
  dem.add({.x = {0.1, 0.02, radius}, .size = size});
  const double dt = dem.step_size(), w = 2 * pi * 20, depth = sinking(dem);
  const double at_start = balance(dem.energy());
  double before = 0, worst_force = 0, worst_place = 0, worst_energy = 0, most_work = 0;
  for (int k = 0; k * dt < 0.4; ++k) {
    dem.step(k * dt, dt);
    const double t = (k + 1) * dt, impulse = dem.wall_loads()[0].impulse.z();
    if (t > 0.2) {
      // The impulse of a step is that of its middle.
      const double a = -0.6 * g * std::sin(w * (t - 0.5 * dt));
      worst_force =
          std::max(worst_force, std::abs((before - impulse) / dt / (2 * dem.rocks().mass[0]) - g - a));
      const double z = pose_at(*floor.motion, t).at.z() + radius - depth;
      worst_place = std::max(worst_place, std::abs(dem.rocks().x[0].z() - z));
      EXPECT_EQ(dem.contact_count(), 2u);
    }
    before = impulse;
    if (k % 10 > 0) continue;
    const DemEnergy e = dem.energy();
    worst_energy = std::max(worst_energy, std::abs(balance(e) - at_start));
    most_work = std::max(most_work, std::abs(e.wall_work));
  }
  EXPECT_LT(worst_energy, 1e-5 * most_work);
  EXPECT_LT(worst_force, 2e-3 * g);
  EXPECT_LT(worst_place, depth);  // the spring gives by 0.6 of it
}

TEST(VibratingFloor, AboveOneGLetsGoAtMinusGAndTheRockFliesFreely) {
  Wall floor = plane_wall(0.3);
  floor.motion = vibration(Vec3::UnitZ(), 2 * g, 10);
  floor.motion->phase = -pi / 2;  // from the lowest point, at rest
  const Walls walls = walls_of(floor);
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, size), walls);
  const double A = floor.motion->stroke / 2, w = 2 * pi * 10;
  dem.add({.x = {0, 0, radius - A - sinking(dem)}, .size = size});
  // Lets go where A w2 sin = g, at 30 degrees past the middle.
  const double leaves = (pi / 2 + pi / 6) / w, dt = dem.step_size();
  const double z = A * 0.5 + radius, v = A * w * std::sqrt(0.75);
  double largest = 0;
  for (int k = 0; k * dt < leaves + 0.03; ++k) {
    dem.step(k * dt, dt);
    const double t = (k + 1) * dt - leaves;
    if (t < 0.002) continue;
    EXPECT_EQ(dem.contact_count(), 0u);
    largest = std::max(largest, std::abs(dem.rocks().x[0].z() - (z + v * t - 0.5 * g * t * t)));
  }
  EXPECT_LT(largest, 3e-5);
}

TEST(VibratingFloor, GivesARestingRockNoEnergyAndTakesNone) {
  // Undamped: an inconsistency between places and velocities would show as growth or decay.
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 0, 2)}) {
    Wall floor = plane_wall(0.3);
    floor.motion = vibration(direction, 0.5 * g, 25);
    floor.motion->ramp = 0.08;
    const Walls walls = walls_of(floor);
    DemSystem resting({}, scene_of({1, 0.8, 0}, size), walls);
    resting.add({.x = {0, 0, radius - sinking(resting)}, .size = size});
    const double dt = resting.step_size();
    const auto swing = [&](double from, double to) {
      double most = 0;
      for (int k = static_cast<int>(from / dt); k < static_cast<int>(to / dt); ++k) {
        resting.step(k * dt, dt);
        const double gap = resting.rocks().x[0].z() - pose_at(*floor.motion, (k + 1) * dt).at.z() - radius;
        most = std::max(most, -gap);
      }
      return most;
    };
    swing(0, 0.2);
    const double early = swing(0.2, 0.6);
    swing(0.6, 2.6);
    const double late = swing(2.6, 3.0);
    EXPECT_NEAR(late, early, 0.01 * early);
    EXPECT_LT(early, 1.6 * sinking(resting));
  }
}

TEST(TravellingPlate, IsThePlateAtRestSeenFromElsewhere) {
  const Vec3 U(0.3, -0.2, 0.5);
  struct Outcome {
    std::vector<Vec3> x, v, w;
    DemEnergy energy;
  };
  std::vector<Outcome> outcomes;
  for (bool moves : {false, true}) {
    Wall plate = plane_wall(0.5, 3);
    plate.surface_velocity = {0.2, 0.1, 0};
    if (moves) plate.motion = travel(U);
    const Walls walls = walls_of(plate);
    DemScene scene = scene_of({0.5, 0.4, 0.02}, size, {make_sphere(), make_superquadric(1.4, 0.8, 3)});
    DemSystem dem({}, scene, walls);
    const Vec3 offset = moves ? U : Vec3(0, 0, 0), drift = moves ? U : Vec3(0, 0, 0);
    for (int k : {0, 1})
      dem.add({.x = Vec3(0.1 * k, 0.02, 0.02) + offset,
               .v = Vec3(0.4, -0.3, -1) + drift,
               .w = {5, 30, -10},
               .q = Quat(0.8, 0.2, 0.5, 0.3).normalized(),
               .shape = k,
               .size = size});
    const double dt = dem.step_size();
    for (int k = 0; k * dt < 0.04; ++k) dem.step(1 + k * dt, dt);
    Outcome& o = outcomes.emplace_back();
    const double t = std::ceil(0.04 / dt) * dt;
    for (std::size_t i : {0u, 1u}) {
      o.x.push_back(dem.rocks().x[i] - offset - t * drift);
      o.v.push_back(dem.rocks().v[i] - drift);
      o.w.push_back(dem.rocks().w[i]);
    }
    o.energy = dem.energy();
  }
  EXPECT_GT(outcomes[0].v[0].z(), 0);
  for (std::size_t i : {0u, 1u}) {
    EXPECT_LT((outcomes[1].x[i] - outcomes[0].x[i]).norm(), 1e-10);
    EXPECT_LT((outcomes[1].v[i] - outcomes[0].v[i]).norm(), 1e-8);
    EXPECT_LT((outcomes[1].w[i] - outcomes[0].w[i]).norm(), 1e-6);
  }
  const DemEnergy &a = outcomes[0].energy, &b = outcomes[1].energy;
  EXPECT_NEAR(a.dissipated_normal, b.dissipated_normal, 1e-8 * a.dissipated_normal);
  EXPECT_NEAR(a.dissipated_friction, b.dissipated_friction, 1e-8 * a.dissipated_friction);
  // The impulse times U is work that the plate at rest does not do.
  EXPECT_GT(b.wall_work, a.wall_work);
}

TEST(Turntable, LeadsARollingSphereOnACircleAtTwoSeventhsOfItsSpeed) {
  // Milne (1948); Weltner (1979) Am. J. Phys. 47:984: omega = 2/7 Omega, whatever the place.
  const double Omega = 7, v0 = 0.2;
  Wall table = plane_wall(1, 3);
  table.motion = rotation(Vec3::UnitZ(), Omega);
  const Walls walls = walls_of(table);
  DemSystem dem({}, scene_of({0.3, 0.8, 0}, size), walls);
  const double r = radius - sinking(dem);
  const Vec3 x(0.3, 0, r), v(0, v0, 0);
  // No slip: v + w x (0, 0, -r) = Omega z x x.
  const Vec3 slip = Omega * Vec3::UnitZ().cross(x) - v;
  dem.add({.x = x, .v = v, .w = {slip.y() / r, -slip.x() / r, 0}, .size = size});
  const double turn = 2 * pi / (2.0 / 7 * Omega);
  run(dem, 0.5 * turn);
  // Left-handed or right-handed as the table: half a circle about the point at v0 / omega to the left.
  const Vec3 across(-2 * v0 / (2.0 / 7 * Omega), 0, 0);
  EXPECT_LT((dem.rocks().x[0] - x - across).norm(), 0.01 * across.norm());
  EXPECT_LT((dem.rocks().v[0] + v).norm(), 0.01 * v0);
}

TEST(Drum, DragsASphereUntilItRollsAtTheWallsSpeed) {
  Wall drum;
  drum.material = 1;
  drum.mesh = make_tube("drum", {Vec3(0, -0.1, 0), Vec3(0, 0.1, 0), 0.2, 90, TubeEnds::open});
  drum.motion = rotation(Vec3::UnitY(), 2);
  drum.motion->ramp = 0.2;
  const Walls walls = walls_of(drum);
  DemSystem dem({}, scene_of({0.2, 0.6, 0.1}, size), walls);
  dem.add({.x = {0, 0, -0.2 * std::cos(pi / 90) + radius}, .size = size});
  // It swings about the place where its weight holds the rolling resistance: tan = 0.1, the wall's way.
  const double period = 2 * pi * std::sqrt(7.0 / 5 * 0.19 / g), dt = dem.step_size();
  double place = 0, spin = 0;
  const int settled = static_cast<int>(0.5 / dt), steps = static_cast<int>(3 * period / dt);
  for (int k = 0; k < settled + steps; ++k) {
    dem.step(k * dt, dt);
    if (k < settled) continue;
    place += dem.rocks().x[0].x() / steps;
    spin += dem.rocks().w[0].y() / steps;
  }
  EXPECT_NEAR(place, -0.19 * std::sin(std::atan(0.1)), 0.002);
  EXPECT_NEAR(spin * radius, 2 * 0.2, 0.01);
  EXPECT_GT(dem.energy().wall_work, 0);
  // Against resistance the drum needs a torque, against the turn.
  EXPECT_LT(dem.wall_loads()[0].angular_impulse.y(), 0);
}

/// Largest departure of the energy balance, over the work done, at a given step.
double energy_error(const WallMotion& motion, const Vec3& belt, double steps_per_contact) {
  const Walls walls = tray(motion, belt);
  DemConfig config;
  config.steps_per_contact = steps_per_contact;
  config.impact_speed = 1;
  DemScene scene = scene_of({0.5, 0.5, 0.02}, size, {make_sphere(), make_superquadric(1.3, 0.8, 3)});
  DemSystem dem(config, scene, walls);
  drop_rocks(dem, 18, 2);
  const double at_start = balance(dem.energy()), dt = dem.step_size();
  double most = 0;
  for (int k = 0; k * dt < 0.3; ++k) {
    dem.step(k * dt, dt);
    if (k % 50 == 0) most = std::max(most, std::abs(balance(dem.energy()) - at_start));
  }
  const DemEnergy e = dem.energy();
  return most / (e.dissipated_normal + e.dissipated_friction);
}

TEST(EnergyBalance, ClosesWithVibrationRotationAndABeltOnAMovingBody) {
  WallMotion screen = vibration({1, 0, 1}, 3 * g, 15);
  screen.cross_direction = {-1, 0, 1};
  screen.cross_stroke = 0.3 * screen.stroke;
  screen.ramp = 0.05;
  WallMotion turning = rotation({0.1, 1, 0.2}, 6);
  turning.centre = {0, 0, 0.2};
  turning.ramp = 0.05;
  for (const auto& [motion, belt] : {std::pair{screen, Vec3(0, 0, 0)}, std::pair{turning, Vec3(0, 0, 0)},
                                     std::pair{screen, Vec3(0.5, 0.2, 0)}}) {
    const double coarse = energy_error(motion, belt, 50), fine = energy_error(motion, belt, 200);
    EXPECT_LT(coarse, 0.02);
    EXPECT_LT(fine, 0.005);
  }
}

TEST(ThirdLaw, HoldsForForceAndTorqueOnMovingWalls) {
  std::vector<Wall> all = tray(rotation({0.1, 1, 0.2}, 6)).all();
  all.insert(all.begin(), plane_wall(0.3));
  for (Vec3& x : all.front().mesh.vertices) x.z() = -0.5;
  const Walls walls(all);
  DemScene scene = scene_of({0.5, 0.5, 0.02}, size);
  scene.gravity = Vec3::Zero();
  DemSystem dem({}, scene, walls);
  drop_rocks(dem, 18, 1);
  const auto angular = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < dem.rocks().count(); ++i)
      sum += dem.rocks().mass[i] * dem.rocks().x[i].cross(dem.rocks().v[i]) +
             dem.inertia(i).x() * dem.rocks().w[i];
    return sum;
  };
  const Vec3 momentum = dem.momentum(), about_origin = angular();
  run(dem, 0.3);
  Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();
  for (const WallLoad& load : dem.wall_loads()) {
    impulse += load.impulse;
    moment += load.angular_impulse;
  }
  EXPECT_EQ(dem.wall_loads()[0].impulse, Vec3(0, 0, 0));
  EXPECT_GT(impulse.norm(), 0.01);
  EXPECT_LT((dem.momentum() + impulse - momentum).norm(), 1e-12 * dem.rocks().count());
  // Contacts between rocks pair their forces at one point: their torques cancel to rounding as well.
  EXPECT_LT((angular() + moment - about_origin).norm(), 1e-12);
}

TEST(SurfaceMotion, SumsUpToTheWayOfTheMaterialPoint) {
  // Ten steps a turn: the velocity at any one instant would not do.
  for (const WallMotion& motion : {rotation({0.3, 1, 0}, 5), vibration({1, 0, 1}, 20, 12)}) {
    Wall wall = plane_wall(0.3);
    wall.motion = motion;
    const Walls walls = walls_of(wall);
    MovingWalls part = std::move(moving_walls(walls).front());
    const Vec3 rest(0.2, -0.1, 0);
    const double dt = shortest_time(motion) / 10;
    Vec3 way = Vec3::Zero();
    for (int k = 0; k < 13; ++k) {
      part.move(k * dt, dt);
      way += dt * part.surface_motion(part.to_space({.wall = 0, .normal = Vec3::UnitZ(), .point = rest}), dt)
                      .velocity;
    }
    EXPECT_LT((part.now.to_space(rest) - pose_at(motion, 0).to_space(rest) - way).norm(), 1e-15);
  }
}

TEST(MovingWalls, GiveTheSameBitsWithAnyNumberOfThreadsAndAfterARestart) {
  const int threads = thread_count();
  std::vector<Wall> all = tray(vibration({1, 0, 1}, 0.8 * g, 15)).all();
  Wall paddle;
  paddle.material = 1;
  paddle.mesh = make_box("paddle", {Vec3(-0.05, -0.08, 0.08), Vec3(0.05, 0.08, 0.09)});
  paddle.motion = rotation(Vec3::UnitY(), 8);
  paddle.motion->centre = {0, 0, 0.085};
  all.push_back(paddle);
  all.push_back(plane_wall(0.4));
  for (Vec3& x : all.back().mesh.vertices) x.z() = -0.05;
  const Walls walls(all);
  const DemScene scene = scene_of({0.3, 0.5, 0.05}, size, {make_sphere(), make_superquadric(1.5, 0.8, 3)});
  DemConfig soft;
  soft.impact_speed = 0.5;  // a longer step
  const auto go_on = [](DemSystem& dem, double from, double to) {
    const double dt = dem.step_size();
    for (int k = static_cast<int>(from / dt); k < static_cast<int>(to / dt); ++k) dem.step(k * dt, dt);
  };
  std::uint64_t expected = 0;
  double work = 0;
  for (int n : {1, 2, 3}) {
    set_thread_count(n);
    DemSystem dem(soft, scene, walls);
    drop_rocks(dem, 45, 2);
    go_on(dem, 0, 0.15);
    if (n == 1) {
      expected = dem.state_hash();
      work = dem.energy().wall_work;
    }
    EXPECT_EQ(dem.state_hash(), expected);
    EXPECT_EQ(dem.energy().wall_work, work);
  }
  set_thread_count(threads);
  DemSystem first(soft, scene, walls), second(soft, scene, walls);
  drop_rocks(first, 45, 2);
  go_on(first, 0, 0.1);
  EXPECT_GT(first.contact_count(), 3u);
  MemoryArchive archive;
  first.exchange(archive);
  archive.rewind_to_load();
  second.exchange(archive);
  go_on(second, 0.1, 0.15);
  EXPECT_EQ(second.state_hash(), expected);
  EXPECT_EQ(second.energy().wall_work, work);
}

TEST(HasRoom, AsksWhereTheWallIsNow) {
  Wall plate = plane_wall(0.3);
  plate.motion = travel({0, 0, 1});
  const Walls walls = walls_of(plate);
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, size), walls);
  EXPECT_FALSE(dem.has_room({0, 0, 0}, 0.01, true));
  EXPECT_TRUE(dem.has_room({0, 0, 2}, 0.01, true));
  dem.step(2 - 1e-5, 1e-5);
  EXPECT_TRUE(dem.has_room({0, 0, 0}, 0.01, true));
  EXPECT_FALSE(dem.has_room({0, 0, 2.009}, 0.01, true));
}

TEST(Removal, KeepsTheContactsOfTheOthers) {
  Wall floor = plane_wall(0.3);
  floor.motion = vibration(Vec3::UnitZ(), 0.5 * g, 20);
  floor.motion->ramp = 0.05;
  const Walls walls = walls_of(floor);
  DemSystem two({}, scene_of({0.3, 0.5, 0}, size), walls), one({}, scene_of({0.3, 0.5, 0}, size), walls);
  two.add({.x = {0.1, 0, radius}, .size = size});
  two.add({.x = {0, 0, radius}, .v = {0.3, 0, 0}, .size = size});
  one.add({.x = {0, 0, radius}, .v = {0.3, 0, 0}, .size = size});
  const double dt = two.step_size();
  for (int k = 0; k < 3000; ++k) {
    two.step(k * dt, dt);
    one.step(k * dt, dt);
    if (k == 1000) two.remove(std::array<std::size_t, 1>{0});
  }
  EXPECT_EQ(two.rocks().x[0], one.rocks().x[0]);
  EXPECT_EQ(two.rocks().w[0], one.rocks().w[0]);
}

}  // namespace
}  // namespace sluice
