#include "dem/hertz_mindlin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace sluice {
namespace {

const Material glass{"glass", 2500, 60e9, 0.2}, rubber{"rubber", 1200, 1e7, 0.49},
    rigid{"rigid", 0, 1e30, 0.3};

ContactLaw law_between(const Material& a, const Material& b, const PairProperties& pair,
                       EndOfContact end = EndOfContact::no_tension) {
  Materials materials;
  materials.all = {a, b};
  materials.pairs.assign(4, pair);
  for (PairProperties& p : materials.pairs) p.law = ForceLaw::hertz_mindlin;
  return contact_law(materials, 0, 1, end);
}

/// What comes of a sphere of 10 mm that meets a wall; `surface` is the speed of the touching point.
struct Rebound {
  double speed = 0, surface = 0, time = 0, overlap = 0;
};

Rebound rebound(const ContactLaw& law, EndOfContact end, double speed, double surface, int steps) {
  Indentation at{0, 0.005, 0.0013};
  const double m = at.mass_effective, dt = hertz_contact_time(law, at, speed, end) / steps;
  Rebound result;
  Vec3 v(surface, 0, speed), spring = Vec3::Zero();
  do {
    at.overlap += dt * v.z();
    if (at.overlap <= 0) break;
    const ContactForce f = hertz_mindlin_force(law, at, end, Vec3::UnitZ(), v, dt, {spring});
    v += dt / m * Vec3(3.5 * f.force.x(), 0, f.force.z());
    result.overlap = std::max(result.overlap, at.overlap);
    if (f.normal > 0 || end == EndOfContact::tension) result.time += dt;
  } while (true);
  result.speed = -v.z();
  result.surface = v.x();
  return result;
}

TEST(EffectiveModulus, HalvesForEqualsAndIsThatOfTheSoftOneOnARigidWall) {
  EXPECT_NEAR(effective_modulus(glass, glass), 60e9 / (2 * 0.96), 1e-3);
  EXPECT_NEAR(effective_modulus(rubber, rigid), 1e7 / (1 - 0.49 * 0.49), 1e-3);
  EXPECT_EQ(effective_modulus(glass, rubber), effective_modulus(rubber, glass));
  // Mindlin: k_t / k_n = 2 (1 - nu) / (2 - nu) between equals and on a rigid wall.
  for (const Material& other : {glass, rigid})
    EXPECT_NEAR(law_between(glass, other, {}).shear_ratio, 2 * 0.8 / 1.8, 1e-12);
}

TEST(HertzMindlin, ReboundsWithTheRestitutionAskedForAtAnySpeed) {
  for (EndOfContact end : {EndOfContact::no_tension, EndOfContact::tension})
    for (double e : {1.0, 0.9, 0.6, 0.3, 0.1})
      for (double speed : {0.05, 0.5, 5.0}) {
        const ContactLaw law = law_between(glass, glass, {e, 0, 0}, end);
        EXPECT_NEAR(rebound(law, end, speed, 0, 20000).speed / speed, e, 1e-3) << e << ' ' << speed;
      }
}

TEST(HertzMindlin, LastsAndIndentsAsTheClosedFormsSay) {
  const Indentation at{0, 0.005, 0.0013};
  const ContactLaw elastic = law_between(glass, glass, {1, 0, 0});
  // Johnson (1985) eq. 11.24: 2.87 (m^2 / (R E^2 v))^(1/5); the factor is 2.868265...
  const double e2 = elastic.modulus * elastic.modulus;
  EXPECT_NEAR(hertz_contact_time(elastic, at, 2, EndOfContact::tension) /
                  std::pow(0.0013 * 0.0013 / (0.005 * e2 * 2), 0.2),
              2.8682655, 1e-6);
  for (double e : {1.0, 0.7, 0.3, 0.1}) {
    const ContactLaw law = law_between(glass, glass, {e, 0, 0});
    const Rebound r = rebound(law, EndOfContact::no_tension, 2, 0, 20000);
    EXPECT_NEAR(r.time / hertz_contact_time(law, at, 2, EndOfContact::no_tension), 1, 2e-3) << e;
  }
  EXPECT_NEAR(rebound(elastic, EndOfContact::no_tension, 2, 0, 20000).overlap /
                  hertz_impact_overlap(elastic.modulus, 0.005, 0.0013, 2, 0),
              1, 1e-6);
}

TEST(HertzImpactOverlap, IsWhereTheWorkOfThePullAndTheMotionAreUsedUp) {
  for (double pull : {0.0, 0.1, 10.0})
    for (double speed : {0.0, 0.01, 3.0}) {
      const double x = hertz_impact_overlap(1e9, 0.004, 0.002, speed, pull);
      const double held = 8.0 / 15 * 1e9 * std::sqrt(0.004) * std::pow(x, 2.5);
      EXPECT_NEAR(held, 0.5 * 0.002 * speed * speed + pull * x, 1e-12 * held + 1e-300);
    }
}

TEST(HertzMindlin, HasNoForceAtFirstTouchAndThePowerLawBeyond) {
  const ContactLaw law = law_between(glass, glass, {1, 0.5, 0});
  Vec3 spring = Vec3::Zero();
  const auto normal = [&](double overlap) {
    return hertz_mindlin_force(law, {overlap, 0.005, 0.001}, EndOfContact::no_tension, Vec3::UnitZ(),
                               Vec3::Zero(), 1e-7, {spring})
        .normal;
  };
  EXPECT_EQ(normal(0), 0);
  EXPECT_NEAR(normal(1e-5), 4.0 / 3 * law.modulus * std::sqrt(0.005) * std::pow(1e-5, 1.5), 1e-9);
  const double slope = (normal(1.0001e-5) - normal(0.9999e-5)) / 2e-9;
  EXPECT_NEAR(slope / tangent_stiffness(law, {1e-5, 0.005, 0.001}), 1, 1e-8);
}

TEST(HertzMindlin, KeepsTheForceOfTheSpringWhileLoadingAndItsStretchWhileUnloading) {
  const ContactLaw law = law_between(glass, glass, {1, 10, 0});
  Vec3 spring = Vec3::Zero();
  const double dt = 1e-7;
  const auto step = [&](double overlap, const Vec3& velocity) {
    return hertz_mindlin_force(law, {overlap, 0.005, 0.001}, EndOfContact::no_tension, Vec3::UnitZ(),
                               velocity, dt, {spring});
  };
  const double sheared = step(1e-5, Vec3(1, 0, 0)).force.x();
  EXPECT_NEAR(sheared, -law.shear_ratio * tangent_stiffness(law, {1e-5, 0.005, 0.001}) * dt, 1e-9);
  EXPECT_NEAR(step(4e-5, Vec3(0, 0, 3e-5 / dt)).force.x(), sheared, 1e-9);
  EXPECT_NEAR(step(1e-5, Vec3(0, 0, -3e-5 / dt)).force.x(), 0.5 * sheared, 1e-9);
}

TEST(HertzMindlin, NeverMakesEnergyOverAnyPathOfLoadingAndShear) {
  // Springs alone: what the step takes from the motion it holds or loses, and it loses no less than nothing.
  const ContactLaw law = law_between(glass, glass, {1, 0.4, 0});
  Random random(17);
  for (int path = 0; path < 200; ++path) {
    Vec3 spring = Vec3::Zero(), velocity = Vec3::Zero();
    double overlap = 0, held = 0, worked = 0, lost = 0;
    const double dt = 1e-7;
    for (int k = 0; k < 400; ++k) {
      if (k % 20 == 0) velocity = random.uniform(0, 5) * random.on_sphere();
      if (overlap + velocity.z() * dt < 0 || overlap > 5e-5) velocity.z() *= -1;
      overlap = std::max(0.0, overlap + velocity.z() * dt);
      const ContactForce f = hertz_mindlin_force(law, {overlap, 0.005, 0.001}, EndOfContact::no_tension,
                                                 Vec3::UnitZ(), velocity, dt, {spring});
      const Vec3 across(velocity.x(), velocity.y(), 0);
      const double spring_held = 0.5 * spring_stiffness(law, 0, 0.005) * spring.squaredNorm();
      worked -= f.force.dot(across) * dt;
      lost += f.lost_friction;
      held = spring_held;
      ASSERT_GE(f.lost_friction, -1e-12 * (held + worked));
      ASSERT_NEAR(worked, held + lost, 1e-9 * worked + 1e-18);
    }
    EXPECT_GT(worked, 0);
  }
}

TEST(HertzMindlin, GainsNoEnergyAtGrazingImpact) {
  for (double e : {1.0, 0.3})
    for (double psi : {0.5, 2.0, 4.0, 6.0, 20.0, 100.0}) {
      const ContactLaw law = law_between(glass, glass, {e, 0.3, 0});
      const double speed = 0.1, surface = psi * 0.3 * speed;
      const Rebound r = rebound(law, EndOfContact::no_tension, speed, surface, 300);
      const auto energy = [](double v, double s) { return v * v + s * s / 3.5; };
      EXPECT_LE(energy(r.speed, r.surface), energy(speed, surface) * (1 + 1e-5)) << e << ' ' << psi;
      if (psi > 7) {
        EXPECT_NEAR(r.surface / surface, 1 - 3.5 * (1 + e) / psi, 2e-3);
      }
    }
}

}  // namespace
}  // namespace sluice
