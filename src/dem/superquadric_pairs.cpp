#include "dem/superquadric_pairs.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "dem/lane_rows.h"
#include "dem/superquadric_newton.h"

namespace sluice {

namespace {

using lanes::Columns;
using lanes::load_columns;
using lanes::Rows;
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

LaneQuat conjugate(const LaneQuat& q) {
  return {q.w, {-q.v.x, -q.v.y, -q.v.z}};
}
LaneQuat product(const LaneQuat& p, const LaneQuat& q) {
  return {p.w * q.w - dot(p.v, q.v), p.w * q.v + q.w * p.v + cross(p.v, q.v)};
}
LaneTriple rotate(const LaneQuat& q, const LaneTriple& x) {
  const LaneTriple t = all_lanes(2.0) * cross(q.v, x);
  return x + q.w * t + cross(q.v, t);
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
  bool whole = true;  ///< all m are whole
};

Vec3 take(const LaneTriple& from, int lane) {
  return {from.x[lane], from.y[lane], from.z[lane]};
}

// A body is four numbers of its quaternion (x, y, z, w), three semi-axes and m; a memory's first eight are
// both surface points and two of the normal's.
static_assert(sizeof(TurnedShape) == 8 * sizeof(double) && sizeof(PairMemory) == 9 * sizeof(double));

struct LaneBody {
  LaneQuat q;
  LaneTriple axes;
  Lanes m;
};
LaneBody body_of(const Columns& c) {
  return {{c[3], {c[0], c[1], c[2]}}, {c[4], c[5], c[6]}, c[7]};
}

LaneMask whole(Lanes m) {
  const Lanes nearest = __builtin_convertvector(__builtin_convertvector(m, LaneMask), Lanes);
  return (nearest == m) & (m <= 17.0);
}

/// `chosen` may be shorter than the lanes: the last is repeated.
Gathered gather(std::span<const TurnedShape> bodies, std::span<const BodyPair> pairs,
                std::span<const PairMemory> memory, std::span<const std::uint32_t> chosen) {
  Gathered g;
  Rows row_a, row_b, row_memory;
  LaneTriple d;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const BodyPair& pair = pairs[chosen[std::min(lane, chosen.size() - 1)]];
    row_a[lane] = bodies[pair.a].q.coeffs().data();
    row_b[lane] = bodies[pair.b].q.coeffs().data();
    row_memory[lane] = memory[pair.memory].surface_a.data();
    d.x[lane] = pair.d.x();
    d.y[lane] = pair.d.y();
    d.z[lane] = pair.d.z();
  }
  const LaneBody a = body_of(load_columns(row_a)), b = body_of(load_columns(row_b));
  const Columns known = load_columns(row_memory);
  g.q_a = a.q;
  g.axes_a = a.axes;
  g.axes_b = b.axes;
  g.m_a = a.m;
  g.m_b = b.m;
  g.x = {known[0], known[1], known[2]};
  g.y = {known[3], known[4], known[5]};
  g.whole = !any(~(whole(a.m) & whole(b.m)));
  const LaneQuat to_a = conjugate(a.q);
  g.pair.rotation = matrix(product(to_a, b.q));
  g.pair.d = rotate(to_a, d);
  const auto least = [](const LaneTriple& t) { return newton::smaller(t.x, newton::smaller(t.y, t.z)); };
  g.pair.least = newton::smaller(least(a.axes), least(b.axes));
  return g;
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
    const LaneMask now = (small_step | flat) & (e.s > -e.sigma) & newton::faces(g.pair, e) & ~solved.done;
    // The last step is taken in any case, to first order where it ends the iteration.
    newton::advance(g.pair, e, x, y);
    if (!any(now)) continue;
    const LaneTriple n = e.n + e.turn1 * e.e1 + e.turn2 * e.e2;
    solved.normal = select(now, newton::reciprocal_root(dot(n, n)) * n, solved.normal);
    solved.gap = newton::select(now, e.s, solved.gap);
    solved.x = select(now, x, solved.x);
    solved.y = select(now, y, solved.y);
    solved.done |= now;
    if (!any(~solved.done)) break;
  }
  const LaneTriple middle = all_lanes(0.5) * (solved.x + g.pair.rotation.forth(solved.y) + g.pair.d);
  solved.point = rotate(g.q_a, middle);
  solved.normal = rotate(g.q_a, solved.normal);
  return solved;
}

PairOutcome solve_alone(std::span<const TurnedShape> bodies, const BodyPair& pair, PairMemory& memory,
                        ContactGeometry& geometry) {
  const TurnedShape &a = bodies[pair.a], &b = bodies[pair.b];
  return superquadric_pair({Vec3::Zero(), a.q, a.semi_axes, a.m}, {pair.d, b.q, b.semi_axes, b.m}, memory,
                           geometry);
}

bool cold(const PairMemory& memory) {
  return memory.normal.squaredNorm() == 0 || memory.surface_a.squaredNorm() == 0;
}

/// Writes what was solved, for the lanes that are done.
void give_back(const Solved& solved, std::span<const BodyPair> pairs, std::span<const std::uint32_t> chosen,
               std::span<PairMemory> memory, std::span<ContactGeometry> geometry,
               std::span<PairOutcome> outcome) {
  std::array<double*, kLanes> rows{};
  std::array<double, 8> nowhere;
  for (std::size_t lane = 0; lane < chosen.size(); ++lane)
    rows[lane] =
        solved.done[lane] != 0 ? memory[pairs[chosen[lane]].memory].surface_a.data() : nowhere.data();
  const LaneTriple &x = solved.x, &y = solved.y, &n = solved.normal;
  lanes::store_columns({x.x, x.y, x.z, y.x, y.y, y.z, n.x, n.y}, rows, chosen.size());
  for (std::size_t lane = 0; lane < chosen.size(); ++lane) {
    if (solved.done[lane] == 0) continue;
    const std::size_t k = chosen[lane];
    const auto at = static_cast<int>(lane);
    memory[pairs[k].memory].normal.z() = n.z[at];
    geometry[k] = {take(solved.point, at), take(n, at), -solved.gap[at]};
    outcome[k] = solved.gap[at] < 0 ? PairOutcome::converged : PairOutcome::separated;
  }
}

}  // namespace

void superquadric_pairs(std::span<const TurnedShape> bodies, std::span<const BodyPair> pairs,
                        std::span<PairMemory> memory, std::span<ContactGeometry> geometry,
                        std::span<PairOutcome> outcome) {
  assert(geometry.size() == pairs.size() && outcome.size() == pairs.size());
  std::array<std::uint32_t, kBlock> warm;
  for (std::size_t begin = 0; begin < pairs.size(); begin += kBlock) {
    const std::size_t end = std::min(pairs.size(), begin + kBlock);
    std::size_t warm_count = 0;
    const auto alone = [&](std::size_t k) {
      outcome[k] = solve_alone(bodies, pairs[k], memory[pairs[k].memory], geometry[k]);
    };
    for (std::size_t k = begin; k < end; ++k) {
      if (cold(memory[pairs[k].memory]))
        alone(k);
      else
        warm[warm_count++] = static_cast<std::uint32_t>(k);
    }
    for (std::size_t i = 0; i < warm_count; i += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, warm_count - i);
      const std::span<const std::uint32_t> chosen(&warm[i], count);
      Gathered g = gather(bodies, pairs, memory, chosen);
      const Solved solved = g.whole ? iterate<newton::LaneWholePower>(g) : iterate<newton::LaneAnyPower>(g);
      give_back(solved, pairs, chosen, memory, geometry, outcome);
      for (std::size_t lane = 0; lane < count; ++lane)
        if (solved.done[lane] == 0) alone(chosen[lane]);
    }
  }
}

}  // namespace sluice
