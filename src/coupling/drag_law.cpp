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

double di_felice(const DragInput& in) {
  const double re = reynolds_number(in);
  const double x = re > 0 ? 1.5 - std::log10(re) : 1e3;
  const double chi = 3.7 - 0.65 * std::exp(-0.5 * x * x);
  // |u| (0.63 + 4.8/sqrt(Re))^2 written so that it has a limit at rest.
  const double root = 0.63 * std::sqrt(in.speed) +
                      4.8 * std::sqrt(in.viscosity / (in.density * in.void_fraction * in.diameter));
  return pi / 8 * in.diameter * in.diameter * in.density * root * root * std::pow(in.void_fraction, 2 - chi);
}

double stokes(const DragInput& in) {
  return 3 * pi * in.viscosity * in.diameter;
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
      return di_felice(in);
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
