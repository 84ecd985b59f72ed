#include "dem/partial_slip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "dem/hertz_mindlin.h"

namespace sluice {
namespace {

const Material glass{"glass", 2500, 60e9, 0.2};
constexpr double radius = 0.005;

ContactLaw partial_slip_law(double friction, double restitution = 1) {
  Materials materials;
  materials.all = {glass};
  materials.pairs = {{restitution, friction, 0, ForceLaw::hertz_mindlin, Tangential::partial_slip}};
  return contact_law(materials, 0, 0, EndOfContact::no_tension);
}

/// A contact under the hand of the test.
struct Held {
  ContactLaw law;
  double overlap = 0;
  Vec3 spring = Vec3::Zero();
  std::array<Vec3, shear_rings> rings = no_stretch();
  double lost = 0;

  ContactForce step(double closer, const Vec3& across, const Vec3& n = Vec3::UnitZ()) {
    constexpr double dt = 1e-3;  // the dashpot sees next to nothing
    overlap += closer;
    const ContactForce f = hertz_mindlin_force(law, {overlap, radius, 1e-20}, EndOfContact::no_tension, n,
                                               (closer * n + across) / dt, dt, {spring, rings});
    lost += f.lost_friction;
    return f;
  }
  double push() const { return 4.0 / 3 * law.modulus * std::sqrt(radius * overlap) * overlap; }
  double stiffness() const { return law.shear_ratio * 2 * law.modulus * std::sqrt(radius * overlap); }
  double held() const { return 0.5 * spring_stiffness(law, 0, radius) * spring.squaredNorm(); }
};

TEST(PartialSlip, PullsAsCattaneoAndMindlinSay) {
  // T = mu N (1 - (1 - s / s_most)^1.5), s_most = 3 mu N / (2 k_t): 2 k_t / 3 of it is Mindlin's stiffness.
  Held contact{partial_slip_law(0.4)};
  contact.step(1e-5, Vec3::Zero());
  const double most = 0.4 * contact.push(), far = 1.5 * most / contact.stiffness();
  double pulled = 0;
  for (int k = 1; k <= 120; ++k) {
    const Vec3 force = contact.step(0, Vec3(far / 100, 0, 0)).force;
    const double share = std::min(1.0, k / 100.0);
    EXPECT_NEAR(-force.x() / most, 1 - std::pow(1 - share, 1.5), 0.006) << k;
    if (k == 1) {
      EXPECT_NEAR(-force.x() / (contact.stiffness() * far / 100), 1, 1e-12);
    }
    pulled = -force.x();
  }
  EXPECT_NEAR(pulled, most, 1e-9 * most);  // slides: every ring gives its share, together all of friction
}

TEST(PartialSlip, LosesWhatMindlinAndDeresiewiczSayToAndFro) {
  // Back from T* at s*: T = T* - 2 mu N (1 - (1 - (s* - s) / (2 s_most))^1.5), and likewise to the right.
  Held contact{partial_slip_law(0.4)};
  contact.step(1e-5, Vec3::Zero());
  const double most = 0.4 * contact.push(), far = 1.5 * most / contact.stiffness();
  const double reach = 0.6 * far, top = most * (1 - std::pow(0.4, 1.5));
  const int steps = 2000;
  const auto swing = [&](double sense) {
    for (int k = 1; k <= 2 * steps; ++k) {
      const double back = k * reach / steps;
      const double pull = -contact.step(0, Vec3(sense * reach / steps, 0, 0)).force.x() * sense;
      EXPECT_NEAR(pull / most, (-top + 2 * most * (1 - std::pow(1 - back / (2 * far), 1.5))) / most, 0.011)
          << k;
    }
  };
  for (int k = 0; k < steps; ++k) contact.step(0, Vec3(reach / steps, 0, 0));
  swing(-1);
  swing(1);
  const double lost = contact.lost;
  swing(-1);
  swing(1);
  // the area between the two branches
  double loop = 0;
  for (int k = 0; k < 20000; ++k) {
    const double s = reach * (-1 + (k + 0.5) / 10000);
    const double going = -top + 2 * most * (1 - std::pow(1 - (s + reach) / (2 * far), 1.5));
    const double coming = top - 2 * most * (1 - std::pow(1 - (reach - s) / (2 * far), 1.5));
    loop += (going - coming) * reach / 10000;
  }
  EXPECT_NEAR((contact.lost - lost) / loop, 1, 0.07);
}

TEST(PartialSlip, KeepsItsPullAsTheContactGrowsAndGivesUpTheRimAsItShrinks) {
  Held contact{partial_slip_law(100)};  // no ring gives way
  contact.step(1e-5, Vec3::Zero());
  const double sheared = contact.step(0, Vec3(1e-8, 0, 0)).force.x();
  for (int k = 0; k < 1000; ++k) contact.step(3e-8, Vec3::Zero());
  EXPECT_NEAR(contact.step(0, Vec3::Zero()).force.x() / sheared, 1, 0.03);
  // Half of the width of the first contact: half of its force.
  for (int k = 0; k < 1000; ++k) contact.step(-3.75e-8, Vec3::Zero());
  EXPECT_NEAR(contact.step(0, Vec3::Zero()).force.x() / sheared, 0.5, 0.03);
}

TEST(PartialSlip, NeverMakesEnergyOverAnyPathOfLoadingTurningAndShear) {
  Random random(23);
  for (int path = 0; path < 300; ++path) {
    Held contact{partial_slip_law(random.uniform(0, 1), random.uniform(0.1, 1))};
    Vec3 move = Vec3::Zero(), n = Vec3::UnitZ();
    double worked = 0;
    for (int k = 0; k < 400; ++k) {
      if (k % 20 == 0) move = random.uniform(0, 5e-7) * random.on_sphere();
      n = (n + 0.01 * random.on_sphere()).normalized();
      double closer = move.dot(n);
      if (contact.overlap + closer < 0 || contact.overlap > 5e-5) closer = -closer;
      closer = std::max(closer, -contact.overlap);
      const Vec3 across = move - move.dot(n) * n;
      const double before = contact.lost;
      worked -= contact.step(closer, across, n).force.dot(across);
      ASSERT_GE(contact.lost - before, -1e-12 * (contact.held() + worked));
      ASSERT_NEAR(worked, contact.held() + contact.lost, 1e-9 * worked + 1e-20);
      double of_rings = 0;
      for (const Vec3& stretch : contact.rings)
        of_rings += 0.5 * contact.stiffness() / shear_rings * stretch.squaredNorm();
      ASSERT_NEAR(of_rings, contact.held(), 1e-9 * of_rings + 1e-24);
    }
    EXPECT_GT(worked, 0);
  }
}

TEST(WholeStretch, PullsAsStiffnessTimesStretchAndOwnsUpToTheEnergyItMakes) {
  PairProperties pair{1, 100, 0, ForceLaw::hertz_mindlin, Tangential::whole_stretch};
  Materials materials;
  materials.all = {glass};
  materials.pairs = {pair};
  Held contact{contact_law(materials, 0, 0, EndOfContact::no_tension)};
  contact.step(1e-5, Vec3::Zero());
  const double sheared = contact.step(0, Vec3(1e-8, 0, 0)).force.x(), held = contact.held();
  contact.lost = 0;
  EXPECT_NEAR(sheared / -(contact.stiffness() * 1e-8), 1, 1e-9);
  EXPECT_NEAR(contact.step(3e-5, Vec3::Zero()).force.x() / sheared, 2, 1e-9);
  EXPECT_NEAR(contact.held() / held, 2, 1e-9);
  EXPECT_NEAR(contact.lost, -held, 1e-9 * held);
  EXPECT_NEAR(contact.step(-3e-5, Vec3::Zero()).force.x() / sheared, 1, 1e-9);
  EXPECT_NEAR(contact.lost, 0, 1e-9 * held);
}

}  // namespace
}  // namespace sluice
