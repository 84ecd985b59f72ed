#pragma once
/// Quadratic B-spline over the three nodes nearest to a point (Steffen, Kirby & Berzins 2008).

namespace sluice {

/// Weights of the nodes at -1, 0, +1 cells from the nearest node, and those nodes' distance from the
/// point [cells].
template <class Real>
struct SplineWeights {
  Real w[3];
  Real d[3];

  /// @param offset  of the point from its nearest node [cells], -0.5..0.5
  explicit SplineWeights(Real offset) {
    const Real left = Real(0.5) - offset, right = Real(0.5) + offset;
    w[0] = Real(0.5) * left * left;
    w[1] = Real(0.75) - offset * offset;
    w[2] = Real(0.5) * right * right;
    d[0] = Real(-1) - offset;
    d[1] = -offset;
    d[2] = Real(1) - offset;
  }
};

/// Quadratic B-spline at a distance of s cells from its node.
inline double quadratic_spline(double s) {
  if (s < 0) s = -s;
  if (s < 0.5) return 0.75 - s * s;
  return s < 1.5 ? 0.5 * (1.5 - s) * (1.5 - s) : 0.0;
}

/// Part of the quadratic B-spline that lies beyond s cells from its node.
inline double spline_beyond(double s) {
  if (s < 0.5) return 0.5 - 0.75 * s + s * s * s / 3.0;
  return s < 1.5 ? (1.5 - s) * (1.5 - s) * (1.5 - s) / 6.0 : 0.0;
}

}  // namespace sluice
