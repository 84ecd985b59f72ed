#include "dem/contact_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "dem/linear_contact.h"

namespace sluice {
namespace {

/// Restitution, then zeta, w0 t_c, w0 x largest overlap / speed for either end of contact, and the
/// restitution that comes of the zeta of one with the force of the other.
struct ClosedForm {
  double e, zeta_tension, phase_tension, zeta, phase, overlap_tension, overlap, mismatch;
};

// dem_lsd_closed_form.csv, dem_lsd_mismatch_detector.csv (Schwager & Poeschel 2007; Thornton et al. 2013).
constexpr std::array<ClosedForm, 15> closed_form{{
    {0.98, 0.00643058850237, 3.14165761191, 0.00645713115724, 3.12874352798, 0.989990432491, 0.989949493661,
     0.980081056425},
    {0.95, 0.0163249869167, 3.14201136267, 0.0164982309202, 3.10901784778, 0.974939272406, 0.974679434481,
     0.95050658488},
    {0.9, 0.0335184491057, 3.14335891036, 0.0342652041262, 3.07485445788, 0.949750529727, 0.948683298051,
     0.902026068717},
    {0.8, 0.0708503001954, 3.14950749254, 0.0743550970976, 3.00105251724, 0.898943454981, 0.894427191,
     0.808099335254},
    {0.7, 0.112808450694, 3.16177504208, 0.122214747788, 2.91842801622, 0.847467616495, 0.836660026534,
     0.718201361008},
    {0.6, 0.160493046664, 3.18285205735, 0.180858308364, 2.82445207183, 0.795166973882, 0.774596669241,
     0.632290516353},
    {0.5, 0.215453761966, 3.21715051171, 0.255275637649, 2.71528919463, 0.741810737066, 0.707106781187,
     0.550283169627},
    {0.4, 0.279997993335, 3.27249035238, 0.354507715803, 2.58468487716, 0.68703273588, 0.632455532034,
     0.472013980171},
    {0.3, 0.357857130503, 3.36439517813, 0.497239394699, 2.42131419425, 0.630190844019, 0.547722557505,
     0.397140499885},
    {0.25, 0.403712751943, 3.43386319715, 0.597342252153, 2.32077064049, 0.600635213316, 0.5, 0.360762659476},
    {0.2, 0.455949810769, 3.52985761683, 0.73124692678, 2.20094998487, 0.569967409555, 0.4472135955,
     0.324862847954},
    {0.15, 0.516930866205, 3.66996847918, 0.92459629325, 2.05183602696, 0.537675844687, 0.387298334621,
     0.28909531396},
    {0.1, 0.591155033799, 3.89506129754, 1.24318785101, 1.8521618363, 0.502721970464, 0.316227766017,
     0.252729379588},
    {0.05, 0.69010673056, 4.34096950645, 1.94534618441, 1.5399481581, 0.462276774937, 0.22360679775,
     0.213699816646},
    {0.01, 0.826085054614, 5.57469253349, 4.80694180178, 0.958024951391, 0.415789896479, 0.1, 0.172881238014},
}};

/// Rebound speed of a unit mass on a wall of unit stiffness that arrives with unit speed, and its overlap.
struct Rebound {
  double speed = 0, overlap = 0;
};
Rebound rebound(double zeta, EndOfContact end, double dt) {
  const ContactConstants c = contact_constants({zeta, 0, 0}, 1, 2.0 / 7, 1, end);
  double x = 0, v = 1;  // overlap and its rate
  Vec3 spring = Vec3::Zero();
  Rebound result;
  do {
    x += dt * v;
    if (x <= 0) break;
    result.overlap = std::max(result.overlap, x);
    v -= dt * contact_force(c, Vec3::UnitZ(), x, Vec3(0, 0, v), dt, spring).normal;
  } while (true);
  result.speed = -v;
  return result;
}

/// Touching point's speed over mu v_n after the oblique elastic impact of a sphere; before it, psi.
double oblique(double tangential_ratio, double psi, double dt) {
  constexpr double mu = 0.3;
  const ContactConstants c = contact_constants({0, mu, 0}, 1, tangential_ratio, 1, EndOfContact::no_tension);
  double x = 0;
  Vec3 v(psi * mu, 0, 1), spring = Vec3::Zero();
  do {
    x += dt * v.z();
    if (x <= 0) break;
    const ContactForce f = contact_force(c, Vec3::UnitZ(), x, v, dt, spring);
    v += dt * Vec3(3.5 * f.force.x(), 0, f.force.z());
  } while (true);
  return v.x() / mu;
}

TEST(DampingRatio, IsThatOfTheClosedFormForBothEndsOfContact) {
  for (const ClosedForm& row : closed_form) {
    EXPECT_NEAR(damping_ratio(row.e, EndOfContact::tension), row.zeta_tension, 2e-12);
    EXPECT_NEAR(damping_ratio(row.e, EndOfContact::no_tension), row.zeta, 1e-11) << row.e;
    EXPECT_NEAR(contact_phase(row.zeta_tension, EndOfContact::tension), row.phase_tension, 1e-10);
    EXPECT_NEAR(contact_phase(row.zeta, EndOfContact::no_tension), row.phase, 1e-10);
  }
}

TEST(DampingRatio, ReachesBeyondCriticalDamping) {
  EXPECT_EQ(damping_ratio(1, EndOfContact::no_tension), 0);
  EXPECT_NEAR(damping_ratio(0.135335283236612691, EndOfContact::no_tension), 1, 1e-7);
  EXPECT_GT(damping_ratio(0.05, EndOfContact::no_tension), 1);
  EXPECT_NEAR(contact_phase(1, EndOfContact::no_tension), 2, 1e-12);
  EXPECT_NEAR(contact_phase(1.0001, EndOfContact::no_tension), 2, 1e-3);
}

TEST(NormalForce, GivesTheRestitutionAndTheOverlapOfTheClosedFormInBothConventions) {
  for (const ClosedForm& row : closed_form) {
    const Rebound held = rebound(row.zeta, EndOfContact::no_tension, 2e-5);
    const Rebound pulled = rebound(row.zeta_tension, EndOfContact::tension, 2e-5);
    EXPECT_NEAR(held.speed, row.e, 1e-4);
    EXPECT_NEAR(pulled.speed, row.e, 1e-4);
    EXPECT_NEAR(held.overlap, row.overlap, 1e-4) << row.e;
    EXPECT_NEAR(pulled.overlap, row.overlap_tension, 1e-4) << row.e;
  }
}

TEST(NormalForce, ReboundsTooFastWithTheDampingOfTheOtherConvention) {
  for (const ClosedForm& row : closed_form)
    EXPECT_NEAR(rebound(row.zeta_tension, EndOfContact::no_tension, 2e-5).speed, row.mismatch, 1e-4);
}

TEST(NormalForce, IsZeroAtFirstTouchAndNeverPullsWithoutTension) {
  const ContactConstants c = contact_constants({0.2, 0, 0}, 1e5, 2.0 / 7, 0.01, EndOfContact::no_tension);
  Vec3 spring = Vec3::Zero();
  EXPECT_EQ(contact_force(c, Vec3::UnitZ(), 0, Vec3::Zero(), 1e-5, spring).normal, 0);
  EXPECT_EQ(contact_force(c, Vec3::UnitZ(), 1e-9, Vec3(0, 0, -1), 1e-5, spring).normal, 0);
}

TEST(TangentialForce, FollowsTheExactStickSlipSolutionOfObliqueImpacts) {
  // dem_oblique_lsd_exact.csv: k_t / k_n, then psi_1 -> psi_2' (event-driven exact phases).
  const std::vector<std::pair<double, std::vector<std::array<double, 2>>>> exact{
      {2.0 / 7,
       {{0.1, -0.1},
        {0.25, -0.25},
        {0.75, -0.75},
        {1, -1},
        {1.5, -1.5},
        {2, -2},
        {3, -3},
        {3.5, -3.5},
        {4.5, -2.5},
        {5, -2},
        {6, -1},
        {6.5, -0.5},
        {7.5, 0.5},
        {8, 1},
        {12, 5},
        {20, 13}}},
      {0.5,
       {{0.25, -0.142583123243},
        {0.5, -0.303510670093},
        {1, -0.666578988855},
        {1.25, -0.863429341039},
        {2, -1.49420149172},
        {2.5, -1.96657290839},
        {3.5, -2.49984386884},
        {4, -2.52481918768},
        {5, -2},
        {5.5, -1.5},
        {6.5, -0.5},
        {7, 0},
        {8, 1},
        {10, 3},
        {20, 13}}},
      {0.860465116279,
       {{0.1, 0.0649059058608},
        {0.5, 0.259031600775},
        {0.75, 0.309677446382},
        {1.25, 0.214668250097},
        {1.5, -0.0068305340785},
        {2.5, -0.932766364343},
        {3, -1.27921509015},
        {4, -1.68722468577},
        {4.5, -1.73625103538},
        {5.5, -1.43609076108},
        {6, -1},
        {7, 0},
        {7.5, 0.5},
        {10, 3},
        {12, 5}}},
      {1,
       {{0.1, 0.0910210584308},
        {0.25, 0.223407987391},
        {0.75, 0.578314970343},
        {1, 0.651666461254},
        {1.5, 0.288594072032},
        {2, -0.203591867454},
        {3, -0.999538854736},
        {3.5, -1.2725965675},
        {4.5, -1.54398928473},
        {5, -1.52096969906},
        {6, -1},
        {6.5, -0.5},
        {7.5, 0.5},
        {8, 1},
        {12, 5},
        {20, 13}}},
  };
  for (const auto& [ratio, rows] : exact)
    for (const auto& [psi_1, psi_2] : rows)
      EXPECT_NEAR(oblique(ratio, psi_1, M_PI / 40000), psi_2, 2e-4) << ratio << ' ' << psi_1;
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
