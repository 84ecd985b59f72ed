#include "inflow/pipe_jet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "inflow/emitters.h"

namespace sluice {
namespace {

using std::numbers::pi;
using namespace test;

TEST(PipeJet, GivesItsFlowExactly) {
  FakeFluid fluid(spacing);
  const auto jet = make_pipe_jet(pipe(0.0171), into(fluid));
  feed(*jet, 777, 1.3e-3);
  const InflowBudget b = jet->water();
  EXPECT_NEAR(b.requested, 1000 * 0.0171 * 777 * 1.3e-3, 1e-9);
  EXPECT_EQ(b.entered, fluid.total_mass());
  EXPECT_NEAR(b.requested - b.entered - b.waiting, 0, 1e-12 * b.requested);
  EXPECT_GE(b.waiting, 0);
  EXPECT_LT(b.waiting, 1000 * fluid.point_volume() * 1.000001);
  EXPECT_EQ(jet->rock().requested, 0);
}

TEST(PipeJet, GivesTheSameMassForAnyStep) {
  FakeFluid coarse(spacing), fine(spacing);
  const auto a = make_pipe_jet(pipe(0.0171), into(coarse));
  const auto b = make_pipe_jet(pipe(0.0171), into(fine));
  feed(*a, 10, 0.02);
  feed(*b, 2000, 1e-4);
  EXPECT_NEAR(static_cast<double>(coarse.count()), static_cast<double>(fine.count()), 1);
}

TEST(PipeJet, CarriesItsMomentum) {
  FakeFluid fluid(spacing);
  const PipeJetConfig c = pipe(0.02);
  const auto jet = make_pipe_jet(c, into(fluid));
  feed(*jet, 100, 1e-3);
  EXPECT_NEAR(c.speed(), 0.02 / (pi * 0.045 * 0.045), 1e-12);
  const Vec3 wanted = jet->water().entered * c.speed() * Vec3(0, 0, -1);
  EXPECT_LT((jet->water().momentum - wanted).norm(), 1e-9 * wanted.norm());
  EXPECT_LT((jet->water().momentum - fluid.momentum()).norm(), 1e-9 * wanted.norm());
}

TEST(PipeJet, FillsItsBoreEvenly) {
  FakeFluid fluid(spacing);
  const PipeJetConfig c = pipe(0.02);
  const auto jet = make_pipe_jet(c, into(fluid));
  for (int i = 0; i < 400; ++i) {
    jet->advance(i * 1e-3, 1e-3);
    fluid.drift(1e-3);
  }
  // Mass of a stretch of the jet, away from both ends, by rings as wide as the points lie apart.
  const double from = 0.2, to = 1.0;
  std::vector<double> ring(5);
  double farthest = 0;
  for (const Vec3& x : fluid.points().x) {
    const double r = std::hypot(x.x(), x.y());
    farthest = std::max(farthest, r);
    if (-x.z() > from && -x.z() < to)
      ring[std::min<std::size_t>(4, static_cast<std::size_t>(5 * r / 0.045))] += 1;
  }
  EXPECT_LE(farthest, 0.045);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double area = pi * 0.045 * 0.045 * static_cast<double>(2 * i + 1) / 25;
    const double wanted = area * (to - from) / fluid.point_volume();
    // Whole points in a ring: half a point of each disc, and the ends.
    EXPECT_NEAR(ring[i], wanted, 0.5 * (to - from) / spacing + 0.03 * wanted) << i;
  }
}

TEST(PipeJet, KeepsTheSpacingOfTheFluid) {
  FakeFluid fluid(spacing);
  const auto jet = make_pipe_jet(pipe(0.02), into(fluid));
  for (int i = 0; i < 60; ++i) {
    jet->advance(i * 1e-3, 1e-3);
    fluid.drift(1e-3);
  }
  const auto x = fluid.points().x;
  double nearest = 1;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (x[i] - x[j]).norm());
  EXPECT_GT(nearest, 0.4 * spacing);
}

TEST(JetProfile, FluxRadiusInvertsTheFlux) {
  // Share of the flow inside r by direct integration of (1 - r)^(1/7).
  for (double F : {0.1, 0.5, 0.9}) {
    const double edge = flux_radius(JetProfile::turbulent, F);
    double inside = 0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
      const double r = edge * (i + 0.5) / n;
      inside += profile_speed(JetProfile::turbulent, r) * 2 * r * edge / n;
    }
    EXPECT_NEAR(inside, F, 1e-6);
  }
  EXPECT_DOUBLE_EQ(flux_radius(JetProfile::flat, 0.25), 0.5);
}

TEST(JetProfile, TurbulentPeakIsSixtyFortyNinths) {
  EXPECT_DOUBLE_EQ(profile_speed(JetProfile::turbulent, 0), 60.0 / 49);
  EXPECT_DOUBLE_EQ(profile_speed(JetProfile::turbulent, 1), 0);
}

TEST(PipeJet, TurbulentProfileCarriesMoreMomentumThanTheFlatOne) {
  // Momentum factor of the 1/7 law: 2 * (60/49)^2 * (7/9 - 7/16) = 1.0204.
  FakeFluid fluid(spacing / 2);
  PipeJetConfig c = pipe(0.02);
  c.profile = JetProfile::turbulent;
  const auto jet = make_pipe_jet(c, into(fluid));
  feed(*jet, 300, 1e-3);
  const double factor = jet->water().momentum.norm() / (jet->water().entered * c.speed());
  EXPECT_NEAR(factor, 2 * std::pow(60.0 / 49, 2) * (7.0 / 9 - 7.0 / 16), 0.01);
}

TEST(PipeJet, NeedsAScenesWater) {
  EXPECT_THROW(make_pipe_jet(pipe(0.01), InflowTarget{}), InputError);
}

}  // namespace
}  // namespace sluice
