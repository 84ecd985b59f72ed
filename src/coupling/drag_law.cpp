#include "coupling/drag_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

namespace {

using std::numbers::pi;

// Cd Re / 24, which is 1 at rest: Schiller & Naumann (1935).
double schiller_naumann_factor(double re) {
  return re < 1000 ? 1 + 0.15 * std::pow(re, 0.687) : 0.44 * re / 24;
}

// Exponent of the void fraction, Di Felice (1994).
double di_felice_exponent(double re) {
  const double x = re > 0 ? 1.5 - std::log10(re) : 1e3;
  return 3.7 - 0.65 * std::exp(-0.5 * x * x);
}

// Rong et al. (2013) Chem. Eng. Sci. 99:44.
double rong_exponent(double re, double eps) {
  const double x = re > 0 ? 1.5 - std::log10(re) : 1e3;
  return 2.65 * (eps + 1) - (5.3 - 3.5 * eps) * eps * eps * std::exp(-0.5 * x * x);
}

// |u| (0.63 + 4.8/sqrt(Re))^2 written so that it has a limit at rest.
double dallavalle(const DragInput& in, double exponent) {
  const double root = 0.63 * std::sqrt(in.speed) +
                      4.8 * std::sqrt(in.viscosity / (in.density * in.void_fraction * in.diameter));
  return pi / 8 * in.diameter * in.diameter * in.density * root * root *
         std::pow(in.void_fraction, 2 - exponent);
}

double stokes(const DragInput& in) {
  return 3 * pi * in.viscosity * in.diameter;
}

// Cd Re / 24: Haider & Levenspiel (1989) Powder Technol. 58:63.
double haider_levenspiel_factor(double re, double psi) {
  const double a = std::exp(2.3288 - 6.4581 * psi + 2.4486 * psi * psi);
  const double b = 0.0964 + 0.5565 * psi;
  const double c = std::exp(4.905 - 13.8944 * psi + 18.4222 * psi * psi - 10.2599 * psi * psi * psi);
  const double d = std::exp(1.4681 + 12.2584 * psi - 20.7322 * psi * psi + 15.8855 * psi * psi * psi);
  return 1 + a * std::pow(re, b) + c * re * re / (24 * (re + d));
}

// Cd Re / 24: Hoelzer & Sommerfeld (2008) Powder Technol. 184:361.
double hoelzer_sommerfeld_factor(double re, double psi, double crosswise) {
  const double viscous = 8 / std::sqrt(crosswise) + 16 / std::sqrt(psi);
  const double inertial = 0.42 * std::pow(10.0, 0.4 * std::pow(std::max(0.0, -std::log10(psi)), 0.2));
  return (viscous + 3 * std::sqrt(re) / std::pow(psi, 0.75) + inertial * re / crosswise) / 24;
}

// Cd of a lone rock at the flow between the rocks, times Di Felice's function of the void fraction.
double among_others(const DragInput& in, double factor) {
  const double exponent = di_felice_exponent(reynolds_number(in));
  return stokes(in) * factor * std::pow(in.void_fraction, 1 - exponent);
}

double wen_yu(const DragInput& in) {
  // 0.75 Cd rho eps |u| eps^-2.65 / d times the rock's volume, Cd = 24/Re * factor.
  return stokes(in) * schiller_naumann_factor(reynolds_number(in)) * std::pow(in.void_fraction, -2.65);
}

double ergun(const DragInput& in) {
  const double volume = pi / 6 * in.diameter * in.diameter * in.diameter;
  return volume *
         (150 * (1 - in.void_fraction) * in.viscosity / (in.void_fraction * in.diameter * in.diameter) +
          1.75 * in.density * in.speed / in.diameter);
}

double gidaspow(const DragInput& in) {
  const double share = std::clamp((in.void_fraction - 0.75) / 0.1, 0.0, 1.0);
  if (share == 0) return ergun(in);
  if (share == 1) return wen_yu(in);
  return share * wen_yu(in) + (1 - share) * ergun(in);
}

}  // namespace

double reynolds_number(const DragInput& in) {
  return in.density * in.void_fraction * in.speed * in.diameter / in.viscosity;
}

double drag_per_speed(DragModel model, const DragInput& in) {
  switch (model) {
    case DragModel::di_felice:
      return dallavalle(in, di_felice_exponent(reynolds_number(in)));
    case DragModel::rong:
      return dallavalle(in, rong_exponent(reynolds_number(in), in.void_fraction));
    case DragModel::haider_levenspiel:
      return among_others(in, haider_levenspiel_factor(reynolds_number(in), in.sphericity));
    case DragModel::hoelzer_sommerfeld:
      return among_others(in, hoelzer_sommerfeld_factor(reynolds_number(in), in.sphericity, in.crosswise));
    case DragModel::gidaspow:
      return gidaspow(in);
    case DragModel::schiller_naumann:
      break;
  }
  DragInput lone = in;
  lone.void_fraction = 1;
  return stokes(lone) * schiller_naumann_factor(reynolds_number(lone));
}

}  // namespace sluice
