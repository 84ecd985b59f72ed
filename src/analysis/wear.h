#pragma once
/// Wear of walls from what they received. Relative figures unless the material's own constants are given.

#include "base/load.h"

namespace sluice {

/// Archard (1953): volume worn off [m3] = k F L / H.
/// @param coefficient  k;  @param force  normal [N];  @param distance  slid [m];  @param hardness  [Pa]
double archard_volume(double coefficient, double force, double distance, double hardness);

/// The same from friction work E = mu F L [J], which is what a wall's load holds. @pre friction > 0
double archard_volume_from_work(double coefficient, double work, double friction, double hardness);

/// Shear impact energy model (Zhao et al. 2017): volume [m3] = E_s / p.
/// @param work  friction work [J];  @param flow_pressure  of the wall's material [Pa]
double shear_impact_volume(double work, double flow_pressure);

/// Finnie (1960): angle function f of erosion by grains that strike at `angle` [rad] from the surface.
/// @param K  ratio of normal to tangential force; 2 by Finnie
double finnie_angle_function(double angle, double K = 2);

/// Mean intensity over a part: energies per area and time.
struct WearIntensity {
  double sliding = 0;   ///< [W/m2]
  double impact = 0;    ///< [W/m2]
  double pressure = 0;  ///< mean force over the area [Pa]
};

/// @param area  of the part [m2];  @param seconds  over which the load came [s]
WearIntensity wear_intensity(const WallLoad& load, double area, double seconds);

}  // namespace sluice
