#pragma once
/// How water turns a rock that is not resolved: drag acts beside the rock's centre, and spin is resisted.
///
/// Centre of pressure of a rod at the angle alpha to the stream, Rosendahl (2000) Appl. Math. Modelling
/// 24:11, here half its length a: 0.5 a (1 - exp(3 (1 - aspect))) |cos alpha|^3 upstream along its axis, so
/// that a long rock ends broadside on. With u the stream's direction in the body frame, w_i =
/// 1 - exp(3 (1 - a_i / c)) and c the shortest semi-axis, it is
///   -0.5 sum_i a_i w_i u_i e_i * sum_i w_i u_i^2 / max_i w_i
/// for any three semi-axes: Rosendahl's for a rod, the same along its radius for a disc, nothing for a
/// sphere.
///
/// Spin s against the water's about a body axis k, of semi-axes p, q across and r along it:
///   creeping        Jeffery (1922) Proc. R. Soc. A 102:161, exact for the ellipsoid of these semi-axes
///   faster          times the factor of a sphere, (12.9 sqrt(Re) + 128.4) / (64 pi) from Re 32 on,
///                   Dennis, Singh & Ingham (1980) J. Fluid Mech. 101:257, Re = rho 4 p^2 |s| / mu, p the
///                   larger
///   form of edges   rho / 2 C r |p^4 - q^4| |s|, strips in cross-flow at C = 1.2
/// in sum. Blocks get those of their ellipsoid.

#include "dem/rock_shape.h"

namespace sluice {

/// Of the water and a rock in it.
struct TurningInput {
  double size = 0;                ///< of the rock [m]
  double density = 1000;          ///< of the water [kg/m3]
  double viscosity = 1e-3;        ///< of the water [Pa s]
  Vec3 direction = Vec3::Zero();  ///< of the water past the rock, unit vector, body frame
  Vec3 spin = Vec3::Zero();       ///< of the rock against the water's own, body frame [rad/s]
};

/// What drag and torque on a rock share.
struct WaterAround {
  double density = 0, viscosity = 0;
  Vec3 direction = Vec3::Zero();  ///< of the water past the rock, unit vector
  double resisting = 0;           ///< share of the law against spin that acts
  double turning = 0;             ///< share of the drag that acts beside the centre
};

class Turning {
 public:
  explicit Turning(const RockShape& shape);
  /// Where drag acts, from the centre of the rock, body frame [m].
  Vec3 centre_of_pressure(const TurningInput& in) const;
  /// Torque about each body axis over the spin against it [N m s].
  Vec3 resistance(const TurningInput& in) const;

 private:
  Vec3 semi_axes_;                ///< of a rock of size 1 [m]
  Vec3 reach_ = Vec3::Zero();     ///< w_i
  Vec3 creeping_ = Vec3::Zero();  ///< over the viscosity, size 1 [m3]
  Vec3 edges_ = Vec3::Zero();     ///< r |p^4 - q^4|, size 1 [m5]
};

}  // namespace sluice
