#pragma once
/// Angle of repose of balls with rolling resistance.
///
/// A heap leans against a wall, too steep to stay; what is too much falls over the free end of its floor,
/// and the slope that is left is measured. Periodic across: nothing holds the heap from the sides.
/// Reference: columns `friction`, `rolling` (torque over effective radius and normal force), `angle` [deg].

#include "validation/measure.h"

namespace sluice {

struct RockRepose : Measure {
  double base = 20;        ///< length of the floor over the balls' diameter
  double size = 0.01;      ///< [m]
  double width = 8;        ///< of the heap over the balls' diameter
  double steepness = 50;   ///< of the slope at the start [deg]
  double falls = 6;        ///< how long it runs, in times to fall the length of the floor
  std::int64_t heaps = 2;  ///< of which the mean is taken

  void keys(Schema& s) override;
  Measured run(const CsvTable& reference) const override;

 private:
  double heap_angle(double friction, double rolling, std::int64_t seed, double& rock_steps) const;  ///< [deg]
};

}  // namespace sluice
