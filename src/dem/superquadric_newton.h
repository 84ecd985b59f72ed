#pragma once
/// The surface-point Newton of a pair of superquadrics, for one pair (Real = double) or for several side
/// by side (Real = a vector of doubles). No branches: what differs between lanes is selected.
///
/// Unknowns are the two surface points, x on A (frame of A) and y on B (frame of B). With nA, nB the outward
/// normal of A and the inward normal of B (frame of A), n = (nA + nB) / |nA + nB|, E its tangent frame,
/// w = R y + d - x, s = n.w and W the shape operators in E, one step solves
///
///   normals agree:      dn - WB dB - WA dA = 0                     dn = E'(nB - nA)
///   points face:        wt + dB - dA - s (WA dA - dn/2) = 0         wt = E'w
///
/// by  (WA + WB + s WB WA) dA = dn + WB (wt + s dn/2):  the Newton step of the dual (maximise
/// n.d - hA(n) - hB(-n)) multiplied through by both shape operators, finite on flat faces. The dual's
/// Hessian is singular at s = sigma, the root of least modulus of det(WA + WB + s WB WA) (both negative);
/// s > sigma certifies a local maximum.

#include <cmath>
#include <cstdint>
#include <limits>

#include "dem/lanes.h"

namespace sluice::newton {

using namespace lanes;

template <class Real>
struct Rotation {
  Real m[3][3];  ///< B to A
  Triple<Real> forth(const Triple<Real>& v) const {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
  }
  Triple<Real> back(const Triple<Real>& v) const {
    return {m[0][0] * v.x + m[1][0] * v.y + m[2][0] * v.z, m[0][1] * v.x + m[1][1] * v.y + m[2][1] * v.z,
            m[0][2] * v.x + m[1][2] * v.y + m[2][2] * v.z};
  }
};

/// One body: inverse semi-axes and what raises to the power m - 2. `Power` has `Real m() const`,
/// `root_exponent()` = -1/m, and
/// `Real operator()(Real u) const` = u^(m-2) for u >= 0.
template <class Real, class Power>
struct Body {
  Triple<Real> inverse_axes;  ///< [1/m]
  Power power;
};

template <class Real>
struct Pair {
  Rotation<Real> rotation;  ///< B to A
  Triple<Real> d;           ///< centre B - centre A, frame of A [m]
  Real least;               ///< least semi-axis of the two [m]
  double guard = 0.9;       ///< s is taken as at least -guard sigma; nearer 1, faster close to the bound
};

/// Symmetric 2 x 2.
template <class Real>
struct Shape2 {
  Real xx, xy, yy;
};

/// Outward normal and the diagonal of Hess F / |grad F| at a point, which is moved radially onto the surface.
template <class Real>
struct SurfaceState {
  Triple<Real> normal;
  Triple<Real> curvature;  ///< [1/m]
};

template <class Real, class Power>
SurfaceState<Real> to_surface(const Body<Real, Power>& body, Triple<Real>& x) {
  const Triple<Real>& ia = body.inverse_axes;
  const Triple<Real> u{x.x * ia.x, x.y * ia.y, x.z * ia.z};
  const Triple<Real> p{body.power(absolute(u.x)), body.power(absolute(u.y)), body.power(absolute(u.z))};
  const Triple<Real> pu{p.x * u.x, p.y * u.y, p.z * u.z};
  const Real scale = power_of_sum(dot(pu, u), body.power.root_exponent());
  const Triple<Real> g{pu.x * ia.x, pu.y * ia.y, pu.z * ia.z};
  const Real inverse = reciprocal_root(dot(g, g));
  const Real factor = (body.power.m() - 1.0) * inverse * reciprocal(scale);
  x = {x.x * scale, x.y * scale, x.z * scale};
  return {{g.x * inverse, g.y * inverse, g.z * inverse},
          {factor * p.x * ia.x * ia.x, factor * p.y * ia.y * ia.y, factor * p.z * ia.z * ia.z}};
}

/// Everything known at a pair of surface points, and the step from there.
template <class Real>
struct Evaluation {
  Triple<Real> n, e1, e2;  ///< frame of A
  Real s;                  ///< n.w [m]
  Real angle2;             ///< |nB - nA|^2, tangential
  Real miss2;              ///< |wt|^2 [m2]
  Real sigma;              ///< the certificate's bound, > 0: holds where s > -sigma [m]
  Real a1, a2, b1, b2;     ///< step of x and y in (e1, e2) [m]
  Real step2;              ///< the longer of the two squared, not capped [m2]
  Real turn1, turn2;       ///< change of the normal with the step
};

/// Duff et al. (2017), without branches.
template <class Real>
void tangents(const Triple<Real>& n, Triple<Real>& e1, Triple<Real>& e2) {
  const Real sign = select(n.z < 0.0, Real{} - 1.0, Real{} + 1.0);
  const Real a = -reciprocal(sign + n.z);
  const Real b = n.x * n.y * a;
  e1 = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  e2 = {b, sign + n.y * n.y * a, -n.y};
}

template <class Real>
Shape2<Real> shape_operator(const Triple<Real>& c, const Triple<Real>& e1, const Triple<Real>& e2) {
  const Triple<Real> ce1{c.x * e1.x, c.y * e1.y, c.z * e1.z};
  return {dot(ce1, e1), dot(ce1, e2), c.x * e2.x * e2.x + c.y * e2.y * e2.y + c.z * e2.z * e2.z};
}

/// Solves for the step; `e` has s, and dn, wt are given in (e1, e2).
template <class Real>
void solve_step(const Pair<Real>& pair, const Shape2<Real>& wa, const Shape2<Real>& wb, const Real (&dn)[2],
                const Real (&wt)[2], Evaluation<Real>& e) {
  const Real sxx = wa.xx + wb.xx, sxy = wa.xy + wb.xy, syy = wa.yy + wb.yy;
  const Real pxx = wb.xx * wa.xx + wb.xy * wa.xy, pxy = wb.xx * wa.xy + wb.xy * wa.yy;
  const Real pyx = wb.xy * wa.xx + wb.yy * wa.xy, pyy = wb.xy * wa.xy + wb.yy * wa.yy;
  constexpr double tiny = std::numeric_limits<double>::min();
  // 1/trace of each bounds the root of det(S + s P) = c0 + c1 s + c2 s^2 from below; enough for most.
  e.sigma = reciprocal(wa.xx + wa.yy + tiny) + reciprocal(wb.xx + wb.yy + tiny);
  const auto deep = e.s < -0.5 * e.sigma;
  if (any(deep)) {
    const Real c0 = sxx * syy - sxy * sxy;
    const Real c1 = sxx * pyy + syy * pxx - sxy * (pxy + pyx);
    const Real c2 = pxx * pyy - pxy * pyx;
    const Real disc = larger(c1 * c1 - 4.0 * c0 * c2, Real{});
    e.sigma = select(deep, larger(2.0 * c0 / (c1 + root(disc) + tiny), e.sigma), e.sigma);
  }
  const Real se = larger(e.s, -pair.guard * e.sigma);
  const Real level = 1e-13 * reciprocal(pair.least);
  const Real mxx = sxx + se * pxx + level, mxy = sxy + se * pxy;
  const Real myx = sxy + se * pyx, myy = syy + se * pyy + level;
  const Real h1 = wt[0] + 0.5 * se * dn[0], h2 = wt[1] + 0.5 * se * dn[1];
  const Real r1 = dn[0] + wb.xx * h1 + wb.xy * h2, r2 = dn[1] + wb.xy * h1 + wb.yy * h2;
  const Real inverse = reciprocal(mxx * myy - mxy * myx);
  e.a1 = (myy * r1 - mxy * r2) * inverse;
  e.a2 = (mxx * r2 - myx * r1) * inverse;
  e.turn1 = wa.xx * e.a1 + wa.xy * e.a2 - 0.5 * dn[0];
  e.turn2 = wa.xy * e.a1 + wa.yy * e.a2 - 0.5 * dn[1];
  e.b1 = e.a1 - wt[0] + se * e.turn1;
  e.b2 = e.a2 - wt[1] + se * e.turn2;
  e.step2 = larger(e.a1 * e.a1 + e.a2 * e.a2, e.b1 * e.b1 + e.b2 * e.b2);
}

/// Moves x and y onto their surfaces and evaluates there.
template <class Real, class PowerA, class PowerB>
Evaluation<Real> evaluate(const Pair<Real>& pair, const Body<Real, PowerA>& a, const Body<Real, PowerB>& b,
                          Triple<Real>& x, Triple<Real>& y) {
  const SurfaceState<Real> at_x = to_surface(a, x);
  const SurfaceState<Real> at_y = to_surface(b, y);
  const Triple<Real> outward = pair.rotation.forth(at_y.normal);
  Evaluation<Real> e;
  // Normals that point opposite ways cancel here; the direction of the centres breaks the tie.
  const Real tie = 1e-12 * reciprocal(pair.least);
  const Triple<Real> sum{at_x.normal.x - outward.x + tie * pair.d.x,
                         at_x.normal.y - outward.y + tie * pair.d.y,
                         at_x.normal.z - outward.z + tie * pair.d.z};
  const Real inverse = reciprocal_root(larger(dot(sum, sum), Real{} + 1e-60));
  e.n = {sum.x * inverse, sum.y * inverse, sum.z * inverse};
  tangents(e.n, e.e1, e.e2);
  const Triple<Real> ry = pair.rotation.forth(y);
  const Triple<Real> w{ry.x + pair.d.x - x.x, ry.y + pair.d.y - x.y, ry.z + pair.d.z - x.z};
  e.s = dot(e.n, w);
  const Real dn[2] = {-dot(e.e1, outward) - dot(e.e1, at_x.normal),
                      -dot(e.e2, outward) - dot(e.e2, at_x.normal)};
  const Real wt[2] = {dot(e.e1, w), dot(e.e2, w)};
  e.angle2 = dn[0] * dn[0] + dn[1] * dn[1];
  e.miss2 = wt[0] * wt[0] + wt[1] * wt[1];
  const Shape2<Real> wa = shape_operator(at_x.curvature, e.e1, e.e2);
  const Shape2<Real> wb = shape_operator(at_y.curvature, pair.rotation.back(e.e1), pair.rotation.back(e.e2));
  solve_step(pair, wa, wb, dn, wt, e);
  return e;
}

/// Whether the normal points from the first centre towards the second. Turning a normal round changes the gap
/// by twice n.d where both bodies are symmetric about their centres: the largest gap has n.d >= 0. Flat faces
/// on the far sides satisfy every other condition, for they have no curvature that could tell a maximum from
/// a minimum.
template <class Real>
auto faces(const Pair<Real>& pair, const Evaluation<Real>& e) {
  return dot(e.n, pair.d) >= -1e-12 * pair.least;
}

/// Takes the step, capped at 0.3 of the least semi-axis.
template <class Real>
void advance(const Pair<Real>& pair, const Evaluation<Real>& e, Triple<Real>& x, Triple<Real>& y) {
  const Real longest = 0.3 * pair.least;
  const Real cap = smaller(Real{} + 1.0, longest * reciprocal_root(larger(e.step2, Real{} + 1e-200)));
  const Real a1 = cap * e.a1, a2 = cap * e.a2, b1 = cap * e.b1, b2 = cap * e.b2;
  x = {x.x + a1 * e.e1.x + a2 * e.e2.x, x.y + a1 * e.e1.y + a2 * e.e2.y, x.z + a1 * e.e1.z + a2 * e.e2.z};
  const Triple<Real> move{b1 * e.e1.x + b2 * e.e2.x, b1 * e.e1.y + b2 * e.e2.y, b1 * e.e1.z + b2 * e.e2.z};
  const Triple<Real> turned = pair.rotation.back(move);
  y = {y.x + turned.x, y.y + turned.y, y.z + turned.z};
}

/// u^(m-2) for whole m from 2 to 17, by multiplication.
struct WholePower {
  double blockiness;
  std::uint32_t exponent;  ///< m - 2
  double m() const { return blockiness; }
  double root_exponent() const { return -1 / blockiness; }
  double operator()(double u) const {
    double power = (exponent & 1u) != 0 ? u : 1.0;
    double square = u * u;
    if ((exponent & 2u) != 0) power *= square;
    if (exponent < 4) return power;
    square *= square;
    if ((exponent & 4u) != 0) power *= square;
    square *= square;
    if ((exponent & 8u) != 0) power *= square;
    return power;
  }
};

/// u^(m-2) for any m.
struct AnyPower {
  double blockiness;
  double m() const { return blockiness; }
  double root_exponent() const { return -1 / blockiness; }
  double operator()(double u) const { return std::pow(u, blockiness - 2); }
};

}  // namespace sluice::newton
