#include "coupling/lubrication.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace sluice {
namespace {

constexpr double R = 0.02, reach = 0.005, mu = 2;

// Spheres over a floor whose triangles are many, beside a wall, in nothing but the film.
struct Films {
  explicit Films(double gravity = 0, double speed = 0) {
    TriMesh floor;
    const int n = 12;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const double e = 0.31 / n, x = -0.013 + i * e, y = -0.017 + j * e;
        floor.append(make_rectangle(
            "floor", {Vec3(x, y, 0), Vec3(x + e, y, 0), Vec3(x + e, y + e, 0), Vec3(x, y + e, 0)}));
      }
    Wall a, b;
    a.name = "floor";
    a.mesh = floor;
    a.surface_velocity = Vec3(speed, 0, 0);
    b.name = "side";
    b.mesh = make_rectangle("side", {Vec3(0, -1, -1), Vec3(0, 1, -1), Vec3(0, 1, 1), Vec3(0, -1, 1)});
    walls = Walls({a, b});
    DemScene scene;
    scene.materials.all = {{"rock", 2500}};
    scene.materials.pairs = {PairProperties{}};
    scene.shapes = {make_sphere()};
    scene.domain.box = {Vec3::Constant(-1), Vec3::Constant(1)};
    scene.gravity = Vec3(0, 0, -gravity);
    scene.smallest_size = R;
    scene.largest_size = 2 * R;
    scene.densest = 2500;
    rocks = std::make_unique<DemSystem>(DemConfig{}, scene, walls);
    lubrication = std::make_unique<Lubrication>(*rocks, 2, reach, 1e-4);
    liquid.viscosity = mu;
  }
  std::vector<FilmRock> all() const {
    std::vector<FilmRock> list;
    for (std::size_t r = 0; r < rocks->rocks().count(); ++r) list.push_back({r, 1});
    return list;
  }
  std::vector<Vec3> forces(double dt) {
    std::vector<Vec3> force(rocks->rocks().count(), Vec3::Zero());
    lubrication->add(all(), liquid, 0, dt, force);
    return force;
  }
  double mass(std::size_t r) const { return rocks->rocks().mass[r]; }

  Walls walls;
  FluidModel liquid;
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<Lubrication> lubrication;
};

double law(double radius, double gap, double speed) {
  return 6 * std::numbers::pi * mu * radius * radius * (1 / gap - 1 / reach) * speed;
}

TEST(Lubrication, ResistsWhatClosesAndWhatOpensAFilmByItsLaw) {
  for (const double v : {0.1, -0.3})
    for (const double gap : {1e-4, 1e-3, 4e-3}) {
      Films films;
      films.rocks->add({.x = {0.1, 0.1, R + gap}, .v = {0.2, 0, -v}, .size = 2 * R});
      const double f = law(R, gap, v);
      EXPECT_NEAR(films.forces(1e-9)[0].z(), f, 1e-4 * std::abs(f));
      EXPECT_NEAR(films.forces(1e-9)[0].head<2>().norm(), 0, 1e-9 * std::abs(f));
    }
}

TEST(Lubrication, OfTwoRocksIsOppositeAndOfTheirCommonRadius) {
  Films films;
  const Vec3 n = Vec3(0.48, 0.6, 0.64);
  const double gap = 7e-4;
  films.rocks->add({.x = {0.1, 0.1, 0.1}, .v = 0.4 * n, .size = 2 * R});
  films.rocks->add({.x = Vec3(0.1, 0.1, 0.1) + (1.5 * R + gap) * n, .v = 0.1 * n, .size = R});
  const std::vector<Vec3> f = films.forces(1e-9);
  EXPECT_EQ((f[0] + f[1]).norm(), 0.0);
  EXPECT_NEAR((f[0] + law(R / 3, gap, 0.3) * n).norm(), 0, 1e-4 * f[0].norm());
}

TEST(Lubrication, IsNoneBeyondItsReachAndWhereRocksTouch) {
  for (const double gap : {1.001 * reach, -1e-5}) {
    Films films;
    films.rocks->add({.x = {0.1, 0.1, R + gap}, .v = {0, 0, -1}, .size = 2 * R});
    films.rocks->add({.x = {0.1, 0.1, 3 * R + 2 * gap}, .v = {0, 0, -2}, .size = 2 * R});
    for (const Vec3& f : films.forces(1e-9)) EXPECT_EQ(f.norm(), 0.0);
  }
}

TEST(Lubrication, HasOneFilmOnAFloorOfManyTrianglesAndTwoInACorner) {
  Films films;
  films.rocks->add({.x = {R + 5e-4, 0.1, R + 1e-3}, .v = {-0.1, 0.3, -0.2}, .size = 2 * R});
  const Vec3 f = films.forces(1e-9)[0];
  EXPECT_NEAR((f - Vec3(law(R, 5e-4, 0.1), 0, law(R, 1e-3, 0.2))).norm(), 0, 1e-4 * f.norm());
  const std::vector<WallLoad>& loads = films.lubrication->wall_loads();
  EXPECT_NEAR((loads[0].impulse + loads[1].impulse + 1e-9 * f).norm(), 0, 1e-12 * 1e-9 * f.norm());
  EXPECT_NEAR(loads[1].impulse.x(), -1e-9 * f.x(), 1e-9 * 1e-9 * f.norm());
}

TEST(Lubrication, DoesNotFeelABeltThatSlidesPast) {
  Films films(0, 3.0);
  films.rocks->add({.x = {0.1, 0.1, R + 1e-3}, .size = 2 * R});
  EXPECT_EQ(films.forces(1e-9)[0].norm(), 0.0);
}

// However thick the liquid and long the step: what closes is stopped, and what is pushed creeps.
TEST(Lubrication, NeverTurnsASpeedAround) {
  for (const double dt : {1e-5, 1e-3, 1e-1}) {
    Films films;
    films.liquid.viscosity = 1e4;
    Random random(5);
    for (int i = 0; i < 8; ++i)
      films.rocks->add(
          {.x = {0.1 + 2.01 * R * (i & 1), 0.1 + 2.02 * R * (i >> 1 & 1), R + 1e-3 + 2.03 * R * (i >> 2)},
           .v = random.on_sphere(),
           .size = 2 * R});
    const std::vector<Vec3> f = films.forces(dt);
    double before = 0, after = 0;
    for (std::size_t r = 0; r < 8; ++r) {
      const Vec3 v = films.rocks->rocks().v[r];
      before += films.mass(r) * v.squaredNorm();
      after += films.mass(r) * (v + dt / films.mass(r) * f[r]).squaredNorm();
    }
    EXPECT_LT(after, before) << dt;
  }
}

// Without inertia ln(s / s0) - (s - s0) / reach = -W t / (6 pi mu R^2).
TEST(Lubrication, LetsASphereSinkOnToAFloorAsInClosedForm) {
  Films films(9.81);
  const double from = 4e-3, dt = 5e-4;
  films.liquid.viscosity = 40;
  films.rocks->add({.x = {0.1, 0.1, R + from}, .size = 2 * R});
  const double weight = 9.81 * films.mass(0), scale = 6 * std::numbers::pi * 40 * R * R;
  const auto time_of = [&](double s) { return -scale / weight * (std::log(s / from) - (s - from) / reach); };
  double t = 0, least = from;
  while (least > 0.1 * from && t < 5) {
    films.rocks->set_fluid_force(films.forces(dt), std::vector<Vec3>{Vec3::Zero()});
    films.rocks->steps(t, dt / 20, 20);
    t += dt;
    const double gap = films.rocks->rocks().x[0].z() - R;
    ASSERT_LT(gap, least);
    least = gap;
  }
  EXPECT_NEAR(time_of(least), t, 0.02 * t);
}

}  // namespace
}  // namespace sluice
