#include "dem/rigid_motion.h"

#include <gtest/gtest.h>

namespace sluice {
namespace {

struct Free {
  Vec3 inertia, w_start;
  double seconds;
  Vec3 w_body;
  Quat q;
};

// reference-data/derived/dem_free_rotation.csv (Euler's equations, 40 digits).
const Free general{{1e-4, 2e-4, 2.6e-4},
                   {5, -3, 8},
                   2,
                   {-4.3874245172435, -4.0825655504826, 7.7661945724728},
                   {-0.87858092530752, 0.051621683030925, -0.32182766418532, 0.34908124282445}};
const Free flip{{1e-4, 2e-4, 2.6e-4},
                {0.1, 10, 0.1},
                2,
                {-1.6036547141175, -9.827735687525, 1.2853485115817},
                {-0.084797429665567, 0.98681907692947, -0.052305692661039, -0.12752105647866}};
const Free symmetric{{1e-4, 1e-4, 1.6e-4},
                     {3, 0, 10},
                     2,
                     {2.5315618761975, -1.6097187540013, 10},
                     {-0.65952662012554, -0.095614698052402, 0.027824469120632, -0.74505588097825}};

/// Distance of the two orientations [rad], and of the angular velocities over their size.
double error_of(const Free& c, double dt) {
  Quat q = Quat::Identity();
  const Vec3 l = c.w_start.cwiseProduct(c.inertia);
  const int steps = static_cast<int>(std::lround(c.seconds / dt));
  for (int k = 0; k < steps; ++k) rotate_freely(q, l, c.inertia.cwiseInverse(), dt);
  const Vec3 w = q.conjugate() * angular_velocity(q, l, c.inertia.cwiseInverse());
  return q.angularDistance(c.q) + (w - c.w_body).norm() / c.w_body.norm();
}

TEST(FreeRotation, FollowsEulersEquations) {
  EXPECT_LT(error_of(general, 1e-4), 2e-5);
  EXPECT_LT(error_of(symmetric, 1e-4), 2e-5);
  EXPECT_LT(error_of(flip, 2e-5), 2e-4);  // unstable axis: errors grow e-fold every 0.2 s
}

TEST(FreeRotation, IsOfSecondOrder) {
  const double ratio = error_of(general, 1e-3) / error_of(general, 5e-4);
  EXPECT_NEAR(ratio, 4, 0.1);
}

TEST(FreeRotation, KeepsEnergyBoundedOverManyTurns) {
  Quat q = Quat::Identity();
  const Vec3 inertia = flip.inertia, l = flip.w_start.cwiseProduct(inertia);
  const auto energy = [&] { return 0.5 * l.dot(angular_velocity(q, l, inertia.cwiseInverse())); };
  const double before = energy();
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    rotate_freely(q, l, inertia.cwiseInverse(), 1e-3);
    worst = std::max(worst, std::abs(energy() / before - 1));
  }
  EXPECT_LT(worst, 2e-4);
}

TEST(FreeRotation, ReturnsThroughItselfWhenTimeTurnsBack) {
  Quat q = Quat::Identity();
  const Vec3 l = general.w_start.cwiseProduct(general.inertia);
  for (int k = 0; k < 1000; ++k) rotate_freely(q, l, general.inertia.cwiseInverse(), 1e-3);
  for (int k = 0; k < 1000; ++k) rotate_freely(q, l, general.inertia.cwiseInverse(), -1e-3);
  EXPECT_LT(q.angularDistance(Quat::Identity()), 1e-7);
}

}  // namespace
}  // namespace sluice
