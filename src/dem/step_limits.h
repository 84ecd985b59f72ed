#pragma once
/// How stiff rocks must be, and how long a step may then be.

#include "dem/dem_system.h"

namespace sluice {

/// How much more readily a contact moves a rock of this shape than a point of its mass: the largest
/// eigenvalue of (stiffness of one contact, in units of k_n) x (mobility of the contact point, in units
/// of 1/mass), over all directions of the contact. 1 for a sphere with k_t = 2/7 k_n; 4 at a rod's tip.
double contact_mobility(const RockShape& shape, double tangential_ratio);

/// True unless every contact that a rock can have is hertz_mindlin: then the keys of the linear law's
/// stiffness have no effect.
bool linear_law_used(const Materials& materials);

/// Stiffness from the larger of two rules and the step from the smaller of two.
///
/// Pair stiffness is K 2 d1 d2 / (d1 + d2), wall stiffness K d, with K the stiffness per size: overlap
/// over radius is then the same for all sizes.
///   impact: m v^2 = K d (xi d/2)^2  for a rock on a wall, damping left out
///   bed:    mean contact force pi d^2 p / (phi Z) (Rumpf), phi = 0.6, Z = 6, under p = phi rho g H
/// The stiffest contact possible for the smallest, lightest rock is with an equal (k = K d, both
/// move) or with a far larger one (k = 2 K d, one moves): omega^2 = 2 K d mobility / m for both.
/// In a bed a rock is held by 12 contacts: 4 k_n + 8 k_t (physics.md, Rocks), shortened by the
/// lagged dashpot's factor sqrt(1 + zeta^2) - zeta.
///
/// Hertz-Mindlin contacts have the stiffness of their materials: contact time at the impact speed, and
/// the same network with the tangent stiffness at the deepest overlap, that of an impact at that speed or
/// that of the bed (adhesion included in both). Spheres of half the size stand for every shape; the
/// mobility is the shape's own. Adhesion does not enter the two rules of the linear law.
DemStepLimits choose_limits(const DemConfig& config, const DemScene& scene);

}  // namespace sluice
