#include "dem/contact_law.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "dem/linear_contact.h"

namespace sluice {
namespace {

// reference-data/derived/dem_lsd_closed_form.csv (Schwager & Poeschel 2007; Thornton et al. 2013):
// e, zeta and w0 t_c with tension, the same without.
constexpr std::array<std::array<double, 5>, 5> closed_form{{
    {0.9, 0.0335184491057, 3.14335891036, 0.0342652041262, 3.07485445788},
    {0.7, 0.112808450694, 3.16177504208, 0.122214747788, 2.91842801622},
    {0.5, 0.215453761966, 3.21715051171, 0.255275637649, 2.71528919463},
    {0.3, 0.357857130503, 3.36439517813, 0.497239394699, 2.42131419425},
    {0.2, 0.455949810769, 3.52985761683, 0.73124692678, 2.20094998487},
}};

/// Rebound speed of a unit mass on a wall of unit stiffness that arrives with unit speed.
double rebound(double zeta, EndOfContact end, double dt) {
  const ContactConstants c = contact_constants({zeta, 0, 0}, 1, 2.0 / 7, 1, end);
  double x = 0, v = 1;  // overlap and its rate
  Vec3 spring = Vec3::Zero();
  do {
    x += dt * v;
    if (x <= 0) break;
    v -= dt * contact_force(c, Vec3::UnitZ(), x, Vec3(0, 0, v), dt, spring).normal;
  } while (true);
  return -v;
}

TEST(DampingRatio, IsThatOfTheClosedFormForBothEndsOfContact) {
  for (const auto& [e, zeta_a, phase_a, zeta_b, phase_b] : closed_form) {
    EXPECT_NEAR(damping_ratio(e, EndOfContact::tension), zeta_a, 2e-12);
    EXPECT_NEAR(damping_ratio(e, EndOfContact::no_tension), zeta_b, 2e-12);
    EXPECT_NEAR(contact_phase(zeta_a, EndOfContact::tension), phase_a, 1e-10);
    EXPECT_NEAR(contact_phase(zeta_b, EndOfContact::no_tension), phase_b, 1e-10);
  }
}

TEST(DampingRatio, ReachesBeyondCriticalDamping) {
  EXPECT_EQ(damping_ratio(1, EndOfContact::no_tension), 0);
  EXPECT_NEAR(damping_ratio(0.135335283236612691, EndOfContact::no_tension), 1, 1e-7);
  EXPECT_GT(damping_ratio(0.05, EndOfContact::no_tension), 1);
  EXPECT_NEAR(contact_phase(1, EndOfContact::no_tension), 2, 1e-12);
  EXPECT_NEAR(contact_phase(1.0001, EndOfContact::no_tension), 2, 1e-3);
}

TEST(NormalForce, GivesTheRestitutionAskedForInBothConventions) {
  for (const auto& row : closed_form)
    for (EndOfContact end : {EndOfContact::tension, EndOfContact::no_tension})
      EXPECT_NEAR(rebound(damping_ratio(row[0], end), end, 2e-5), row[0], 1e-4);
}

TEST(NormalForce, ReboundsTooFastWithTheDampingOfTheOtherConvention) {
  // dem_lsd_mismatch_detector.csv: zeta with tension, force cut off at zero, e = 0.5 comes out 0.5503.
  EXPECT_NEAR(rebound(damping_ratio(0.5, EndOfContact::tension), EndOfContact::no_tension, 2e-5),
              0.550283169627, 1e-4);
}

TEST(NormalForce, IsZeroAtFirstTouchAndNeverPullsWithoutTension) {
  const ContactConstants c = contact_constants({0.2, 0, 0}, 1e5, 2.0 / 7, 0.01, EndOfContact::no_tension);
  Vec3 spring = Vec3::Zero();
  EXPECT_EQ(contact_force(c, Vec3::UnitZ(), 0, Vec3::Zero(), 1e-5, spring).normal, 0);
  EXPECT_EQ(contact_force(c, Vec3::UnitZ(), 1e-9, Vec3(0, 0, -1), 1e-5, spring).normal, 0);
}

TEST(TangentialForce, SpringAndDashpotTogetherEqualCoulombsLimitWhenSliding) {
  const ContactConstants c = contact_constants({0.3, 0.4, 0}, 1e5, 2.0 / 7, 0.01, EndOfContact::no_tension);
  Vec3 spring = Vec3::Zero();
  const Vec3 sliding(3, 0, 0);
  for (int k = 0; k < 100; ++k) {
    const ContactForce f = contact_force(c, Vec3::UnitZ(), 1e-4, sliding, 1e-5, spring);
    EXPECT_NEAR(f.force.x(), -0.4 * f.normal, 1e-12 * f.normal);
    EXPECT_NEAR((c.k_t * spring + c.c_t * sliding).norm(), 0.4 * f.normal, 1e-12 * f.normal);
  }
}

TEST(TangentialForce, SpringTurnsWithTheContactAndKeepsItsLength) {
  Vec3 spring(1e-4, 2e-4, 0);
  const double length = spring.norm();
  const Vec3 n = Vec3(0.1, -0.2, 1).normalized();
  const lanes::Triple<double> turned =
      turned_into_plane<double>({spring.x(), spring.y(), spring.z()}, {n.x(), n.y(), n.z()});
  spring = {turned.x, turned.y, turned.z};
  EXPECT_NEAR(spring.dot(n), 0, 1e-19);
  EXPECT_NEAR(spring.norm(), length, 4 * std::numeric_limits<double>::epsilon() * length);
}

TEST(RollingTorque, OpposesRollingAndStopsAtItsLimit) {
  const RollingConstants c = rolling_constants(0.1, 0.01, 1e6, 1e-6, 5);
  EXPECT_DOUBLE_EQ(c.limit, 0.1 * 0.01 * 5);
  Vec3 turned = Vec3::Zero();
  Vec3 torque;
  for (int k = 0; k < 2000; ++k) torque = rolling_torque(c, Vec3(0, 4, 3), 1e-4, turned);
  EXPECT_LT((torque - -c.limit * Vec3(0, 0.8, 0.6)).norm(), 1e-12);
}

}  // namespace
}  // namespace sluice
