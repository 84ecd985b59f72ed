#include <algorithm>
#include <cmath>

#include "mpm/explicit_mpm.h"
#include "mpm/spline_weights.h"

namespace sluice {

namespace {
constexpr int most_planes = 6;      ///< that act on one point
constexpr double stand_off = 1e-4;  ///< of a stopped point from its wall [cells]
constexpr int most_path_hits = 3;   ///< a corner of three walls
/// Weight of the visible nodes from which on their mean speaks for the hidden ones; below, gravity fills in.
constexpr double enough_seen = 0.25;

/// Impulse of a hidden node, for its walls. Where two planes lie between, as in a corner, each gets its own
/// normal part; what is left goes to the wall that hides the node.
struct HiddenImpulse {
  Vec3 impulse = Vec3::Zero();  ///< on the walls [N s]
  Vec3 at = Vec3::Zero();       ///< [m]
  int hiding_wall = -1;
};

void share_out(HiddenImpulse hidden, const Vec3& to_node, std::span<const WallPlane> planes,
               WallImpulses& out) {
  int between = 0;
  for (const WallPlane& plane : planes) between += plane.normal.dot(to_node) > plane.distance ? 1 : 0;
  if (between > 1)
    for (const WallPlane& plane : planes) {
      if (plane.normal.dot(to_node) <= plane.distance) continue;
      const Vec3 part = hidden.impulse.dot(plane.normal) * plane.normal;
      out.add(plane.wall, part, hidden.at);
      hidden.impulse -= part;
    }
  out.add(hidden.hiding_wall, hidden.impulse, hidden.at);
}

int tile_index(int local, int node) {
  return (local & 3) + node % 3 + 6 * (((local >> 2) & 3) + node / 3 % 3) + 36 * ((local >> 4) + node / 9);
}
}  // namespace

template <class Real>
void ExplicitMpm<Real>::scatter_near_wall(const Point& p, std::int32_t cell_key, std::int32_t stencil,
                                          Contribution& a, Node* tile, WallImpulses& impulses) const {
  const Vec3i base = layout_.cell_of(cell_key) - Vec3i::Ones();
  const Vec3 x = position(p.x, cell_key);
  Visibility seen;
  field_->visibility(stencil, base, x, seen);
  WallPlane planes[most_planes];
  const int plane_count = field_->planes_of_point(stencil, x, planes, most_planes);
  if (plane_count > 0) a.middle[node_lane::near_wall] = p.mass();

  const SplineWeights<Real> wx(p.x[0]), wy(p.x[1]), wz(p.x[2]);
  const int local = cell_key & 63;
  for (int n = 0; n < 27; ++n) {
    const int i = n % 3, j = n / 3 % 3, k = n / 9;
    const Real w = wx.w[i] * wy.w[j] * wz.w[k];
    Node lanes;
    for (int r = 0; r < Node::registers; ++r)
      lanes.part[r] = a.middle.part[r] + static_cast<Real>(i - 1) * a.slope[0].part[r] +
                      static_cast<Real>(j - 1) * a.slope[1].part[r] +
                      static_cast<Real>(k - 1) * a.slope[2].part[r];
    if (!(seen.hidden >> n & 1)) {
      tile[tile_index(local, n)].add_scaled(w, lanes);
      continue;
    }
    // The wall takes the stress and the weight that the hidden node would have carried.
    Vec3 impulse = step_.dt * static_cast<double>(p.mass()) * gravity_;
    for (int r = 0; r < 3; ++r) impulse[r] += static_cast<double>(lanes[node_lane::change + r]);
    const Vec3 to_node = config_.spacing * (Vec3(wx.d[i], wy.d[j], wz.d[k]) + node_offset);
    const Vec3i node = base + Vec3i(i, j, k);
    share_out({static_cast<double>(w) * impulse, layout_.node_position(node), hiding_wall(seen, n)}, to_node,
              {planes, static_cast<std::size_t>(plane_count)}, impulses);
  }
}

template <class Real>
void ExplicitMpm<Real>::gather_near_wall(const Point& p, std::int32_t cell_key, std::int32_t stencil,
                                         const NodeTile& tile, Gathered& g, WallImpulses& impulses) const {
  using namespace node_lane;
  const Vec3i base = layout_.cell_of(cell_key) - Vec3i::Ones();
  const Vec3 x = position(p.x, cell_key);
  const int local = cell_key & 63;
  Visibility seen;
  field_->visibility(stencil, base, x, seen);
  if (seen.hidden == 0) {
    gather(p, local, tile, g);
    return;
  }

  // All of C is taken anew: nothing damps the rest here, and in a wedge it would feed back through mirrored
  // nodes.
  g.knows_all = true;
  const double h = config_.spacing;
  const SplineWeights<Real> wx(p.x[0]), wy(p.x[1]), wz(p.x[2]);
  Node sum, sum_axis[3];
  sum.clear();
  for (Node& s : sum_axis) s.clear();
  Real weight = 0, weight_moment[3] = {};
  Real least = std::numeric_limits<Real>::max();
  for (int n = 0; n < 27; ++n) {
    if (seen.hidden >> n & 1) continue;
    const int i = n % 3, j = n / 3 % 3, k = n / 9;
    const Real w = wx.w[i] * wy.w[j] * wz.w[k];
    const Real d[3] = {wx.d[i], wy.d[j], wz.d[k]};
    const Node& node = tile.node[tile_index(local, n)];
    sum.add_scaled(w, node);
    for (int c = 0; c < 3; ++c) {
      sum_axis[c].add_scaled(w * d[c], node);
      weight_moment[c] += w * d[c];
    }
    weight += w;
    least = std::min(least, node[fill]);
  }

  // Visible nodes; means of what only they know.
  const Real per_weight = weight > 0 ? 1 / weight : Real(0);
  g.bulk = sum[node_lane::mass];
  g.fill = sum[fill] * per_weight;
  g.dilation = weight > 0 ? sum[dilation] * per_weight : p.dilation();
  g.least_fill = weight > 0 ? least : Real(0);
  const double mean_bulk = static_cast<double>(g.bulk * per_weight);
  Vec3 mean_change = step_.dt * gravity_;
  for (int r = 0; r < 3; ++r) {
    g.change[r] = sum[change + r];
    g.velocity[r] = sum[velocity + r];
    g.pressure[r] = sum[gradient + r] * per_weight;
    g.centre[r] = (sum[centre + r] + weight_moment[r]) * per_weight;
    g.bulk_moment[r] = sum_axis[r][node_lane::mass];
    g.fill_moment[r] = sum_axis[r][fill] - g.fill * weight_moment[r];
    for (int c = 0; c < 3; ++c) g.moment[c][r] = sum_axis[c][change + r] + sum_axis[c][velocity + r];
    const Real trust = std::min(Real(1), weight / Real(enough_seen));
    mean_change[r] = (1 - static_cast<double>(trust)) * mean_change[r] +
                     static_cast<double>(sum[change + r] / std::max(weight, Real(enough_seen)));
  }

  // Hidden nodes: the point's own field, mirrored at the planes between.
  WallPlane planes[most_planes];
  const int plane_count = field_->planes_of_point(stencil, x, planes, most_planes);
  const Vec3 v(p.v[0], p.v[1], p.v[2]);
  Mat3 C;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) C(r, c) = static_cast<double>(p.C[c][r]);
  const double share = static_cast<double>(step_.relax_velocity) * mean_bulk;
  for (int n = 0; n < 27; ++n) {
    if (!(seen.hidden >> n & 1)) continue;
    const int i = n % 3, j = n / 3 % 3, k = n / 9;
    const Vec3 d(wx.d[i], wy.d[j], wz.d[k]);
    const double w = static_cast<double>(wx.w[i] * wy.w[j] * wz.w[k]);
    Vec3 mirrored = h * d;
    int used[most_planes], used_count = 0;
    for (int q = 0; q < plane_count; ++q) {
      const WallPlane& plane = planes[q];
      // Sides are decided where nodes count as being, as in visibility(): a node on the plane has one.
      if (plane.normal.dot(mirrored + h * node_offset) <= plane.distance) continue;
      const double beyond = plane.normal.dot(mirrored) - plane.distance;
      if (p.dilation() >= 0 && v.dot(plane.normal) < 0) continue;  // leaves the wall, nothing holds it
      mirrored -= 2 * beyond * plane.normal;
      used[used_count++] = q;
    }
    Vec3 ghost = v + C * mirrored, ghost_change = mean_change;
    for (int q = used_count - 1; q >= 0; --q) {
      const WallPlane& plane = planes[used[q]];
      // Friction is in the nodes' changes already, so those are mirrored as without it; shear goes on through
      // the wall.
      ghost_change -= 2 * ghost_change.dot(plane.normal) * plane.normal;
      if (config_.wall_slip == WallSlip::no_slip)
        ghost = 2 * field_->surface_velocity(plane.wall, x + plane.distance * plane.normal) - ghost;
      else
        ghost -= 2 * ghost.dot(plane.normal) * plane.normal;
    }
    for (int r = 0; r < 3; ++r) {
      const double whole = ghost_change[r] + mean_bulk * ghost[r];
      g.change[r] += static_cast<Real>(w * ghost_change[r]);
      g.velocity[r] += static_cast<Real>(w * mean_bulk * ghost[r]);
      g.bulk_moment[r] += static_cast<Real>(w * mean_bulk * d[r]);
      for (int c = 0; c < 3; ++c) g.moment[c][r] += static_cast<Real>(w * whole * d[c]);
    }
    g.bulk += static_cast<Real>(w * mean_bulk);
    const Vec3 given = ghost_change + share * (ghost - v - h * (C * d));
    const Vec3i node = base + Vec3i(i, j, k);
    share_out({-static_cast<double>(p.mass()) * w * given, layout_.node_position(node), hiding_wall(seen, n)},
              h * (d + node_offset), {planes, static_cast<std::size_t>(plane_count)}, impulses);
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

template void ExplicitMpm<float>::scatter_near_wall(const Point&, std::int32_t, std::int32_t, Contribution&,
                                                    Node*, WallImpulses&) const;
template void ExplicitMpm<float>::gather_near_wall(const Point&, std::int32_t, std::int32_t, const NodeTile&,
                                                   Gathered&, WallImpulses&) const;
template void ExplicitMpm<float>::stop_at_walls(Point&, const Place&, std::int32_t, std::int32_t,
                                                WallImpulses&) const;
template void ExplicitMpm<double>::scatter_near_wall(const Point&, std::int32_t, std::int32_t, Contribution&,
                                                     Node*, WallImpulses&) const;
template void ExplicitMpm<double>::gather_near_wall(const Point&, std::int32_t, std::int32_t, const NodeTile&,
                                                    Gathered&, WallImpulses&) const;
template void ExplicitMpm<double>::stop_at_walls(Point&, const Place&, std::int32_t, std::int32_t,
                                                 WallImpulses&) const;

}  // namespace sluice
