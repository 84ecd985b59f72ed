#include "coupling/drag_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sluice {
namespace {

using std::numbers::pi;

DragInput lone_sphere(double reynolds) {
  DragInput in;
  in.diameter = 0.01;
  in.speed = reynolds * in.viscosity / (in.density * in.diameter);
  return in;
}

double coefficient(DragModel model, const DragInput& in) {
  return drag_per_speed(model, in) * in.speed /
         (pi / 8 * in.diameter * in.diameter * in.density * in.speed * in.speed);
}

// Schiller & Naumann (1935) by hand: 24/Re (1 + 0.15 Re^0.687).
TEST(SchillerNaumann, MatchesItsFormula) {
  for (double re : {0.1, 1.0, 10.0, 100.0, 900.0})
    EXPECT_NEAR(coefficient(DragModel::schiller_naumann, lone_sphere(re)),
                24 / re * (1 + 0.15 * std::pow(re, 0.687)), 1e-12 * 24 / re * 20);
  EXPECT_NEAR(coefficient(DragModel::schiller_naumann, lone_sphere(5000)), 0.44, 1e-12);
}

TEST(SchillerNaumann, DoesNotKnowOtherRocks) {
  DragInput in = lone_sphere(100);
  const double alone = drag_per_speed(DragModel::schiller_naumann, in);
  in.void_fraction = 0.6;
  EXPECT_DOUBLE_EQ(drag_per_speed(DragModel::schiller_naumann, in), alone);
}

TEST(DiFelice, MatchesItsFormulaForALoneSphere) {
  for (double re : {0.5, 10.0, 300.0, 1e4})
    EXPECT_NEAR(coefficient(DragModel::di_felice, lone_sphere(re)), std::pow(0.63 + 4.8 / std::sqrt(re), 2),
                1e-9 * 100 / re);
}

// Void function eps^(2 - chi), chi by the decimal logarithm: at Re 10^1.5 chi is 3.05.
TEST(DiFelice, UsesTheDecimalLogarithm) {
  DragInput in;
  in.diameter = 0.01;
  in.void_fraction = 0.5;
  in.speed = std::pow(10.0, 1.5) * in.viscosity / (in.density * in.void_fraction * in.diameter);
  const double re = reynolds_number(in);
  const double expected = std::pow(0.63 + 4.8 / std::sqrt(re), 2) * std::pow(0.5, 2 - 3.05);
  EXPECT_NEAR(coefficient(DragModel::di_felice, in), expected, 1e-9 * expected);
}

TEST(DragPerSpeed, HasAPositiveLimitAtRest) {
  for (DragModel model : {DragModel::di_felice, DragModel::schiller_naumann, DragModel::gidaspow})
    for (double eps : {1.0, 0.79, 0.5}) {
      DragInput in;
      in.diameter = 0.02;
      in.void_fraction = eps;
      const double rest = drag_per_speed(model, in);
      in.speed = 1e-12;
      EXPECT_GT(rest, 0);
      EXPECT_NEAR(drag_per_speed(model, in), rest, 1e-3 * rest);
    }
}

TEST(Gidaspow, IsContinuousWhereErgunMeetsWenYu) {
  DragInput in;
  in.diameter = 0.01;
  in.speed = 0.3;
  for (double eps : {0.75, 0.85}) {
    in.void_fraction = eps - 1e-9;
    const double below = drag_per_speed(DragModel::gidaspow, in);
    in.void_fraction = eps + 1e-9;
    EXPECT_NEAR(drag_per_speed(DragModel::gidaspow, in), below, 1e-6 * below);
  }
}

// Ergun (1952): pressure drop per length of a packed bed at superficial speed U; the drag of all rocks
// of a volume is eps dp/dz (model A).
TEST(Gidaspow, GivesErgunsPressureDropInAPackedBed) {
  DragInput in;
  in.diameter = 0.01;
  in.void_fraction = 0.42;
  const double U = 0.05;
  in.speed = U / in.void_fraction;
  const double phi = 1 - in.void_fraction, eps3 = std::pow(in.void_fraction, 3);
  const double drop = 150 * phi * phi * in.viscosity * U / (eps3 * in.diameter * in.diameter) +
                      1.75 * phi * in.density * U * U / (eps3 * in.diameter);
  const double rocks_per_volume = phi / (pi / 6 * std::pow(in.diameter, 3));
  EXPECT_NEAR(rocks_per_volume * drag_per_speed(DragModel::gidaspow, in) * in.speed, in.void_fraction * drop,
              1e-9 * drop);
}

// Rong, Dong & Yu (2013) by hand: at Re 10^1.5 the exponential is 1 and chi(0.5) = 3.975 - 0.8875.
TEST(Rong, MatchesItsFormula) {
  DragInput in;
  in.diameter = 0.01;
  in.void_fraction = 0.5;
  in.speed = std::pow(10, 1.5) * in.viscosity / (in.density * in.void_fraction * in.diameter);
  const double cd = std::pow(0.63 + 4.8 / std::sqrt(std::pow(10, 1.5)), 2);
  EXPECT_NEAR(coefficient(DragModel::rong, in), cd * std::pow(0.5, 2 - 3.0875), 1e-9);
}

// Haider & Levenspiel (1989) by hand for psi 1 (A 0.18622, B 0.6529, C 0.43725, D 7185.3) and psi 0.8
// (A 0.28077, B 0.5416, C 0.78087, D 455.80).
TEST(HaiderLevenspiel, MatchesItsFormula) {
  DragInput in = lone_sphere(100);
  const double sphere = 24.0 / 100 * (1 + 0.18622 * std::pow(100, 0.6529)) + 0.43725 * 100 / (100 + 7185.3);
  EXPECT_NEAR(coefficient(DragModel::haider_levenspiel, in), sphere, 1e-3 * sphere);
  in.sphericity = 0.8;
  const double a = std::exp(2.3288 - 5.16648 + 1.567104), b = 0.5416;
  const double c = std::exp(4.905 - 11.11552 + 11.790208 - 5.2530688);
  const double d = std::exp(1.4681 + 9.80672 - 13.268608 + 8.133376);
  const double blunt = 0.24 * (1 + a * std::pow(100, b)) + c * 100 / (100 + d);
  EXPECT_NEAR(coefficient(DragModel::haider_levenspiel, in), blunt, 1e-9);
}

// Hoelzer & Sommerfeld (2008) by hand: a sphere at Re 100 has 0.24 + 0.3 + 0.42; a body of psi 0.8 across the
// flow (crosswise 0.5) has 0.08/sqrt(0.5) + 0.16/sqrt(0.8) + 0.3/0.8^0.75 + 0.42 10^(0.4 0.09691^0.2) / 0.5.
TEST(HoelzerSommerfeld, MatchesItsFormula) {
  DragInput in = lone_sphere(100);
  EXPECT_NEAR(coefficient(DragModel::hoelzer_sommerfeld, in), 0.96, 1e-12);
  in.sphericity = 0.8;
  in.crosswise = 0.5;
  const double expected = 0.08 / std::sqrt(0.5) + 0.16 / std::sqrt(0.8) + 0.3 / std::pow(0.8, 0.75) +
                          0.84 * std::pow(10, 0.4 * std::pow(-std::log10(0.8), 0.2));
  EXPECT_NEAR(coefficient(DragModel::hoelzer_sommerfeld, in), expected, 1e-12);
}

TEST(DragPerSpeed, OfEveryModelIsContinuousInSpeedAndVoidFraction) {
  for (const auto& [word, model] : drag_models) {
    if (model == DragModel::schiller_naumann) continue;  // its two branches meet at Re 1000 to within 1 %
    for (double re = 1e-3; re < 1e5; re *= 1.01)
      for (double eps : {0.4, 0.6, 0.74, 0.8, 0.86, 1.0}) {
        DragInput in = lone_sphere(re);
        in.void_fraction = eps;
        in.sphericity = 0.8;
        in.crosswise = 0.7;
        const double here = drag_per_speed(model, in);
        in.speed *= 1.01;
        EXPECT_NEAR(drag_per_speed(model, in), here, 0.03 * here) << word << " Re " << re << " eps " << eps;
        in.void_fraction *= 0.999;
        EXPECT_NEAR(drag_per_speed(model, in), here, 0.05 * here) << word << " Re " << re << " eps " << eps;
      }
  }
}

}  // namespace
}  // namespace sluice
