#pragma once
/// Sums over the 27 nodes around a point, axis by axis.

#include "mpm/lanes.h"
#include "mpm/spline_weights.h"

namespace sluice {

/// sum = sum w node over all lanes; moment[c] = sum w d_c node over the first eight, with d in cells from the
/// point. Moments are first taken about the middle node, where an axis counts -1, 0, 1, and then moved.
/// @param corner  node (-1, -1, -1); the next in y is `row` nodes on, in z `layer`
/// @param offset  of the point from the middle node [cells]
template <int row, int layer, class Real>
[[gnu::always_inline]] inline void spline_sums(const Lanes<Real>* corner, const Quad<Real>& offset,
                                               Lanes<Real>& sum, typename Lanes<Real>::Half (&moment)[3]) {
  using Half = typename Lanes<Real>::Half;
  const SplineWeights<Real> x(offset[0]), y(offset[1]), z(offset[2]);
  Half plain[3], by_x[3], by_y[3], rest[3];
  for (int k = 0; k < 3; ++k) {
    Half line[3], line_x[3], line_rest[3];
    for (int j = 0; j < 3; ++j) {
      const Lanes<Real>* node = corner + row * j + layer * k;
      const Half low = x.w[0] * node[0].half(0), high = x.w[2] * node[2].half(0);
      line[j] = y.w[j] * ((low + high) + x.w[1] * node[1].half(0));
      line_x[j] = high - low;
      line_rest[j] = x.w[0] * node[0].half(1) + x.w[1] * node[1].half(1) + x.w[2] * node[2].half(1);
    }
    plain[k] = z.w[k] * ((line[0] + line[2]) + line[1]);
    by_y[k] = line[2] - line[0];
    by_x[k] = y.w[0] * line_x[0] + y.w[1] * line_x[1] + y.w[2] * line_x[2];
    rest[k] = y.w[0] * line_rest[0] + y.w[1] * line_rest[1] + y.w[2] * line_rest[2];
  }
  const Half whole = (plain[0] + plain[2]) + plain[1];
  sum.half(0) = whole;
  sum.half(1) = z.w[0] * rest[0] + z.w[1] * rest[1] + z.w[2] * rest[2];
  moment[0] = z.w[0] * by_x[0] + z.w[1] * by_x[1] + z.w[2] * by_x[2] - offset[0] * whole;
  moment[1] = z.w[0] * by_y[0] + z.w[1] * by_y[1] + z.w[2] * by_y[2] - offset[1] * whole;
  moment[2] = (plain[2] - plain[0]) - offset[2] * whole;
}

/// sum w quad; moment[c] = sum w d_c of its fourth number alone, with d in cells from the point.
/// @param corner, offset  as above
template <int row, int layer, class Real>
[[gnu::always_inline]] inline Quad<Real> spline_sum_of_quads(const Quad<Real>* corner,
                                                             const Quad<Real>& offset, Real (&moment)[3]) {
  const SplineWeights<Real> x(offset[0]), y(offset[1]), z(offset[2]);
  Quad<Real> plain[3], by_x[3];
  Real by_y[3];
  for (int k = 0; k < 3; ++k) {
    Quad<Real> line[3], line_x[3];
    for (int j = 0; j < 3; ++j) {
      const Quad<Real>* node = corner + row * j + layer * k;
      const Quad<Real> low = x.w[0] * node[0], high = x.w[2] * node[2];
      line[j] = y.w[j] * ((low + high) + x.w[1] * node[1]);
      line_x[j] = high - low;
    }
    plain[k] = z.w[k] * ((line[0] + line[2]) + line[1]);
    by_y[k] = line[2][3] - line[0][3];
    by_x[k] = y.w[0] * line_x[0] + y.w[1] * line_x[1] + y.w[2] * line_x[2];
  }
  const Quad<Real> whole = (plain[0] + plain[2]) + plain[1];
  moment[0] = z.w[0] * by_x[0][3] + z.w[1] * by_x[1][3] + z.w[2] * by_x[2][3] - offset[0] * whole[3];
  moment[1] = z.w[0] * by_y[0] + z.w[1] * by_y[1] + z.w[2] * by_y[2] - offset[1] * whole[3];
  moment[2] = (plain[2][3] - plain[0][3]) - offset[2] * whole[3];
  return whole;
}

/// Both quads of eight lanes, added up.
template <class Real>
Quad<Real> sum_of_quads(const typename Lanes<Real>::Half& x) {
  return reinterpret_cast<const Quad<Real>*>(&x)[0] + reinterpret_cast<const Quad<Real>*>(&x)[1];
}

}  // namespace sluice
