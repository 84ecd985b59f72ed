#include "coupling/turning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "coupling/coupling.h"
#include "coupling/node_fluid.h"

namespace sluice {
namespace {

using std::numbers::pi;

TEST(Turning, OfASphereIsStokesAndWithoutACentreOfPressure) {
  const Turning law(make_sphere());
  TurningInput in;
  in.size = 0.02;
  in.viscosity = 0.7;
  in.direction = Vec3(0.48, 0.6, 0.64);
  in.spin = Vec3(1e-3, 2e-3, 0);
  const Vec3 rate = law.resistance(in);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(rate[k], 8 * pi * 0.7 * 1e-6, 1e-6 * rate[k]);
  EXPECT_EQ(law.centre_of_pressure(in).norm(), 0.0);
}

// Kim & Karrila (1991), table 3.4: 8 pi mu a^3 times X (about the axis of a prolate spheroid), Y (across).
TEST(Turning, ResistsASlowSpheroidAsInClosedForm) {
  for (const double aspect : {1.2, 2.0, 4.0}) {
    const Turning law(make_superquadric(aspect, 1, 2));
    TurningInput in;
    in.size = 0.01;
    in.viscosity = 0.3;
    const double a = 0.5 * aspect * in.size, e = std::sqrt(1 - 1 / (aspect * aspect));
    const double log = std::log((1 + e) / (1 - e));
    const double x = 4.0 / 3 * e * e * e * (1 - e * e) / (2 * e - (1 - e * e) * log);
    const double y = 4.0 / 3 * e * e * e * (2 - e * e) / (-2 * e + (1 + e * e) * log);
    const Vec3 rate = law.resistance(in);
    EXPECT_NEAR(rate.x(), 8 * pi * in.viscosity * a * a * a * x, 1e-5 * rate.x());
    EXPECT_NEAR(rate.y(), 8 * pi * in.viscosity * a * a * a * y, 1e-5 * rate.y());
    EXPECT_NEAR(rate.z(), rate.y(), 1e-9 * rate.y());
  }
}

// Dennis, Singh & Ingham (1980): (rho / 2) r^5 C w^2 with C = 12.9 / sqrt(Re) + 128.4 / Re.
TEST(Turning, OfAFastSphereIsThatOfItsBoundaryLayer) {
  const Turning law(make_sphere());
  TurningInput in;
  in.size = 0.02;
  in.spin = Vec3(0, 2.0, 0);
  const double re = 1000 * 4e-4 * 2 / 1e-3, c = 12.9 / std::sqrt(re) + 128.4 / re;
  EXPECT_NEAR(law.resistance(in).y() * 2, 500 * 1e-10 * c * 4, 1e-6 * 500 * 1e-10 * c * 4);
}

// A plate of 2p x 2r at spin s: each strip at l from the axis meets rho/2 C (s l)^2.
TEST(Turning, OfAFastPlateIsThatOfItsEdges) {
  const Turning law(make_superquadric(2, 0.05, 2));
  TurningInput in;
  in.size = 0.1;
  in.spin = Vec3(0, 5e3, 0);
  const double p = 0.1, r = 0.05;
  EXPECT_NEAR(law.resistance(in).y() * 5e3, 500 * 1.2 * r * std::pow(p, 4) * 25e6,
              0.02 * 500 * 1.2 * r * std::pow(p, 4) * 25e6);
}

TEST(Turning, PutsTheCentreOfPressureOfARodWhereRosendahlDoes) {
  const Turning law(make_superquadric(3, 1, 2));
  for (const double alpha : {0.0, 0.3, 1.0, 1.5, 2.5}) {
    TurningInput in;
    in.size = 0.02;
    in.direction = Vec3(std::cos(alpha), 0.6 * std::sin(alpha), 0.8 * std::sin(alpha));
    const double x = 0.5 * 0.03 * (1 - std::exp(3.0 * (1 - 3))) * std::pow(std::abs(std::cos(alpha)), 3);
    const Vec3 at = law.centre_of_pressure(in);
    EXPECT_NEAR(at.x(), -std::copysign(x, std::cos(alpha)), 1e-12);
    EXPECT_NEAR(at.y(), 0, 1e-12);
    EXPECT_NEAR(at.z(), 0, 1e-12);
  }
}

TEST(Turning, TurnsADiscTheSameFromEveryDirectionAlongIt) {
  const Turning law(make_superquadric(1, 0.4, 2));
  double first = 0;
  for (int i = 0; i < 8; ++i) {
    TurningInput in;
    in.size = 0.05;
    in.direction = Vec3(0.6 * std::cos(0.7 * i), 0.6 * std::sin(0.7 * i), 0.8);
    const Vec3 at = law.centre_of_pressure(in);
    if (i == 0) first = at.norm();
    EXPECT_NEAR(at.norm(), first, 1e-12);
    EXPECT_GT(first, 1e-3);
    EXPECT_NEAR((at / first + Vec3(std::cos(0.7 * i), std::sin(0.7 * i), 0)).norm(), 0, 1e-12);
  }
}

struct Stream {
  Stream(const RockShape& shape, CouplingTorque torque, double fall) {
    domain.box = {Vec3::Zero(), Vec3::Constant(1.0)};
    fluid = std::make_unique<NodeFluid>(domain.box, 0.05, Vec3::Zero());
    DemScene scene;
    scene.materials.all = {{"rock", 2700}};
    scene.materials.pairs = {PairProperties{}};
    scene.shapes = {shape};
    scene.domain = domain;
    scene.gravity = Vec3(0, 0, -fall);
    scene.smallest_size = scene.largest_size = 0.02;
    scene.densest = 2700;
    CouplingConfig config;
    config.mode = CouplingMode::one_way;
    config.drag = DragModel::hoelzer_sommerfeld;
    config.torque = torque;
    rocks = std::make_unique<DemSystem>(DemConfig{}, scene, walls);
    coupling = std::make_unique<Coupling>(config, domain, scene.gravity, *rocks, *fluid);
  }
  void add(const Vec3& axis, const Vec3& spin) {
    rocks->add(
        {.x = {0.51, 0.48, 0.8}, .w = spin, .q = Quat::FromTwoVectors(Vec3::UnitX(), axis), .size = 0.02});
  }
  void run(double until, double dt = 5e-4) {
    for (; t < until; t += dt) {
      coupling->solids_to_grid();
      coupling->drag(dt);
      coupling->fluid_to_grid(dt);
      rocks->steps(t, dt / 10, 10);
    }
  }
  Vec3 axis(int k) const { return rocks->rocks().q[0] * Vec3(Vec3::Unit(k)); }

  Walls walls;
  Domain domain;
  std::unique_ptr<NodeFluid> fluid;
  std::unique_ptr<DemSystem> rocks;
  std::unique_ptr<Coupling> coupling;
  double t = 0;
};

TEST(TurningRock, ARodThatFallsLengthwiseEndsBroadside) {
  Stream stream(make_superquadric(3, 1, 2), CouplingTorque::centre_of_pressure, 9.81);
  stream.fluid->nodes_.viscosity.assign(stream.fluid->nodes_.count(), 0.05);
  stream.add(Vec3(0.2, 0.1, 1).normalized(), Vec3::Zero());
  stream.run(0.8);
  EXPECT_LT(std::abs(stream.axis(0).z()), 0.35);
  EXPECT_GT(stream.rocks->rocks().x[0].z(), 0.1) << "still in the water";
}

TEST(TurningRock, ADiscThatFallsEdgewiseEndsFlat) {
  Stream stream(make_superquadric(1, 0.3, 2), CouplingTorque::centre_of_pressure, 9.81);
  stream.add(Vec3(0.1, 0.2, 1).normalized(), Vec3::Zero());
  stream.run(0.8);
  EXPECT_GT(std::abs(stream.axis(2).z()), 0.9);
  EXPECT_GT(stream.rocks->rocks().x[0].z(), 0.1) << "still in the water";
}

TEST(TurningRock, KeepsItsDirectionWhereNoTorqueIsAsked) {
  Stream stream(make_superquadric(3, 1, 2), CouplingTorque::none, 9.81);
  const Vec3 axis = Vec3(0.2, 0.1, 1).normalized();
  stream.add(axis, Vec3::Zero());
  stream.run(0.3);
  EXPECT_EQ(stream.coupling->torque()[0].norm(), 0.0);
  EXPECT_NEAR((stream.axis(0) - axis).norm(), 0, 1e-12);
}

TEST(TurningRock, SpinsAsTheWaterDoesInTheEnd) {
  Stream stream(make_superquadric(1.5, 0.7, 2), CouplingTorque::centre_of_pressure, 0);
  const Vec3 turn(0, 0, 6);
  FluidNodes& nodes = stream.fluid->nodes_;
  nodes.viscosity.assign(nodes.count(), 5.0);
  for (std::size_t i = 0; i < nodes.count(); ++i) nodes.v[i] = turn.cross(nodes.x[i] - Vec3(0.51, 0.48, 0.8));
  stream.add(Vec3::UnitX(), Vec3(3, -40, 0));
  stream.run(0.5);
  EXPECT_NEAR((stream.rocks->rocks().w[0] - turn).norm(), 0, 0.02 * turn.norm());
}

// However thick the water is: the resistance is what remains of the spin after the step.
TEST(TurningRock, IsNotOvershotByThickWater) {
  Stream stream(make_sphere(), CouplingTorque::centre_of_pressure, 0);
  stream.fluid->nodes_.viscosity.assign(stream.fluid->nodes_.count(), 1e6);
  stream.add(Vec3::UnitX(), Vec3(0, 0, 100));
  stream.run(4e-4);
  EXPECT_NEAR(stream.rocks->rocks().w[0].norm(), 0, 1);
}

}  // namespace
}  // namespace sluice
