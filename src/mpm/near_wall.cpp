#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "mpm/explicit_mpm.h"
#include "mpm/spline_sums.h"
#include "mpm/wall_stencils.h"

namespace sluice {

namespace {
constexpr int most_planes = 6;      ///< that act on one point
constexpr double stand_off = 1e-4;  ///< of a stopped point from its wall [cells]
constexpr int most_path_hits = 3;   ///< a corner of three walls
/// Weight of the visible nodes from which on their mean speaks for the hidden ones; below, gravity fills in.
constexpr double enough_seen = 0.25;

/// Hidden nodes that the same walls hide from a point in the same way, as one: whatever is linear in their
/// distance d from the point needs only the moments of their weights.
struct HiddenNodes {
  std::uint32_t mirrors;  ///< bits of the planes at which the point's field is mirrored
  std::uint32_t between;  ///< bits of the planes between the point and them
  int wall;               ///< that hides them
  double w;               ///< sum of the weights
  double first[3];        ///< sum w d [cells]
  double second[6];       ///< sum w d d^T as xx yy zz yz xz xy [cells2]

  Vec3 d() const { return {first[0], first[1], first[2]}; }
  Mat3 dd() const {
    Mat3 m;
    m << second[0], second[5], second[4], second[5], second[1], second[3], second[4], second[3], second[2];
    return m;
  }
};

struct HiddenGroups {
  HiddenNodes group[27];  ///< of which `count` are written
  int count;
  HiddenGroups() : count(0) {}
  std::span<const HiddenNodes> all() const { return {group, static_cast<std::size_t>(count)}; }

  HiddenNodes& of(std::uint32_t mirrors, std::uint32_t between, int wall) {
    for (int n = 0; n < count; ++n)
      if (group[n].mirrors == mirrors && group[n].between == between && group[n].wall == wall)
        return group[n];
    group[count] = {mirrors, between, wall, 0, {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
    return group[count++];
  }
};

/// What stands around a point near walls.
struct Surroundings {
  const WallField& field;
  double h = 0;
  Vec3 x = Vec3::Zero();  ///< of the point [m]
  Visibility seen{};
  WallPlane planes[most_planes]{};
  int plane_count = 0;
};

/// @param holds  bits of the planes that hold the point: it does not leave them freely
template <class Real>
void group_hidden(const Surroundings& around, const MaterialPoint<Real>& p, std::uint32_t holds,
                  HiddenGroups& out) {
  const double h = around.h;
  const SplineWeights<Real> axis[3] = {SplineWeights<Real>(p.x[0]), SplineWeights<Real>(p.x[1]),
                                       SplineWeights<Real>(p.x[2])};
  for (std::uint32_t left = around.seen.hidden; left != 0; left &= left - 1) {
    const int n = std::countr_zero(left), i = n % 3, j = n / 3 % 3, k = n / 9;
    const Vec3 d(static_cast<double>(axis[0].d[i]), static_cast<double>(axis[1].d[j]),
                 static_cast<double>(axis[2].d[k]));
    // Sides are decided where nodes count as being, as in visibility(): a node on the plane has one.
    const Vec3 at = h * (d + node_offset);
    Vec3 mirrored = at;
    std::uint32_t mirrors = 0, between = 0;
    for (int q = 0; q < around.plane_count; ++q) {
      const WallPlane& plane = around.planes[q];
      if (plane.normal.dot(at) > plane.distance) between |= 1U << q;
      if (!(holds >> q & 1) || plane.normal.dot(mirrored) <= plane.distance) continue;
      mirrors |= 1U << q;
      if (q + 1 < around.plane_count)
        mirrored -= 2 * (plane.normal.dot(mirrored - h * node_offset) - plane.distance) * plane.normal;
    }
    HiddenNodes& hidden =
        out.of(mirrors, between, around.field.patch_wall(around.seen.patch[static_cast<std::size_t>(n)]));
    const double w = static_cast<double>(axis[0].w[i] * axis[1].w[j] * axis[2].w[k]);
    const double wx = w * d[0], wy = w * d[1], wz = w * d[2];
    hidden.w += w;
    hidden.first[0] += wx;
    hidden.first[1] += wy;
    hidden.first[2] += wz;
    hidden.second[0] += wx * d[0];
    hidden.second[1] += wy * d[1];
    hidden.second[2] += wz * d[2];
    hidden.second[3] += wy * d[2];
    hidden.second[4] += wx * d[2];
    hidden.second[5] += wx * d[1];
  }
}

/// Gives walls the impulse w (constant + slope d) of each hidden node. Where two planes lie between, as in a
/// corner, each gets its own normal part; what is left goes to the wall that hides the nodes.
void share_out(const Surroundings& around, const HiddenNodes& hidden, const Vec3& constant, const Mat3& slope,
               WallImpulses& out) {
  Vec3 impulse = hidden.w * constant + slope * hidden.d();
  // Sum of x_node impulse^T, from which any part's angular impulse follows.
  Mat3 first = around.x * impulse.transpose();
  first += around.h * (hidden.d() * constant.transpose() + hidden.dd() * slope.transpose());
  const auto turning = [](const Mat3& m) {
    return Vec3(m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0));
  };
  if (std::popcount(hidden.between) > 1)
    for (int q = 0; q < around.plane_count; ++q) {
      if (!(hidden.between >> q & 1)) continue;
      const WallPlane& plane = around.planes[q];
      const Vec3 part = impulse.dot(plane.normal) * plane.normal;
      const Mat3 part_first = (first * plane.normal) * plane.normal.transpose();
      out.add_turning(plane.wall, part, turning(part_first));
      impulse -= part;
      first -= part_first;
    }
  out.add_turning(hidden.wall, impulse, turning(first));
}
}  // namespace

/// Takes from a point's contribution what walls hide: they get the stress and the weight that the hidden
/// nodes would have carried.
template <class Real>
void ExplicitMpm<Real>::hide_nodes(const Point& p, std::int32_t cell_key, std::int32_t stencil,
                                   Contribution& a, WallImpulses& impulses) const {
  Surroundings around{.field = *field_, .h = config_.spacing, .x = position(p.x, cell_key)};
  field_->visibility(stencil, layout_.cell_of(cell_key) - Vec3i::Ones(), around.x, around.seen);
  const int needed = around.seen.hidden != 0 ? most_planes : 1;
  around.plane_count = field_->planes_of_point(stencil, around.x, around.planes, needed);
  if (around.plane_count > 0) a.middle[node_lane::near_wall] = p.mass();
  if (around.seen.hidden == 0) return;

  HiddenGroups groups;
  group_hidden(around, p, 0, groups);
  const Vec3 weight = step_.dt * static_cast<double>(p.mass()) * gravity_;
  Mat3 stress;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) stress(r, c) = static_cast<double>(a.slope[c][node_lane::change + r]);
  for (const HiddenNodes& hidden : groups.all()) share_out(around, hidden, weight, stress, impulses);
  for (std::uint32_t left = around.seen.hidden; left != 0; left &= left - 1) {
    const int n = std::countr_zero(left);
    a.weight[n / 3][n % 3] = 0;
  }
}

template <class Real>
void ExplicitMpm<Real>::gather_near_wall(const Point& p, std::int32_t cell_key, std::int32_t stencil,
                                         const NodeTile& tile, Gathered& g, WallImpulses& impulses) const {
  using namespace node_lane;
  const int local = cell_key & 63;
  Surroundings around{.field = *field_, .h = config_.spacing, .x = position(p.x, cell_key)};
  field_->visibility(stencil, layout_.cell_of(cell_key) - Vec3i::Ones(), around.x, around.seen);
  if (around.seen.hidden == 0) {
    gather(p, local, tile, g);
    return;
  }

  around.plane_count = field_->planes_of_point(stencil, around.x, around.planes, most_planes);
  const Vec3 v = velocity_of(p);
  std::uint32_t holds = 0;
  for (int q = 0; q < around.plane_count; ++q)  // what leaves a wall, nothing holds
    if (p.dilation() < 0 || v.dot(around.planes[q].normal) >= 0) holds |= 1U << q;
  HiddenGroups groups;
  group_hidden(around, p, holds, groups);

  // Visible nodes; the lane of the mass is lent to the weight.
  const Node* corner = tile.node + (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
  Node visible[27];
  Real least = std::numeric_limits<Real>::max();
  for (int n = 0; n < 27; ++n) {
    if (around.seen.hidden >> n & 1) {
      visible[n].clear();
      continue;
    }
    visible[n] = corner[n % 3 + 6 * (n / 3 % 3) + 36 * (n / 9)];
    visible[n][node_lane::near_wall] = 1;
    least = std::min(least, visible[n][fill]);
  }
  Node sum;
  typename Node::Half moment[3];
  spline_sums<3, 9>(visible, p.x, sum, moment);

  // Means of what only they know. All of C is taken anew: nothing damps the rest here, and in a wedge it
  // would feed back through mirrored nodes.
  g.knows_all = true;
  const bool sees = around.seen.hidden != all_nodes;
  const Real weight = sees ? sum[node_lane::near_wall] : Real(0);
  const Real per_weight = weight > 0 ? 1 / weight : Real(0);
  g.bulk = sum[node_lane::mass];
  g.fill = sum[fill] * per_weight;
  g.dilation = weight > 0 ? sum[dilation] * per_weight : p.dilation();
  g.least_fill = weight > 0 ? least : Real(0);
  g.change = sum.quad(1);
  g.velocity = sum.quad(0);
  g.pressure = sum.quad(3) * per_weight;
  g.centre = sum.quad(2) * per_weight;
  const double mean_bulk = static_cast<double>(g.bulk * per_weight);
  const double trust = std::min(1.0, static_cast<double>(weight) / enough_seen);
  Vec3 mean_change = (1 - trust) * step_.dt * gravity_;
  for (int c = 0; c < 3; ++c) {
    double hidden_moment = 0;  // of all nodes it is zero
    for (const HiddenNodes& hidden : groups.all()) hidden_moment += hidden.first[c];
    const Real weight_moment = static_cast<Real>(-hidden_moment);
    g.centre[c] += weight_moment * per_weight;
    g.bulk_moment[c] = moment[c][node_lane::mass];
    g.fill_moment[c] = moment[c][fill] - g.fill * weight_moment;
    g.moment[c] = sum_of_quads<Real>(moment[c]);
    mean_change[c] += static_cast<double>(sum[change + c] / std::max(weight, Real(enough_seen)));
  }

  // Hidden nodes: the point's own field, mirrored at the planes between.
  const double h = config_.spacing;
  Mat3 C;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) C(r, c) = static_cast<double>(p.C[c][r]);
  const double share = static_cast<double>(step_.relax_velocity) * mean_bulk;
  for (const HiddenNodes& hidden : groups.all()) {
    Vec3 at = Vec3::Zero();                // mirrored node, constant
    Mat3 at_slope = h * Mat3::Identity();  // and per d
    for (int q = 0; q < around.plane_count; ++q) {
      if (!(hidden.mirrors >> q & 1)) continue;
      const WallPlane& plane = around.planes[q];
      at -= 2 * (at.dot(plane.normal) - plane.distance) * plane.normal;
      at_slope -= 2 * plane.normal * (plane.normal.transpose() * at_slope);
    }
    Vec3 ghost = v + C * at, ghost_change = mean_change;
    Mat3 ghost_slope = C * at_slope;
    for (int q = around.plane_count - 1; q >= 0; --q) {
      if (!(hidden.mirrors >> q & 1)) continue;
      const WallPlane& plane = around.planes[q];
      // Friction is in the nodes' changes already, so those are mirrored as without it; shear goes on through
      // the wall.
      ghost_change -= 2 * ghost_change.dot(plane.normal) * plane.normal;
      if (config_.wall_slip == WallSlip::no_slip) {
        ghost = 2 * field_->surface_velocity(plane.wall, around.x + plane.distance * plane.normal) - ghost;
        ghost_slope = -ghost_slope;
      } else {
        ghost -= 2 * ghost.dot(plane.normal) * plane.normal;
        ghost_slope -= 2 * plane.normal * (plane.normal.transpose() * ghost_slope);
      }
    }
    const Vec3 whole = ghost_change + mean_bulk * ghost;
    const Vec3 velocity_sum = mean_bulk * (hidden.w * ghost + ghost_slope * hidden.d());
    const Mat3 moments = whole * hidden.d().transpose() + mean_bulk * ghost_slope * hidden.dd();
    for (int r = 0; r < 3; ++r) {
      g.change[r] += static_cast<Real>(hidden.w * ghost_change[r]);
      g.velocity[r] += static_cast<Real>(velocity_sum[r]);
      g.bulk_moment[r] += static_cast<Real>(mean_bulk * hidden.first[r]);
      for (int c = 0; c < 3; ++c) g.moment[c][r] += static_cast<Real>(moments(r, c));
    }
    g.bulk += static_cast<Real>(hidden.w * mean_bulk);
    const double m = static_cast<double>(p.mass());
    share_out(around, hidden, -m * (ghost_change + share * (ghost - v)), -m * share * (ghost_slope - h * C),
              impulses);
  }
}

/// No path crosses a wall: the point stops at the first one that its path meets.
template <class Real>
void ExplicitMpm<Real>::stop_at_walls(Point& p, const Place& before, std::int32_t cell_key,
                                      std::int32_t stencil, WallImpulses& impulses) const {
  const double h = config_.spacing;
  const Vec3 start = position(before, cell_key);
  const Vec3 corner = layout_.node_position(layout_.cell_of(cell_key));
  for (int hits = 0; hits <= most_path_hits; ++hits) {
    const auto hit = field_->first_hit(stencil, start, position(p.x, cell_key));
    if (!hit) return;
    if (hits == most_path_hits) break;
    const Vec3 v(p.v[0], p.v[1], p.v[2]);
    const double inward = v.dot(hit->normal);
    if (inward < 0) {
      for (int r = 0; r < 3; ++r) p.v[r] -= static_cast<Real>(inward * hit->normal[r]);
      impulses.add(hit->wall, static_cast<double>(p.mass()) * inward * hit->normal, hit->point);
      impulses.add_impact(hit->wall, 0.5 * static_cast<double>(p.mass()) * inward * inward);
    }
    const Vec3 stopped = (hit->point + stand_off * h * hit->normal - corner) / h;
    for (int r = 0; r < 3; ++r) p.x[r] = quantised(static_cast<Real>(stopped[r]));
  }
  for (int r = 0; r < 3; ++r) p.x[r] = before[static_cast<std::size_t>(r)];
}

template void ExplicitMpm<float>::hide_nodes(const Point&, std::int32_t, std::int32_t, Contribution&,
                                             WallImpulses&) const;
template void ExplicitMpm<float>::gather_near_wall(const Point&, std::int32_t, std::int32_t, const NodeTile&,
                                                   Gathered&, WallImpulses&) const;
template void ExplicitMpm<float>::stop_at_walls(Point&, const Place&, std::int32_t, std::int32_t,
                                                WallImpulses&) const;
template void ExplicitMpm<double>::hide_nodes(const Point&, std::int32_t, std::int32_t, Contribution&,
                                              WallImpulses&) const;
template void ExplicitMpm<double>::gather_near_wall(const Point&, std::int32_t, std::int32_t, const NodeTile&,
                                                    Gathered&, WallImpulses&) const;
template void ExplicitMpm<double>::stop_at_walls(Point&, const Place&, std::int32_t, std::int32_t,
                                                 WallImpulses&) const;

}  // namespace sluice
