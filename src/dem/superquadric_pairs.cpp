#include "dem/superquadric_pairs.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "dem/superquadric_newton.h"

namespace sluice {

namespace {

using newton::all_lanes;
using newton::any;
using newton::Body;
using newton::Evaluation;
using newton::kLanes;
using newton::LaneMask;
using newton::Lanes;
using newton::Triple;

using LaneTriple = Triple<Lanes>;

/// As in superquadric_contact.cpp: predicted step, residuals, and residuals of flat faces.
constexpr double kStep = 1e-5;
constexpr double kResidual = 1e-6;
constexpr double kFlat = 1e-12;
constexpr int kIterations = 5;  ///< then the scalar kernel with its fallbacks takes over
constexpr std::size_t kBlock = 128;

struct LaneQuat {
  Lanes w;
  LaneTriple v;
};

LaneTriple cross(const LaneTriple& a, const LaneTriple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
LaneTriple sum(const LaneTriple& a, const LaneTriple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
LaneTriple scaled(const Lanes& s, const LaneTriple& a) {
  return {s * a.x, s * a.y, s * a.z};
}
LaneTriple choose(const LaneMask& mask, const LaneTriple& yes, const LaneTriple& no) {
  return {newton::select(mask, yes.x, no.x), newton::select(mask, yes.y, no.y),
          newton::select(mask, yes.z, no.z)};
}
LaneQuat conjugate(const LaneQuat& q) {
  return {q.w, {-q.v.x, -q.v.y, -q.v.z}};
}
LaneQuat product(const LaneQuat& p, const LaneQuat& q) {
  return {p.w * q.w - dot(p.v, q.v), sum(sum(scaled(p.w, q.v), scaled(q.w, p.v)), cross(p.v, q.v))};
}
LaneTriple rotate(const LaneQuat& q, const LaneTriple& x) {
  const LaneTriple t = scaled(all_lanes(2.0), cross(q.v, x));
  return sum(sum(x, scaled(q.w, t)), cross(q.v, t));
}
newton::Rotation<Lanes> matrix(const LaneQuat& q) {
  const Lanes x2 = 2.0 * q.v.x, y2 = 2.0 * q.v.y, z2 = 2.0 * q.v.z;
  const Lanes xx = x2 * q.v.x, yy = y2 * q.v.y, zz = z2 * q.v.z;
  const Lanes xy = x2 * q.v.y, xz = x2 * q.v.z, yz = y2 * q.v.z;
  const Lanes wx = x2 * q.w, wy = y2 * q.w, wz = z2 * q.w;
  return {{{1.0 - yy - zz, xy - wz, xz + wy},
           {xy + wz, 1.0 - xx - zz, yz - wx},
           {xz - wy, yz + wx, 1.0 - xx - yy}}};
}

/// One pair a lane, in the frame of A.
struct Gathered {
  newton::Pair<Lanes> pair;
  LaneQuat q_a;
  LaneTriple axes_a, axes_b;
  Lanes m_a, m_b;
  LaneTriple x, y;    ///< surface points
  LaneTriple normal;  ///< the last, frame of A
  bool whole = true;  ///< all m are whole
};

void put(LaneTriple& to, int lane, const Vec3& v) {
  to.x[lane] = v.x();
  to.y[lane] = v.y();
  to.z[lane] = v.z();
}
Vec3 take(const LaneTriple& from, int lane) {
  return {from.x[lane], from.y[lane], from.z[lane]};
}
void put(LaneQuat& to, int lane, const Quat& q) {
  to.w[lane] = q.w();
  put(to.v, lane, q.vec());
}

/// `chosen` may be shorter than the lanes: the last is repeated.
Gathered gather(std::span<const Superquadric> bodies, std::span<const BodyPair> pairs,
                std::span<const PairMemory> memory, std::span<const std::uint32_t> chosen) {
  Gathered g;
  LaneQuat q_b;
  LaneTriple d;
  LaneTriple normal;
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::size_t k = chosen[std::min(static_cast<std::size_t>(lane), chosen.size() - 1)];
    const BodyPair& pair = pairs[k];
    const Superquadric& a = bodies[pair.a];
    const Superquadric& b = bodies[pair.b];
    put(g.q_a, lane, a.q);
    put(q_b, lane, b.q);
    put(g.axes_a, lane, a.semi_axes);
    put(g.axes_b, lane, b.semi_axes);
    g.m_a[lane] = a.m;
    g.m_b[lane] = b.m;
    put(d, lane, pair.d);
    put(g.x, lane, memory[k].surface_a);
    put(g.y, lane, memory[k].surface_b);
    put(normal, lane, memory[k].normal);
    g.whole = g.whole && a.m == std::floor(a.m) && b.m == std::floor(b.m) && a.m <= 17 && b.m <= 17;
  }
  const LaneQuat to_a = conjugate(g.q_a);
  g.pair.rotation = matrix(product(to_a, q_b));
  g.pair.d = rotate(to_a, d);
  g.normal = rotate(to_a, normal);
  const auto least = [](const LaneTriple& t) { return newton::smaller(t.x, newton::smaller(t.y, t.z)); };
  g.pair.least = newton::smaller(least(g.axes_a), least(g.axes_b));
  return g;
}

/// Support function [m] along n.
Lanes support_height(const LaneTriple& axes, Lanes m, const LaneTriple& n) {
  const LaneTriple an{newton::absolute(axes.x * n.x), newton::absolute(axes.y * n.y),
                      newton::absolute(axes.z * n.z)};
  const Lanes largest = newton::larger(an.x, newton::larger(an.y, an.z));
  const Lanes exponent = m / (m - 1.0);
  const Lanes sum = newton::power(an.x / largest, exponent) + newton::power(an.y / largest, exponent) +
                    newton::power(an.z / largest, exponent);
  return largest * newton::power(sum, 1.0 / exponent);
}

/// Lanes whose last normal still separates, beyond the rounding of the support function.
LaneMask separated(const Gathered& g) {
  const LaneTriple ry = g.pair.rotation.forth(g.y);
  const LaneTriple w{ry.x + g.pair.d.x - g.x.x, ry.y + g.pair.d.y - g.x.y, ry.z + g.pair.d.z - g.x.z};
  // The points known bound the gap along n from above: no need to look where they already overlap.
  const LaneMask may = dot(g.normal, w) > 0.0;
  if (!any(may)) return may;
  const LaneTriple back = g.pair.rotation.back(g.normal);
  const Lanes gap = dot(g.normal, g.pair.d) - support_height(g.axes_a, g.m_a, g.normal) -
                    support_height(g.axes_b, g.m_b, back);
  return may & (gap > 1e-12 * g.pair.least);
}

struct Solved {
  LaneTriple x, y, point, normal;  ///< point - centre of A and normal in the space frame
  Lanes gap;
  LaneMask done;
};

template <class Power>
Solved iterate(Gathered& g) {
  const auto inverse = [](const LaneTriple& t) { return LaneTriple{1.0 / t.x, 1.0 / t.y, 1.0 / t.z}; };
  const Body<Lanes, Power> a{inverse(g.axes_a), Power(g.m_a)};
  const Body<Lanes, Power> b{inverse(g.axes_b), Power(g.m_b)};
  const Lanes least2 = g.pair.least * g.pair.least;
  Solved solved{};
  LaneTriple x = g.x, y = g.y;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Evaluation<Lanes> e = newton::evaluate(g.pair, a, b, x, y);
    const LaneMask small_step = (e.step2 < kStep * kStep * least2) & (e.angle2 < kResidual * kResidual) &
                                (e.miss2 < kResidual * kResidual * least2);
    const LaneMask flat = (e.angle2 < kFlat * kFlat) & (e.miss2 < kFlat * kFlat * least2);
    const LaneMask now = (small_step | flat) & (e.s > -e.sigma) & ~solved.done;
    // The last step is taken in any case, to first order where it ends the iteration.
    newton::advance(g.pair, e, x, y);
    if (!any(now)) continue;
    const LaneTriple n = sum(e.n, sum(scaled(e.turn1, e.e1), scaled(e.turn2, e.e2)));
    solved.normal = choose(now, scaled(newton::reciprocal_root(dot(n, n)), n), solved.normal);
    solved.gap = newton::select(now, e.s, solved.gap);
    solved.x = choose(now, x, solved.x);
    solved.y = choose(now, y, solved.y);
    solved.done |= now;
    if (!any(~solved.done)) break;
  }
  const LaneTriple middle =
      scaled(all_lanes(0.5), sum(solved.x, sum(g.pair.rotation.forth(solved.y), g.pair.d)));
  solved.point = rotate(g.q_a, middle);
  solved.normal = rotate(g.q_a, solved.normal);
  return solved;
}

PairOutcome solve_alone(std::span<const Superquadric> bodies, const BodyPair& pair, PairMemory& memory,
                        ContactGeometry& geometry) {
  Superquadric b = bodies[pair.b];
  b.x = bodies[pair.a].x + pair.d;
  return superquadric_pair(bodies[pair.a], b, memory, geometry);
}

bool cold(const PairMemory& memory) {
  return memory.normal.squaredNorm() == 0 || memory.surface_a.squaredNorm() == 0;
}

}  // namespace

void superquadric_pairs(std::span<const Superquadric> bodies, std::span<const BodyPair> pairs,
                        std::span<PairMemory> memory, std::span<ContactGeometry> geometry,
                        std::span<PairOutcome> outcome) {
  assert(memory.size() == pairs.size() && geometry.size() == pairs.size() && outcome.size() == pairs.size());
  std::array<std::uint32_t, kBlock> warm, close;
  for (std::size_t begin = 0; begin < pairs.size(); begin += kBlock) {
    const std::size_t end = std::min(pairs.size(), begin + kBlock);
    std::size_t warm_count = 0, close_count = 0;
    for (std::size_t k = begin; k < end; ++k) {
      if (cold(memory[k]))
        outcome[k] = solve_alone(bodies, pairs[k], memory[k], geometry[k]);
      else
        warm[warm_count++] = static_cast<std::uint32_t>(k);
    }
    // Leave out what still stands apart.
    for (std::size_t i = 0; i < warm_count; i += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, warm_count - i);
      const std::span<const std::uint32_t> chosen(&warm[i], count);
      const LaneMask apart = separated(gather(bodies, pairs, memory, chosen));
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (apart[lane] != 0)
          outcome[chosen[lane]] = PairOutcome::separated;
        else
          close[close_count++] = chosen[lane];
      }
    }
    for (std::size_t i = 0; i < close_count; i += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, close_count - i);
      const std::span<const std::uint32_t> chosen(&close[i], count);
      Gathered g = gather(bodies, pairs, memory, chosen);
      const Solved solved = g.whole ? iterate<newton::LaneWholePower>(g) : iterate<newton::LaneAnyPower>(g);
      for (int lane = 0; lane < static_cast<int>(count); ++lane) {
        const std::size_t k = chosen[static_cast<std::size_t>(lane)];
        if (solved.done[lane] == 0) {
          outcome[k] = solve_alone(bodies, pairs[k], memory[k], geometry[k]);
          continue;
        }
        memory[k] = {take(solved.x, lane), take(solved.y, lane), take(solved.normal, lane)};
        geometry[k] = {bodies[pairs[k].a].x + take(solved.point, lane), memory[k].normal, -solved.gap[lane]};
        outcome[k] = solved.gap[lane] < 0 ? PairOutcome::converged : PairOutcome::separated;
      }
    }
  }
}

}  // namespace sluice
