#pragma once
/// Drag of the fluid on one rock among others. Plain parameters and pure functions.

#include <initializer_list>
#include <utility>

namespace sluice {

enum class DragModel { di_felice, schiller_naumann, gidaspow, rong, haider_levenspiel, hoelzer_sommerfeld };
/// The words of a process file.
inline constexpr std::initializer_list<std::pair<const char*, DragModel>> drag_models = {
    {"di_felice", DragModel::di_felice},
    {"schiller_naumann", DragModel::schiller_naumann},
    {"gidaspow", DragModel::gidaspow},
    {"rong", DragModel::rong},
    {"haider_levenspiel", DragModel::haider_levenspiel},
    {"hoelzer_sommerfeld", DragModel::hoelzer_sommerfeld},
};

/// What the drag on a rock depends on.
struct DragInput {
  double density = 1000;     ///< of the fluid [kg/m3]
  double viscosity = 1e-3;   ///< of the fluid [Pa s]
  double diameter = 0;       ///< of the sphere of equal volume [m]
  double void_fraction = 1;  ///< 1 - solids fraction around the rock
  double speed = 0;          ///< of the fluid relative to the rock, between the rocks [m/s]
  double sphericity = 1;     ///< area of the sphere of equal volume over the rock's
  double crosswise = 1;      ///< cross-section of that sphere over the rock's, seen along the flow
};

/// Reynolds number rho eps |u| d / mu.
double reynolds_number(const DragInput& in);

/// Drag over relative speed [kg/s]: F = drag_per_speed * (v_fluid - v_rock), as in model A, buoyancy apart.
///   di_felice         Di Felice (1994): (pi d^2/8) rho (0.63 + 4.8/sqrt(Re))^2 eps^(2 - chi) |u|
///   schiller_naumann  Schiller & Naumann (1935), 0.44 above Re 1000; a lone sphere, eps is not used
///   gidaspow          Ergun (1952) below eps 0.8, Wen & Yu (1966) above, blended linearly in 0.75..0.85
///   rong              Rong, Dong & Yu (2013): Di Felice's form with another chi, from lattice-Boltzmann beds
///   haider_levenspiel   Haider & Levenspiel (1989) eq. 11, Cd of the sphericity
///   hoelzer_sommerfeld  Hoelzer & Sommerfeld (2008) eq. 10, Cd of sphericity and crosswise sphericity,
///                       which stands in the first term as well; torque: turning.h
/// The last two are of lone rocks; among others they get Di Felice's eps^(2 - chi).
/// Finite and positive as the speed goes to zero.
double drag_per_speed(DragModel model, const DragInput& in);

}  // namespace sluice
