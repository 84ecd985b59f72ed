// Rocks of many cells that the water meets with their own shape.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/memory_archive.h"
#include "base/parallel.h"
#include "coupling/bath.h"

namespace sluice {
namespace {

struct Mean {
  double value = 0, rms = 0;
};
/// Force upwards on rock 0 over the weight of the water that it displaces, from a time on.
Mean lift(Bath& bath, double volume, double from, double until) {
  double sum = 0, squares = 0;
  int count = 0;
  while (bath.t < until) {
    bath.step(Pool::Rocks::held);
    if (bath.t < from) continue;
    const double f = bath.coupling->force()[0].z() / (1000 * 9.81 * volume);
    sum += f;
    squares += f * f;
    ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

CouplingConfig partly(double from) {
  CouplingConfig config;
  config.resolve_from = from;
  return config;
}

TEST(ResolvedRock, LosesTheWeightOfTheWaterItDisplaces) {
  const double d = 4 * h;
  Bath bath(12, {.size = d}, {.x = {0.12, 0.123, 0.1241}});
  EXPECT_NEAR(bath.displaced, sphere_volume(d), 0.1 * sphere_volume(d));
  const Mean f = lift(bath, sphere_volume(d), 0.3, 0.5);
  EXPECT_NEAR(f.value, 1, 0.03);
  EXPECT_LT(f.rms, 0.02);
  EXPECT_GT(bath.coupling->wetted_fraction()[0], 0.99);
}

TEST(ResolvedRock, IsMetThroughPeriodicFaces) {
  const double d = 4 * h;
  Bath bath(12, {.size = d}, {.x = {0.239, 0.003, 0.1241}});
  const Mean f = lift(bath, sphere_volume(d), 0.2, 0.3);
  EXPECT_NEAR(f.value, 1, 0.05);
  EXPECT_LT(bath.coupling->torque()[0].norm(), 0.02 * 1000 * 9.81 * sphere_volume(d) * d);
}

TEST(ResolvedRock, OfAnyShapeLosesTheWeightOfItsWater) {
  const RockShape block = make_superquadric(1.5, 0.75, 6);
  const double size = 3 * h, volume = block.volume * size * size * size;
  const Quat turned(Eigen::AngleAxisd(0.5, Vec3(1, 2, 0.5).normalized()));
  Bath bath(11, {.size = size, .shape = block}, {.x = {0.11, 0.113, 0.1141}, .q = turned});
  const Mean f = lift(bath, volume, 0.15, 0.25);
  EXPECT_NEAR(f.value, 1, 0.05);
}

/// Largest depth of any point within rock 0 [m].
double deepest_inside(const Pool& pool) {
  const Rocks& rocks = pool.rocks->rocks();
  const WaterPoints points = pool.water->points();
  double deepest = 0;
  for (const Vec3& x : points.x) deepest = std::max(deepest, rocks.radius[0] - (x - rocks.x[0]).norm());
  return deepest;
}

TEST(ResolvedRock, HalfAsDenseAsWaterFloatsToItsMiddle) {
  const double d = 4 * h, width = 11 * h;
  Bath bath(11, {.size = d, .density = 500}, {.x = {0.11, 0.113, 0.2}});
  double height = 0, speed = 0;
  int count = 0;
  while (bath.t < 1.1) {
    bath.step(Pool::Rocks::falling);
    if (bath.t < 0.7) continue;
    height += bath.rocks->rocks().x[0].z();
    speed = std::max(speed, bath.rocks->rocks().v[0].norm());
    ++count;
  }
  const double water = width * width * width - bath.displaced;
  const double level = (water + 0.5 * sphere_volume(d)) / (width * width);
  EXPECT_NEAR(height / count, level, 0.05 * d);
  EXPECT_LT(speed, 0.1) << "it has come to rest";
  EXPECT_LT(deepest_inside(bath), 0.1 * h) << "the water is one rock step behind";
}

/// Momentum of the water that nothing accounts for, over what gravity gave it.
double momentum_gap(Bath& bath, double until) {
  const Vec3 at_start = bath.water->momentum() - bath.water->momentum_added();
  while (bath.t < until) bath.step(Pool::Rocks::falling);
  Vec3 given = bath.water->impulse_from_gravity() + bath.coupling->impulse_on_fluid() -
               bath.water->momentum_removed() + at_start;
  for (const WallLoad& load : bath.water->wall_loads()) given -= load.impulse;
  const Vec3 change = bath.water->momentum() - bath.water->momentum_added();
  return (change - given).norm() / bath.water->impulse_from_gravity().norm();
}

// The rocks' step may be the longer one: the load is that of all the water's steps in it.
TEST(ResolvedRock, CarriesTheLoadOfSeveralStepsOfTheWater) {
  const double d = 4 * h, weight = 1000 * 9.81 * sphere_volume(d);
  const int steps = 3;
  Bath bath(12, {.size = d}, {.x = {0.12, 0.123, 0.1241}});
  double sum = 0, time = 0;
  while (bath.t < 0.6) {
    const double before = bath.t;
    bath.step(Pool::Rocks::held, steps);
    if (before < 0.3) continue;
    sum += bath.coupling->force()[0].z() * (bath.t - before);
    time += bath.t - before;
  }
  EXPECT_NEAR(sum / time, weight, 0.04 * weight) << steps;
  Bath sinks(12, {.size = d}, {.x = {0.12, 0.123, 0.17}});
  Bath fine(12, {.size = d}, {.x = {0.12, 0.123, 0.17}});
  while (sinks.t < 0.15) sinks.step(Pool::Rocks::falling, steps);
  while (fine.t < sinks.t - 1e-9) fine.step(Pool::Rocks::falling);
  EXPECT_LT((sinks.coupling->impulse_on_fluid() + sinks.coupling->impulse_on_rocks()).norm(),
            1e-12 * sinks.coupling->impulse_on_rocks().norm());
  const double drop = 0.17 - fine.rocks->rocks().x[0].z();
  EXPECT_NEAR(0.17 - sinks.rocks->rocks().x[0].z(), drop, 0.05 * drop) << steps;
}

// What is missing of the drag of an ideal liquid, none, must not turn into a push.
TEST(ResolvedRock, AsDenseAsWaterStaysWhereItIs) {
  Bath bath(12, {.size = 4 * h, .density = 1000}, {.x = {0.1213, 0.1231, 0.1241}});
  while (bath.t < 0.8) bath.step(Pool::Rocks::falling);
  EXPECT_LT(bath.rocks->rocks().v[0].norm(), 0.05);
}

TEST(ResolvedRock, IsNotTurnedByWaterThatSlipsPastABall) {
  // Dropped into the pool beside its middle, it bobs at 0.15 m/s. The film's friction may turn it.
  const double d = 4 * h;
  for (const WallSlip slip : {WallSlip::slip, WallSlip::turbulent_film}) {
    Bath bath(11, {.size = d, .density = 500, .wall_slip = slip}, {.x = {0.11, 0.113, 0.2}});
    double fastest = 0;
    while (bath.t < 0.4) {
      bath.step(Pool::Rocks::falling);
      fastest = std::max(fastest, bath.rocks->rocks().w[0].norm());
    }
    EXPECT_LT(fastest * 0.5 * d, 0.01) << "rim speed [m/s]";
  }
}

TEST(ResolvedRock, RestsInAHeapOfSeven) {
  const double d = 4 * h;
  Bath bath(12, {.size = d}, {.x = {0.05, 0.05, 0.06}});
  for (const Vec3& x : {Vec3(0.14, 0.05, 0.055), Vec3(0.05, 0.15, 0.06), Vec3(0.15, 0.15, 0.07),
                        Vec3(0.09, 0.11, 0.145), Vec3(0.19, 0.09, 0.15), Vec3(0.1, 0.02, 0.16)})
    bath.rocks->add({.x = x, .size = d});
  bath.coupling->make_room();
  const double water = bath.water->total_mass();
  while (bath.t < 0.5) bath.step(Pool::Rocks::falling);
  EXPECT_NEAR(bath.water->total_mass(), water, 1e-12 * water);
  EXPECT_LT((bath.coupling->impulse_on_fluid() + bath.coupling->impulse_on_rocks()).norm(),
            1e-12 * bath.coupling->impulse_on_rocks().norm());
  for (std::size_t r = 0; r < 7; ++r) {
    EXPECT_LT(bath.rocks->rocks().v[r].norm(), 0.3) << r;
    EXPECT_GT(bath.rocks->rocks().x[r].z(), 0.45 * d) << r;
  }
  EXPECT_LT(bath.water->largest_speed(), 1.5);
}

TEST(ResolvedRock, GivesTheWaterWhatItTakes) {
  const NewRock spinning{.x = {0.12, 0.123, 0.17}, .w = {5, 0, 20}};
  Bath bath(12, {.size = 4 * h}, spinning);
  EXPECT_LT(momentum_gap(bath, 0.15), 1e-5);
  EXPECT_LT((bath.coupling->impulse_on_fluid() + bath.coupling->impulse_on_rocks()).norm(),
            1e-12 * bath.coupling->impulse_on_rocks().norm());
  EXPECT_NE(bath.coupling->impulse_on_fluid(), Vec3(Vec3::Zero()));
  EXPECT_NEAR((bath.rocks->impulse_from_fluid() - bath.coupling->impulse_on_rocks()).norm(), 0, 1e-12);
  Bath exact(12, {.size = 4 * h, .precision = Precision::reference}, spinning);
  EXPECT_LT(momentum_gap(exact, 0.05), 1e-11);
}

// Film stress rho f/8 u^2 at u = w R sin(theta), times R sin(theta), over the sphere: 3 pi^2/4 rho f/8 w^2
// R^5.
TEST(ResolvedRock, IsSlowedInItsSpinByTheFilm) {
  const double R = 2 * h, spin = 20;
  const auto torque_with = [&](WallSlip slip) {
    Bath bath(12, {.size = 2 * R, .wall_slip = slip}, {.x = {0.12, 0.123, 0.1241}, .w = {0, 0, spin}});
    double sum = 0;
    while (bath.t < 0.1) {
      bath.step(Pool::Rocks::held);
      sum += bath.coupling->torque()[0].z() * bath.water->limits().step;
    }
    return sum / bath.t;
  };
  const double film = 0.75 * std::pow(std::numbers::pi, 2) * 1000 * 0.025 / 8 * spin * spin * std::pow(R, 5);
  EXPECT_NEAR(torque_with(WallSlip::slip), 0, 0.05 * film);
  EXPECT_NEAR(torque_with(WallSlip::turbulent_film), -film, 0.15 * film);
}

std::uint64_t hash_of(const Pool& pool) {
  return pool.water->state_hash() + pool.rocks->state_hash();
}

void exchange(Pool& pool, MemoryArchive& archive) {
  archive.enter("rocks");
  pool.rocks->exchange(archive);
  archive.leave();
  archive.enter("water");
  pool.water->exchange(archive);
  archive.leave();
  archive.enter("coupling");
  pool.coupling->exchange(archive);
  archive.leave();
}

/// The state after 60 steps, on one thread, on three and again from a state saved after 40.
void moves_alike(const std::function<Bath()>& make) {
  const auto run = [](Pool& pool, int steps) {
    for (int i = 0; i < steps; ++i) pool.step(Pool::Rocks::falling);
  };
  const int usual = thread_count();
  set_thread_count(1);
  Bath one = make();
  run(one, 60);
  set_thread_count(3);
  Bath three = make();
  run(three, 40);
  MemoryArchive saved;
  exchange(three, saved);
  run(three, 20);
  EXPECT_EQ(hash_of(three), hash_of(one));
  Bath again = make();
  saved.rewind_to_load();
  exchange(again, saved);
  again.t = 40 * again.water->limits().step;
  run(again, 20);
  EXPECT_EQ(hash_of(again), hash_of(one));
  set_thread_count(usual);
}

TEST(ResolvedRock, MovesAlikeOnAnyNumberOfThreadsAndAfterARestart) {
  moves_alike([] { return Bath(12, {.size = 4 * h}, {.x = {0.12, 0.123, 0.15}, .w = {5, 0, 20}}); });
}

TEST(ResolvedRock, WithAFilmUnderItMovesAlikeOnAnyNumberOfThreadsAndAfterARestart) {
  CouplingConfig config = partly(4);
  config.lubrication = FilmModel::normal;
  moves_alike([&] {
    return Bath(12, {.size = 4 * h}, {.x = {0.12, 0.123, 2.3 * h}, .v = {0, 0, -0.1}}, config);
  });
  Bath bath(12, {.size = 4 * h}, {.x = {0.12, 0.123, 2.3 * h}, .v = {0, 0, -0.1}}, config);
  bath.step(Pool::Rocks::held);
  EXPECT_LT(bath.coupling->film_loads()[0].impulse.z(), 0) << "the film presses on the floor";
}

TEST(PartlyResolvedRock, MovesAlikeOnAnyNumberOfThreadsAndAfterARestart) {
  moves_alike([] {
    return Bath(12, {.size = 4 * h}, {.x = {0.12, 0.123, 0.15}, .w = {5, 0, 20}}, partly(5));
  });
}

// Cores of 2.1 and 3.1 cells.
TEST(PartlyResolvedRock, LosesTheWeightOfTheWaterItDisplaces) {
  const double d = 4 * h;
  for (const double from : {5.8, 4.7}) {
    Bath bath(12, {.size = d}, {.x = {0.12, 0.123, 0.1241}}, partly(from));
    EXPECT_GT(bath.displaced, 0) << "there is a core";
    EXPECT_LT(bath.displaced, 0.5 * sphere_volume(d)) << "of the core alone";
    const Mean f = lift(bath, sphere_volume(d), 1.5, 1.8);  // waves of the start are over
    EXPECT_NEAR(f.value, 1, 0.02) << from;
    EXPECT_LT(f.rms, 0.05) << from;
  }
}

TEST(PartlyResolvedRock, HalfAsDenseAsWaterFloatsToItsMiddle) {
  const double d = 4 * h, width = 11 * h;
  Bath bath(11, {.size = d, .density = 500}, {.x = {0.11, 0.113, 0.2}}, partly(5));
  double height = 0, speed = 0;
  int count = 0;
  while (bath.t < 1.9) {
    bath.step(Pool::Rocks::falling);
    if (bath.t < 1.5) continue;
    height += bath.rocks->rocks().x[0].z();
    speed = std::max(speed, bath.rocks->rocks().v[0].norm());
    ++count;
  }
  const double water = width * width * width - bath.displaced;
  const double level = (water + 0.5 * sphere_volume(d)) / (width * width);
  EXPECT_NEAR(height / count, level, 0.08 * d);
  EXPECT_LT(speed, 0.1) << "it has come to rest";
}

TEST(PartlyResolvedRock, GivesTheWaterWhatItTakes) {
  Bath bath(12, {.size = 4 * h}, {.x = {0.12, 0.123, 0.17}}, partly(5));
  while (bath.t < 0.15) bath.step(Pool::Rocks::falling);
  EXPECT_LT((bath.coupling->impulse_on_fluid() + bath.coupling->impulse_on_rocks()).norm(),
            1e-12 * bath.coupling->impulse_on_rocks().norm());
  EXPECT_GT(bath.coupling->impulse_on_rocks().z(), 0);
  EXPECT_NEAR((bath.rocks->impulse_from_fluid() - bath.coupling->impulse_on_rocks()).norm(), 0, 1e-12);
}

// Of all that rocks of four cells do, only resolve_from is told.
TEST(PartlyResolvedRock, IsResolvedWholeOrNotAtAllAtTheEndsOfTheBand) {
  const auto displaced = [](CouplingConfig config) {
    return Bath(12, {.size = 4 * h}, {.x = {0.12, 0.123, 0.1241}}, config).displaced;
  };
  EXPECT_EQ(displaced(partly(12)), 0);
  EXPECT_EQ(displaced(partly(12.1)), 0) << "it is below a third of resolve_from";
  EXPECT_NEAR(displaced(partly(4)), sphere_volume(4 * h), 0.1 * sphere_volume(4 * h));
  CouplingConfig abrupt = partly(4.1);
  abrupt.resolve_partly_from = 4.1;
  EXPECT_EQ(displaced(abrupt), 0);
}

}  // namespace
}  // namespace sluice
