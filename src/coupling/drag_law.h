#pragma once
/// Drag of the fluid on one rock among others. Plain parameters and pure functions.

namespace sluice {

enum class DragModel { di_felice, schiller_naumann, gidaspow };

/// What the drag on a rock depends on.
struct DragInput {
  double density = 1000;     ///< of the fluid [kg/m3]
  double viscosity = 1e-3;   ///< of the fluid [Pa s]
  double diameter = 0;       ///< of the sphere of equal volume [m]
  double void_fraction = 1;  ///< 1 - solids fraction around the rock
  double speed = 0;          ///< of the fluid relative to the rock, between the rocks [m/s]
};

/// Reynolds number rho eps |u| d / mu.
double reynolds_number(const DragInput& in);

/// Drag over relative speed [kg/s]: F = drag_per_speed * (v_fluid - v_rock), as in model A, buoyancy apart.
///   di_felice         Di Felice (1994): (pi d^2/8) rho (0.63 + 4.8/sqrt(Re))^2 eps^(2 - chi) |u|
///   schiller_naumann  Schiller & Naumann (1935), 0.44 above Re 1000; a lone sphere, eps is not used
///   gidaspow          Ergun (1952) below eps 0.8, Wen & Yu (1966) above, blended linearly in 0.75..0.85
/// Finite and positive as the speed goes to zero.
double drag_per_speed(DragModel model, const DragInput& in);

}  // namespace sluice
