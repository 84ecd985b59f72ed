#include "analysis/wear.h"

#include <cmath>

namespace sluice {

double archard_volume(double coefficient, double force, double distance, double hardness) {
  return coefficient * force * distance / hardness;
}

double archard_volume_from_work(double coefficient, double work, double friction, double hardness) {
  return coefficient * work / (friction * hardness);
}

double shear_impact_volume(double work, double flow_pressure) {
  return work / flow_pressure;
}

double finnie_angle_function(double angle, double K) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  return std::tan(angle) <= K / 6 && angle < 1.5 ? std::sin(2 * angle) - 6 / K * sine * sine
                                                 : K * cosine * cosine / 6;
}

WearIntensity wear_intensity(const WallLoad& load, double area, double seconds) {
  if (!(area > 0) || !(seconds > 0)) return {};
  const double scale = 1 / (area * seconds);
  return {load.sliding_energy * scale, load.impact_energy * scale, load.impulse.norm() * scale};
}

}  // namespace sluice
