// One rock on a wall: bouncing, sliding, rolling, belts, sheets, corners.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/dem_scenes.h"

namespace sluice {
namespace {

using namespace test;

constexpr double g = 9.81;
constexpr double size = 0.02, radius = 0.01;

/// Depth at which a sphere rests [m].
double sinking(const DemSystem& dem) {
  return dem.rocks().mass[0] * g / (dem.limits().stiffness_per_size * size);
}

TEST(SphereOnWall, BouncesToTheHeightsOfItsRestitution) {
  // dem_bounce_heights.csv: h_n = h_0 e^(2 n).
  const Walls walls = walls_of(plane_wall(1));
  for (const auto& [e, heights] : {std::pair{0.5, std::array{0.1, 0.025, 0.00625}},
                                   std::pair{0.7, std::array{0.196, 0.09604, 0.0470596}},
                                   std::pair{0.9, std::array{0.324, 0.26244, 0.2125764}}}) {
    DemConfig config;
    config.steps_per_contact = 500;
    DemSystem dem(config, scene_of({e, 0.5, 0}, size), walls);
    dem.add({.x = {0.1, 0.05, radius + 0.4}, .size = size});
    const double dt = dem.step_size();
    std::vector<double> apex;
    for (int k = 0; apex.size() < 3; ++k) {
      const double before = dem.rocks().v[0].z();
      dem.step(k * dt, dt);
      if (before > 0 && dem.rocks().v[0].z() <= 0) apex.push_back(dem.rocks().x[0].z() - radius);
    }
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(apex[n], heights[n], 0.016 * heights[n]) << e;
  }
}

TEST(SphereOnWall, ObliqueImpactFollowsTheExactStickSlipSolution) {
  // dem_oblique_lsd_exact.csv: k_t / k_n = 0.860465, psi_1 -> psi_2'; e = 1.
  constexpr double mu = 0.3, normal_speed = 1;
  const Walls walls = walls_of(plane_wall(1));
  for (const auto& [psi_1, psi_2] : {std::array{1.5, -0.0068305340785}, std::array{4.5, -1.73625103538},
                                     std::array{7.5, 0.5}, std::array{0.75, 0.309677446382}}) {
    DemConfig config;
    config.tangential_ratio = 0.860465116279;
    config.steps_per_contact = 2000;
    config.impact_speed = 50;  // the lever arm of the closed form is the whole radius
    DemScene scene = scene_of({1, mu, 0}, size);
    scene.gravity = Vec3::Zero();
    DemSystem dem(config, scene, walls);
    dem.add({.x = {0, 0, radius + 1e-6}, .v = {psi_1 * mu * normal_speed, 0, -normal_speed}, .size = size});
    run(dem, 0.0006);
    EXPECT_EQ(dem.contact_count(), 0u);
    const double surface = dem.rocks().v[0].x() - radius * dem.rocks().w[0].y();
    EXPECT_NEAR(surface / (mu * normal_speed), psi_2, 5e-3) << psi_1;
    EXPECT_NEAR(dem.rocks().v[0].z(), normal_speed, 1e-3);
  }
}

TEST(SphereOnWall, GainsNoEnergyAtGrazingImpact) {
  const Walls walls = walls_of(plane_wall(1));
  for (double psi : {20.0, 100.0}) {
    DemScene scene = scene_of({0.3, 0.3, 0}, size);
    scene.gravity = Vec3::Zero();
    DemSystem dem({}, scene, walls);
    dem.add({.x = {0, 0, radius + 1e-6}, .v = {psi * 0.3 * 0.1, 0, -0.1}, .size = size});
    const double before = dem.energy().kinetic;
    run(dem, 0.01);
    EXPECT_EQ(dem.contact_count(), 0u);
    EXPECT_LT(dem.energy().kinetic, before);
    EXPECT_GT(dem.rocks().v[0].z(), 0);
  }
}

TEST(SphereOnWall, SlidesUntilItRollsAtFiveSeventhsOfItsSpeed) {
  // dem_slide_to_roll.csv, v0 = 1 m/s: friction, then when and where it begins to roll.
  const Walls walls = walls_of(plane_wall(1));
  for (const auto& [mu, when, where] :
       {std::array{0.2, 0.145623998835, 0.12482057043}, std::array{0.5, 0.058249599534, 0.049928228172},
        std::array{1.0, 0.029124799767, 0.024964114086}}) {
    DemSystem dem({}, scene_of({0.5, mu, 0}, size), walls);
    dem.add({.x = {0, 0, radius}, .v = {1, 0, 0}, .size = size});
    run(dem, 0.2);
    EXPECT_NEAR(dem.rocks().v[0].x(), 5.0 / 7, 3e-3) << mu;
    EXPECT_NEAR(dem.rocks().w[0].y() * radius, 5.0 / 7, 3e-3) << mu;
    EXPECT_NEAR(dem.rocks().x[0].x(), where + (0.2 - when) * 5 / 7, 5e-4) << mu;
    EXPECT_NEAR(dem.energy().kinetic / (0.5 * dem.rocks().mass[0]), 1 - 0.285714285714, 5e-3) << mu;
  }
}

TEST(SphereOnWall, RollsOverAnyTriangulationAsOverOneRectangle) {
  const Walls rectangle = walls_of(plane_wall(0.5, 1)), mesh = walls_of(plane_wall(0.5, 40));
  std::array<Vec3, 2> x, w;
  for (std::size_t k = 0; k < 2; ++k) {
    DemSystem dem({}, scene_of({0.5, 0.5, 0}, size), k == 0 ? rectangle : mesh);
    dem.add({.x = {-0.2, -0.15, radius}, .v = {1, 0.7, 0}, .w = {3, 1, 4}, .size = size});
    run(dem, 0.3);
    x[k] = dem.rocks().x[0];
    w[k] = dem.rocks().w[0];
  }
  EXPECT_GT(x[0].x(), 0);
  EXPECT_LT((x[1] - x[0]).norm(), 1e-9);
  EXPECT_LT((w[1] - w[0]).norm(), 1e-7);
}

TEST(SphereOnIncline, RollsAndSlipsAsTheClosedFormSays) {
  // dem_incline.csv: angle [deg], mu, acceleration, R alpha of a sphere.
  struct Case {
    double angle, mu, a, r_alpha;
  };
  for (const Case& c :
       {Case{5, 0.1, 0.610712740253, 0.610712740253}, Case{5, 1, 0.610712740253, 0.610712740253},
        Case{20, 0, 3.35521760602, 0}, Case{20, 0.1, 2.43337914503, 2.30459615248},
        Case{20, 0.2, 2.3965840043, 2.3965840043}, Case{30, 0.1, 4.05542907889, 2.12392730278},
        Case{30, 0.5, 3.50357142857, 3.50357142857}, Case{35, 0.2, 4.01960852971, 4.01794077724},
        Case{45, 0.3, 4.95479823103, 4.95479823103}, Case{60, 0.3, 7.02420921113, 3.67875},
        Case{60, 0.5, 6.06836372223, 6.06836372223}}) {
    const double angle = c.angle * M_PI / 180;
    const Walls walls = walls_of(plane_wall(0.6, 7));
    DemScene scene = scene_of({0.5, c.mu, 0}, size);
    scene.gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle));
    DemSystem dem({}, scene, walls);
    dem.add({.x = {-0.5, 0.01, radius}, .size = size});
    run(dem, 0.2);
    EXPECT_NEAR(dem.rocks().v[0].x() / 0.2, c.a, 0.01 * c.a) << c.angle << ' ' << c.mu;
    EXPECT_NEAR(dem.rocks().w[0].y() * radius / 0.2, c.r_alpha, 0.01 * c.a) << c.angle << ' ' << c.mu;
  }
}

TEST(SphereOnBelt, IsDraggedAtFrictionThenRolls) {
  // A belt at constant speed V: slips at mu g until t = 2 V / (7 mu g), then v = 2 V / 7 (dem_belt.csv's
  // a = 2 A / 7 integrated).
  Wall belt = plane_wall(1);
  belt.surface_velocity = Vec3(1, 0, 0);
  const Walls walls = walls_of(std::move(belt));
  DemSystem dem({}, scene_of({0.5, 0.3, 0}, size), walls);
  dem.add({.x = {0, 0, radius}, .size = size});
  const double overlap = sinking(dem);
  run(dem, 0.05);
  EXPECT_NEAR(dem.rocks().v[0].x(), 0.3 * g * 0.05, 0.01 * 0.3 * g * 0.05);
  run(dem, 0.1);
  EXPECT_NEAR(dem.rocks().v[0].x(), 2.0 / 7, 0.005);
  EXPECT_NEAR(dem.rocks().x[0].z(), radius - overlap, 0.05 * overlap);
  const DemEnergy e = dem.energy();
  EXPECT_NEAR(e.wall_work, e.kinetic + e.dissipated_friction, 0.01 * e.wall_work);
  EXPECT_NEAR(dem.wall_loads()[0].impulse.x(), -dem.momentum().x(), 1e-12);
}

TEST(SphereOnBelt, RollsAtTwoSeventhsOfTheBeltWhateverItsSpeedAndFriction) {
  // dem_belt.csv: belt speed, friction, end of slipping; the sphere is dropped at rest.
  for (const auto& [speed, mu, end] :
       {std::array{0.5, 0.1, 0.145623998835008}, std::array{0.5, 0.6, 0.0242706664725013},
        std::array{2.0, 0.1, 0.582495995340032}, std::array{2.0, 0.3, 0.194165331780011},
        std::array{2.0, 0.6, 0.0970826658900053}}) {
    Wall belt = plane_wall(1);
    belt.surface_velocity = Vec3(speed, 0, 0);
    const Walls walls = walls_of(std::move(belt));
    DemSystem dem({}, scene_of({0.5, mu, 0}, size), walls);
    dem.add({.x = {-0.5, 0, radius}, .size = size});
    run(dem, 0.8 * end);
    EXPECT_NEAR(dem.rocks().v[0].x(), 0.8 * speed * 2 / 7, 0.01 * speed * 2 / 7) << speed << ' ' << mu;
    run(dem, 0.3 * end);
    EXPECT_NEAR(dem.rocks().v[0].x(), speed * 2 / 7, 0.01 * speed * 2 / 7) << speed << ' ' << mu;
  }
}

TEST(SphereOnWall, HasItsWeightCarriedAndTheThirdLawHolds) {
  const Walls walls = walls_of(plane_wall(1, 4));
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, size), walls);
  dem.add({.x = {0.01, 0.02, radius + 0.002}, .v = {0.3, 0, 0}, .size = size});
  run(dem, 0.2);
  const Vec3 balance = dem.momentum() + dem.wall_loads()[0].impulse - dem.impulse_from_gravity();
  const Vec3 start(dem.rocks().mass[0] * 0.3, 0, 0);
  EXPECT_LT((balance - start).norm(), 1e-12 * dem.impulse_from_gravity().norm());
  EXPECT_GT(dem.wall_loads()[0].sliding_energy, 0);
  EXPECT_GT(dem.wall_loads()[0].impact_energy, 0);
}

TEST(RollingResistance, StopsASphereOnTheLevel) {
  const Walls walls = walls_of(plane_wall(1));
  DemSystem dem({}, scene_of({0.3, 0.5, 0.05}, size), walls);
  dem.add({.x = {0, 0, radius}, .v = {0.5, 0, 0}, .w = {0, 50, 0}, .size = size});
  // Deceleration mu_r g 5/7 while rolling: stops after 0.5 / (0.05 g 5/7) = 1.43 s.
  run(dem, 0.5);
  EXPECT_NEAR(dem.rocks().v[0].x(), 0.5 - 0.05 * g * 5 / 7 * 0.5, 0.01);
  run(dem, 1.3);
  EXPECT_LT(dem.rocks().v[0].norm(), 1e-3);
}

TEST(TwoStacked, SwingAsTheMatrixExponentialSays) {
  // dem_two_stacked.csv (Garg et al. 2012): two 1 mm spheres, 20000 and 10000 kg/m3, between walls at 0 and
  // 1.8 mm, all k_n = 1000 N/m, no damping.
  Wall floor = plane_wall(0.01), lid = plane_wall(0.01);
  for (Vec3& v : lid.mesh.vertices) v.z() = 0.0018;
  std::vector<Wall> both;
  both.push_back(std::move(floor));
  both.push_back(std::move(lid));
  const Walls walls(std::move(both));
  DemScene scene = scene_of({1, 0, 0}, 1e-3);
  scene.materials.all = {{"light", 10000}, {"heavy", 20000}};
  scene.densest = 20000;
  DemConfig config;
  config.stiffness_per_size = 1e6;
  config.steps_per_contact = 300;
  DemSystem dem(config, scene, walls);
  dem.add({.x = {0, 0, 0.00045}, .material = 1, .size = 1e-3});
  dem.add({.x = {0, 0, 0.00135}, .material = 0, .size = 1e-3});
  // The file starts from rest with the springs pressed; so must the force of the first half step.
  const int steps = static_cast<int>(std::ceil(0.001 / dem.step_size()));
  dem.step(0, 1e-12);
  for (int k = 0; k < steps; ++k) dem.step(k * 0.001 / steps, 0.001 / steps);
  EXPECT_NEAR(dem.rocks().x[0].z(), 0.0004271279630692, 2e-8);
  EXPECT_NEAR(dem.rocks().x[1].z(), 0.001383553133503, 2e-8);
  EXPECT_NEAR(dem.rocks().v[1].z(), 0.3918523102869, 2e-3);
}

TEST(ThinSheet, HoldsBackAFastRockFromEitherSide) {
  const Walls walls = walls_of(plane_wall(0.3, 6));
  for (double side : {1.0, -1.0})
    for (double along : {0.0, 3.0}) {
      DemScene scene = scene_of({0.2, 0.5, 0}, size);
      scene.gravity = Vec3(0, 0, -g * side);
      DemSystem dem({}, scene, walls);
      dem.add({.x = {-0.1, 0.013, 0.05 * side}, .v = {along, 0, -8 * side}, .size = size});
      const double dt = dem.step_size();
      for (int k = 0; k * dt < 0.05; ++k) {
        dem.step(k * dt, dt);
        ASSERT_GT(dem.rocks().x[0].z() * side, 0.8 * radius);
      }
    }
}

TEST(EndOfSheet, IsRolledOverWithoutAPhantomBeyond) {
  // A sphere let go over the lip pivots on the edge and falls; once its centre is a radius beyond, free.
  const Walls walls = walls_of(plane_wall(0.1));
  DemSystem dem({}, scene_of({0.3, 0.5, 0}, size), walls);
  dem.add({.x = {0.09, 0, radius}, .v = {0.5, 0, 0}, .w = {0, 50, 0}, .size = size});
  double highest = 0;
  const double dt = dem.step_size();
  for (int k = 0; k * dt < 0.2; ++k) {
    dem.step(k * dt, dt);
    highest = std::max(highest, dem.rocks().x[0].z());
    const bool beyond = dem.rocks().x[0].x() > 0.1 + radius;
    EXPECT_FALSE(beyond && dem.contact_count() > 0);
  }
  EXPECT_LT(highest, radius + 1e-5);  // no kick at the lip
  EXPECT_LT(dem.rocks().x[0].z(), -0.02);
}

TEST(Corner, GivesOneContactForEachWall) {
  Wall wall = plane_wall(0.2, 3);
  const Wall upright = plane_wall(0.2, 5, Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY())));
  TriMesh mesh = upright.mesh;
  for (Vec3& v : mesh.vertices) v.x() = 0;
  wall.mesh.append(mesh);
  const Walls walls = walls_of(std::move(wall));
  DemScene scene = scene_of({0.3, 0.5, 0}, size);
  scene.gravity = g * Vec3(-1, 0, -1).normalized();
  DemSystem dem({}, scene, walls);
  dem.add({.x = {radius, 0.017, radius}, .size = size});
  run(dem, 0.05);
  EXPECT_EQ(dem.contact_count(), 2u);
  EXPECT_LT(dem.rocks().v[0].norm(), 2e-3);
}

TEST(ConvexEdge, GivesOneContact) {
  Wall wall;
  wall.material = 1;
  wall.mesh = make_box("box", {Vec3(-0.1, -0.1, -0.1), Vec3(0.1, 0.1, 0)});
  const Walls walls = walls_of(std::move(wall));
  DemScene scene = scene_of({0.3, 0.5, 0}, size);
  scene.gravity = Vec3::Zero();
  DemSystem dem({}, scene, walls);
  const double off = 0.7 * radius;
  dem.add({.x = {0.1 + off, 0.013, off}, .size = size});                                    // edge
  dem.add({.x = {0.1 + 0.57 * radius, 0.1 + 0.57 * radius, 0.57 * radius}, .size = size});  // vertex
  dem.add({.x = {0, 0, 0.99 * radius}, .size = size});  // face, on the diagonal
  dem.step(0, 1e-9);
  EXPECT_EQ(dem.contact_count(), 3u);
}

}  // namespace
}  // namespace sluice
