// A dashpot sampled once a step gives the restitution asked for to the second order in the step.
#include "dem/sampled_dashpot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "dem/hertz_mindlin.h"

namespace sluice {
namespace {

using NormalForce = std::function<double(double overlap, double closing, double dt)>;

/// Rebound speed of a unit mass that arrives with unit speed, `phase` of a step before first touch.
double rebound(const NormalForce& force, double dt, double phase) {
  double x = -phase * dt, v = 1, f = 0;
  bool touched = false;
  while (!touched || x > 0) {
    v -= 0.5 * dt * f;
    x += dt * v;
    f = x > 0 ? force(x, v, dt) : 0;
    touched = touched || x > 0;
    v -= 0.5 * dt * f;
  }
  return -v;
}

double worst_error(const NormalForce& force, double restitution, double dt) {
  double worst = 0;
  for (int k = 0; k < 16; ++k)
    worst = std::max(worst, std::abs(rebound(force, dt, (k + 0.5) / 16) - restitution));
  return worst;
}

TEST(SampledDashpot, GivesTheRestitutionToSecondOrderForALinearSpring) {
  for (const double e : {0.95, 0.8, 0.6, 0.3}) {
    const ContactLaw law{.zeta = damping_ratio(e, EndOfContact::no_tension)};
    const NormalForce force = [&](double x, double closing, double dt) {
      Vec3 spring = Vec3::Zero();
      return contact_force(contact_constants(law, 1, 2.0 / 7, 1, EndOfContact::no_tension), Vec3::UnitZ(), x,
                           Vec3(0, 0, closing), dt, spring)
          .normal;
    };
    const double contact = contact_phase(law.zeta, EndOfContact::no_tension);
    EXPECT_LT(worst_error(force, e, contact / 25), 0.004) << e;
    EXPECT_LT(worst_error(force, e, contact / 100), 0.004 / 12) << e;
  }
}

TEST(SampledDashpot, GivesTheRestitutionToSecondOrderUnderHertz) {
  for (const double e : {0.95, 0.8, 0.6, 0.3}) {
    ContactLaw law{.zeta = damping_ratio(e, EndOfContact::no_tension), .force = ForceLaw::hertz_mindlin};
    law.modulus = 0.75;
    law.shear_ratio = 2.0 / 7;
    const NormalForce force = [&](double x, double closing, double dt) {
      Vec3 spring = Vec3::Zero();
      return hertz_mindlin_force(law, {x, 1, 1}, EndOfContact::no_tension, Vec3::UnitZ(), Vec3(0, 0, closing),
                                 dt, {spring})
          .normal;
    };
    const double contact = hertz_contact_time(law, {1, 1, 1}, 1, EndOfContact::no_tension);
    EXPECT_LT(worst_error(force, e, contact / 25), 0.002) << e;
    EXPECT_LT(worst_error(force, e, contact / 100), 0.002 / 8) << e;
  }
}

TEST(SampledDashpot, WeighsNothingWhereBodiesRestOrPart) {
  EXPECT_EQ(time_in_contact(1e-6, 0.0, 1e-5, true), 1);
  EXPECT_EQ(time_in_contact(1e-9, -1.0, 1e-5, true), 1);
  EXPECT_EQ(time_in_contact(2e-5, 1.0, 1e-5, true), 1);
  EXPECT_DOUBLE_EQ(time_in_contact(2.5e-6, 1.0, 1e-5, true), 0.25);
  EXPECT_DOUBLE_EQ(time_in_contact(2.5e-6, -1.0, 1e-5, false), 0.25);
  EXPECT_EQ(time_in_contact(0.0, 1e-310, 1e-5, true), 0);
}

}  // namespace
}  // namespace sluice
