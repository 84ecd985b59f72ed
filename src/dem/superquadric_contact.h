#pragma once
/// Where two superquadrics touch: overlap and normal of the common normal, so that the contact force has
/// a potential. Surface-point Newton, warm-started, with a certificate of convergence on each contact and
/// a robust fallback (continuation in m from the ellipsoid).

#include "base/vec.h"

namespace sluice {

/// A superquadric in space.
struct Superquadric {
  Vec3 x = Vec3::Zero();          ///< centre [m]
  Quat q = Quat::Identity();      ///< body to space
  Vec3 semi_axes = Vec3::Ones();  ///< [m]
  double m = 2;                   ///< blockiness, >= 2
};

/// Contact of a body with another: `normal` points from the first to the second.
struct ContactGeometry {
  Vec3 point = Vec3::Zero();    ///< midway between the two surface points [m]
  Vec3 normal = Vec3::UnitZ();  ///< unit
  double overlap = 0;           ///< positive where they overlap; negative gap otherwise [m]
};

/// What one pair remembers between steps. Default: nothing known.
struct PairMemory {
  Vec3 surface_a = Vec3::Zero();  ///< surface point of A, frame of A
  Vec3 surface_b = Vec3::Zero();  ///< surface point of B, frame of B
  Vec3 normal = Vec3::Zero();     ///< last common normal, space frame; zero = cold

  /// The same pair with A and B exchanged.
  void turn_round() {
    surface_a.swap(surface_b);
    normal = -normal;
  }
};

enum class PairOutcome {
  separated,   ///< a rigorous separating plane was found; geometry may not be computed
  converged,   ///< they overlap; geometry holds, residuals below tolerance
  fallback,    ///< the same, after the fallback
  unresolved,  ///< never expected; geometry is the best found
};

/// Contact of two bodies that may touch.
/// @param geometry  written unless separated; then only its overlap is, negative: the bodies are at least
/// that
///                  far apart
PairOutcome superquadric_pair(const Superquadric& a, const Superquadric& b, PairMemory& memory,
                              ContactGeometry& geometry);

/// The same for bodies near or apart, to rounding and without a separation test: geometry is always
/// written. Never returns `separated`.
PairOutcome superquadric_gap(const Superquadric& a, const Superquadric& b, PairMemory& memory,
                             ContactGeometry& geometry);

/// Contact of a superquadric with the half-space below a plane through `on_plane` with unit normal `n`
/// (pointing to the body's side); closed form. `normal` of the result = -n (from body to wall).
ContactGeometry superquadric_plane(const Superquadric& body, const Vec3& on_plane, const Vec3& n);

/// Contact with an edge (segment a-b) and with a vertex. `start` is in and out: the surface point in the body
/// frame, zero when cold. `normal` points from the body to the edge or vertex, `point` lies midway between
/// the two. Returns false if they do not touch (gap >= 0), or if the line's contact is beyond the segment's
/// ends (its vertices then decide).
bool superquadric_segment(const Superquadric& body, const Vec3& a, const Vec3& b, Vec3& start,
                          ContactGeometry& geometry);
bool superquadric_point(const Superquadric& body, const Vec3& p, Vec3& start, ContactGeometry& geometry);

}  // namespace sluice
