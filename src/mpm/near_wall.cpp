#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mpm/explicit_mpm.h"
#include "mpm/hidden_nodes.h"
#include "mpm/spline_sums.h"
#include "mpm/wall_stencils.h"

namespace sluice {

namespace {
constexpr double stand_off = 1e-4;        ///< of a stopped point from its wall [cells]
constexpr int most_path_hits = 3;         ///< a corner of three walls
constexpr double narrowest_gap = 0.1;     ///< between walls in which water has a way of its own [cells]
constexpr double face_each_other = -0.9;  ///< cosine between their normals
constexpr int most_bodies = 16;           ///< within reach of a point
/// Weight of the visible nodes from which on their mean speaks for the hidden ones; below, gravity fills in.
/// Water in bulk has pressure that holds it against gravity, also in a corner that hides most nodes.
constexpr double enough_seen_of_spray = 0.25, enough_seen_of_bulk = 0.02;

/// Gives walls the impulse w (constant + slope d) of each hidden node. Where two planes lie between, as in a
/// corner, each gets its own normal part; what is left goes to the wall that hides the nodes. A ball that
/// water slips past is pushed at its centre: nothing turns it but the friction of a film, and the nodes lie
/// beside the line from its centre to where it was touched.
/// @param slips  water does, past all bodies
void share_out(const Surroundings& around, const HiddenNodes& hidden, const Vec3& constant, const Mat3& slope,
               const WallPoses& poses, bool slips, WallImpulses& out) {
  Vec3 impulse = hidden.w * constant + slope * hidden.d();
  // Sum of x_node impulse^T, from which any part's angular impulse follows.
  Mat3 first = around.x * impulse.transpose();
  first += around.h * (hidden.d() * constant.transpose() + hidden.dd() * slope.transpose());
  const auto turning = [](const Mat3& m) {
    return Vec3(m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0));
  };
  const auto give = [&](int wall, const Vec3& part, const Mat3& part_first) {
    if (slips && poses.is_ball(wall))
      out.add(wall, part, poses.centre(wall));
    else
      out.add_turning(wall, part, turning(part_first));
  };
  if (std::popcount(hidden.between) > 1)
    for (int q = 0; q < around.plane_count; ++q) {
      if (!(hidden.between >> q & 1)) continue;
      const WallPlane& plane = around.planes[q];
      const Vec3 part = impulse.dot(plane.normal) * plane.normal;
      const Mat3 part_first = (first * plane.normal) * plane.normal.transpose();
      give(plane.wall, part, part_first);
      impulse -= part;
      first -= part_first;
    }
  give(hidden.wall, impulse, first);
}

/// Two walls that face each other and leave less than `narrowest_gap`.
std::optional<std::pair<WallPlane, WallPlane>> narrow_gap(const Surroundings& around) {
  for (int q = 1; q < around.plane_count; ++q)
    for (int r = 0; r < q; ++r)
      if (around.planes[q].normal.dot(around.planes[r].normal) < face_each_other &&
          around.planes[q].distance + around.planes[r].distance < narrowest_gap * around.h)
        return std::pair{around.planes[r], around.planes[q]};
  return std::nullopt;
}

template <class Triple>
Vec3 offset_of(const Triple& x) {
  return {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])};
}
}  // namespace

/// Takes from a point's contribution what walls hide: they get the stress and the weight that the hidden
/// nodes would have carried. Returns true where no wall is before the point because it ends before it.
template <class Real>
bool ExplicitMpm<Real>::hide_nodes(const Point& p, std::int32_t cell_key, std::int32_t stencil,
                                   Contribution& a, WallImpulses& impulses) const {
  const WallRecord record = record_of(stencil);
  const WallField& field = *record.field;
  Surroundings around{.field = field, .h = config_.spacing, .x = position(p.x, cell_key)};
  field.visibility(record.stencil, layout_.cell_of(cell_key) - Vec3i::Ones(), around.x, around.seen);
  const int needed = around.seen.hidden != 0 ? most_planes : 1;
  around.plane_count = field.planes_of_point(record.stencil, around.x, around.planes, needed);
  if (around.plane_count > 0) a.middle[node_lane::near_wall] = p.mass();
  const bool beyond_edge = around.plane_count == 0 && field.beyond_edge(record.stencil, around.x);
  if (around.seen.hidden == 0) return beyond_edge;

  HiddenGroups groups;
  group_hidden(around, offset_of(p.x), 0, groups);
  const Vec3 weight = step_.dt * static_cast<double>(p.mass()) * gravity_;
  Mat3 stress;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) stress(r, c) = static_cast<double>(a.slope[c][node_lane::change + r]);
  const bool slips = config_.wall_slip != WallSlip::no_slip;
  for (const HiddenNodes& hidden : groups.all())
    share_out(around, hidden, weight, stress, poses_, slips, impulses);
  for (std::uint32_t left = around.seen.hidden; left != 0; left &= left - 1) {
    const int n = std::countr_zero(left);
    a.weight[n / 3][n % 3] = 0;
  }
  return beyond_edge;
}

template <class Real>
void ExplicitMpm<Real>::gather_near_wall(const Point& p, const Vector& misfit, std::int32_t cell_key,
                                         std::int32_t stencil, const NodeTile& tile, Gathered& g,
                                         WallImpulses& impulses) const {
  using namespace node_lane;
  const int local = cell_key & 63;
  const WallRecord record = record_of(stencil);
  const WallField& field = *record.field;
  Surroundings around{.field = field, .h = config_.spacing, .x = position(p.x, cell_key)};
  field.visibility(record.stencil, layout_.cell_of(cell_key) - Vec3i::Ones(), around.x, around.seen);
  g.in_gap = false;
  if (around.seen.hidden == 0) {
    gather(p, local, tile, g);
    return;
  }

  around.plane_count = field.planes_of_point(record.stencil, around.x, around.planes, most_planes);
  g.in_gap = narrow_gap(around).has_value();
  const Vec3 v = velocity_of(p);
  std::uint32_t holds = 0;
  Vec3 wall_velocity[most_planes], wall_change[most_planes];
  for (int q = 0; q < around.plane_count; ++q) {
    const WallPlane& plane = around.planes[q];
    const Vec3 contact = around.x + plane.distance * plane.normal;
    wall_change[q] = poses_.change(plane.wall, contact);
    wall_velocity[q] = poses_.velocity(plane.wall, contact) - wall_change[q];  // as the point's own: before
    if (p.dilation() < 0 || (v - wall_velocity[q]).dot(plane.normal) >= 0)     // what leaves, nothing holds
      holds |= 1U << q;
  }
  HiddenGroups groups;
  group_hidden(around, offset_of(p.x), holds, groups);

  // Visible nodes; the lane of the mass is lent to the weight.
  const int corner = (local & 3) + 6 * ((local >> 2) & 3) + 36 * (local >> 4);
  Node kept, lent;
  for (auto& part : kept.part) part = typename Node::Register{} + Real(1);
  kept[node_lane::near_wall] = 0;
  lent.clear();
  lent[node_lane::near_wall] = 1;
  Node visible[27];
  Vector blend[27];
  Real least = std::numeric_limits<Real>::max();
  const SplineWeights<Real> x(p.x[0]), y(p.x[1]), z(p.x[2]);
  g.pull = 0;
  for (int n = 0; n < 27; ++n) {
    const int index = corner + n % 3 + 6 * (n / 3 % 3) + 36 * (n / 9);
    const Node& node = tile.node[index];
    const bool hidden = (around.seen.hidden >> n & 1) != 0;
    const Real shows = hidden ? Real(0) : Real(1);
    for (int r = 0; r < Node::registers; ++r)
      visible[n].part[r] = shows * (node.part[r] * kept.part[r] + lent.part[r]);
    blend[n] = shows * tile.blend[index];
    if (!hidden) g.pull += x.w[n % 3] * y.w[n / 3 % 3] * z.w[n / 9] * node[node_lane::near_wall];
    if (!hidden) least = std::min(least, node[fill]);
  }
  Node sum;
  typename Node::Half moment[3];
  spline_sums<3, 9>(visible, p.x, sum, moment);

  // Means of what only they know. All of C is taken anew: nothing damps the rest here, and in a wedge it
  // would feed back through mirrored nodes.
  g.knows_all = true;
  g.beside_wall = true;
  const bool sees = around.seen.hidden != all_nodes;
  const Real weight = sees ? sum[node_lane::near_wall] : Real(0);
  const Real per_weight = weight > 0 ? 1 / weight : Real(0);
  g.bulk = sum[node_lane::mass];
  g.fill = sum[fill] * per_weight;
  g.dilation = weight > 0 ? sum[dilation] * per_weight : p.dilation();
  g.least_fill = weight > 0 ? least : Real(0);
  g.change = sum.quad(1);
  g.pressure = sum.quad(3) * per_weight;
  g.centre = sum.quad(2) * per_weight;
  const double mean_bulk = static_cast<double>(g.bulk * per_weight);
  const double enough_seen = enough_seen_of_spray + mean_bulk * (enough_seen_of_bulk - enough_seen_of_spray);
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
    mean_change[c] +=
        static_cast<double>(sum[change + c]) / std::max(static_cast<double>(weight), enough_seen);
  }
  g.velocity = sum.quad(0);
  g.blend = spline_sum_of_quads<3, 9>(blend, p.x, g.blend_moment);

  // Hidden nodes: the point's own field, mirrored at the planes between.
  const double h = config_.spacing;
  Mat3 C;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) C(r, c) = static_cast<double>(p.C[c][r]);
  // As the visible nodes pull in the mean: by velocity, and by misfits, whose mirror image is the point's
  // own.
  const double pull = mean_bulk * static_cast<double>(g.bulk > 0 ? g.pull / g.bulk : Real(1));
  const double by_velocity = pull * static_cast<double>(g.pull > 0 ? g.blend[3] / g.pull : Real(1));
  const double relax = static_cast<double>(step_.relax_velocity);
  const Vec3 own_misfit(misfit[0], misfit[1], misfit[2]);
  for (const HiddenNodes& hidden : groups.all()) {
    Vec3 at = Vec3::Zero();                // mirrored node, constant
    Mat3 at_slope = h * Mat3::Identity();  // and per d
    for (int q = 0; q < around.plane_count; ++q) {
      if (!(hidden.mirrors >> q & 1)) continue;
      const WallPlane& plane = around.planes[q];
      at -= 2 * (at.dot(plane.normal) - plane.distance) * plane.normal;
      at_slope -= 2 * plane.normal * (plane.normal.transpose() * at_slope);
    }
    Vec3 ghost = v + C * at, ghost_change = mean_change, ghost_misfit = own_misfit;
    Mat3 ghost_slope = C * at_slope;
    for (int q = around.plane_count - 1; q >= 0; --q) {
      if (!(hidden.mirrors >> q & 1)) continue;
      const WallPlane& plane = around.planes[q];
      // Friction is in the nodes' changes already, so those are mirrored as without it; shear goes on through
      // the wall.
      ghost_change -= 2 * (ghost_change - wall_change[q]).dot(plane.normal) * plane.normal;
      if (config_.wall_slip == WallSlip::no_slip) {
        const Vec3 contact = around.x + plane.distance * plane.normal;
        ghost = 2 * (poses_.surface_velocity(plane.wall, contact) - wall_change[q]) - ghost;
        ghost_slope = -ghost_slope;
      } else {
        ghost -= 2 * (ghost - wall_velocity[q]).dot(plane.normal) * plane.normal;
        ghost_slope -= 2 * plane.normal * (plane.normal.transpose() * ghost_slope);
      }
      if (config_.wall_slip == WallSlip::slip)
        ghost_misfit -= 2 * ghost_misfit.dot(plane.normal) * plane.normal;
      else  // the wall rubs
        ghost_misfit = -ghost_misfit;
    }
    const Vec3 whole = ghost_change + mean_bulk * ghost;
    const Vec3 ghost_sum = hidden.w * ghost + ghost_slope * hidden.d();
    const Vec3 blend_sum = by_velocity * ghost_sum - (pull - by_velocity) * hidden.w * ghost_misfit;
    const Mat3 moments = whole * hidden.d().transpose() + mean_bulk * ghost_slope * hidden.dd();
    for (int r = 0; r < 3; ++r) {
      g.change[r] += static_cast<Real>(hidden.w * ghost_change[r]);
      g.velocity[r] += static_cast<Real>(mean_bulk * ghost_sum[r]);
      g.blend[r] += static_cast<Real>(blend_sum[r]);
      g.bulk_moment[r] += static_cast<Real>(mean_bulk * hidden.first[r]);
      g.blend_moment[r] += static_cast<Real>(by_velocity * hidden.first[r]);
      for (int c = 0; c < 3; ++c) g.moment[c][r] += static_cast<Real>(moments(r, c));
    }
    g.bulk += static_cast<Real>(hidden.w * mean_bulk);
    g.pull += static_cast<Real>(pull * hidden.w);
    g.blend[3] += static_cast<Real>(by_velocity * hidden.w);
    const double m = static_cast<double>(p.mass());
    const Vec3 pulled = by_velocity * (ghost - v) + (pull - by_velocity) * (own_misfit - ghost_misfit);
    share_out(around, hidden, -m * (ghost_change + relax * pulled),
              -m * relax * by_velocity * (ghost_slope - h * C), poses_,
              config_.wall_slip != WallSlip::no_slip, impulses);
  }
}

/// Where a path enters a body, in the body's own frame. A place within is on its surface at once.
template <class Real>
std::optional<WallHit> ExplicitMpm<Real>::hit_of_body(int body, const Vec3& from, const Vec3& to) const {
  const RoundBody& shape = poses_.round()[static_cast<std::size_t>(poses_.round_of(body))];
  const Vec3 end = poses_.to_rest_at_end(body, to);
  if (end.squaredNorm() >= shape.reach * shape.reach || shape.gauge(end) >= 1) return std::nullopt;
  const Vec3 start = shape.pose.to_rest(from);
  WallHit hit;
  Vec3 at = end;
  if (shape.gauge(start) >= 1) {  // the last place outside, by bisection
    double outside = 0, inside = 1;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (outside + inside);
      (shape.gauge(start + middle * (end - start)) >= 1 ? outside : inside) = middle;
    }
    hit.s = outside;
    at = start + outside * (end - start);
  }
  at = shape.on_surface(at);
  hit.point = poses_.from_rest_at_end(body, at);
  hit.normal = poses_.turned_from_rest_at_end(body, shape.gauge_gradient(at).normalized());
  hit.wall = shape.wall;
  return hit;
}

/// Where a path meets a wall first. A wall that moves is met in its own frame; the place and the normal are
/// those at the end of the step.
template <class Real>
std::optional<WallHit> ExplicitMpm<Real>::first_hit(std::int32_t stencil, const Vec3& from,
                                                    const Vec3& to) const {
  const WallRecord record = record_of(stencil);
  if (stencil < first_moving) return record.field->first_hit(record.stencil, from, to);
  std::optional<WallHit> first;
  std::array<int, most_bodies> bodies;
  const int count = record.field->bodies_near(record.stencil, bodies.data(), most_bodies);
  for (const int body : std::span(bodies).first(static_cast<std::size_t>(count))) {
    if (poses_.round_of(body) >= 0) {
      const std::optional<WallHit> entry = hit_of_body(body, from, to);
      if (entry && (!first || entry->s < first->s)) first = entry;
      continue;
    }
    const Vec3 end = body < 0 ? to : poses_.to_start(body, to);
    std::optional<WallHit> hit = record.field->first_hit(record.stencil, from, end, body);
    if (!hit || (first && first->s <= hit->s)) continue;
    if (body >= 0) {
      hit->point = poses_.to_end(body, hit->point);
      hit->normal = poses_.turned_to_end(body, hit->normal);
    }
    first = hit;
  }
  return first;
}

/// Water between two walls that all but touch sticks to both, without pressure: cells do not see where it
/// could go, and what its nodes tell it comes from water outside. Half of what it gives up goes to each.
template <class Real>
void ExplicitMpm<Real>::carry_in_gap(Point& p, BriefVector<Real>& misfit, Vector& moved,
                                     std::int32_t cell_key, std::int32_t stencil,
                                     WallImpulses& impulses) const {
  const WallRecord record = record_of(stencil);
  Surroundings around{.field = *record.field, .h = config_.spacing, .x = position(p.x, cell_key)};
  around.plane_count = around.field.planes_of_point(record.stencil, around.x, around.planes, most_planes);
  const auto gap = narrow_gap(around);
  if (!gap) return;
  const auto contact = [&](const WallPlane& plane) { return Vec3(around.x + plane.distance * plane.normal); };
  const WallPlane &a = gap->first, &b = gap->second;
  const Vec3 v = velocity_of(p);
  const Vec3 walls =
      0.5 * (poses_.surface_velocity(a.wall, contact(a)) + poses_.surface_velocity(b.wall, contact(b)));
  const Vec3 change = static_cast<double>(step_.relax_velocity) * (walls - v);
  const Vec3 given = -0.5 * static_cast<double>(p.mass()) * change;
  impulses.add(a.wall, given, contact(a));
  impulses.add(b.wall, given, contact(b));
  for (int r = 0; r < 3; ++r) {
    p.v[r] = static_cast<Real>(v[r] + change[r]);
    for (int c = 0; c < 3; ++c) p.C[c][r] = 0;
  }
  misfit = {};
  moved = step_.cells_per_speed * p.v;
  moved[3] = 0;
  p.x[3] = 0;
}

/// No path crosses a wall: the point stops at the first one that its path meets.
template <class Real>
void ExplicitMpm<Real>::stop_at_walls(Point& p, const Place& before, std::int32_t cell_key,
                                      std::int32_t stencil, WallImpulses& impulses) const {
  const double h = config_.spacing;
  const Vec3 start = position(before, cell_key);
  const Vec3 corner = layout_.node_position(layout_.cell_of(cell_key));
  for (int hits = 0; hits <= most_path_hits; ++hits) {
    const auto hit = first_hit(stencil, start, position(p.x, cell_key));
    if (!hit) return;
    if (hits == most_path_hits) break;
    const Vec3 v(p.v[0], p.v[1], p.v[2]);
    const double inward = (v - poses_.velocity(hit->wall, hit->point)).dot(hit->normal);
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

template bool ExplicitMpm<float>::hide_nodes(const Point&, std::int32_t, std::int32_t, Contribution&,
                                             WallImpulses&) const;
template void ExplicitMpm<float>::gather_near_wall(const Point&, const Vector&, std::int32_t, std::int32_t,
                                                   const NodeTile&, Gathered&, WallImpulses&) const;
template void ExplicitMpm<float>::carry_in_gap(Point&, BriefVector<float>&, Vector&, std::int32_t,
                                               std::int32_t, WallImpulses&) const;
template void ExplicitMpm<float>::stop_at_walls(Point&, const Place&, std::int32_t, std::int32_t,
                                                WallImpulses&) const;
template bool ExplicitMpm<double>::hide_nodes(const Point&, std::int32_t, std::int32_t, Contribution&,
                                              WallImpulses&) const;
template void ExplicitMpm<double>::gather_near_wall(const Point&, const Vector&, std::int32_t, std::int32_t,
                                                    const NodeTile&, Gathered&, WallImpulses&) const;
template void ExplicitMpm<double>::carry_in_gap(Point&, BriefVector<double>&, Vector&, std::int32_t,
                                                std::int32_t, WallImpulses&) const;
template void ExplicitMpm<double>::stop_at_walls(Point&, const Place&, std::int32_t, std::int32_t,
                                                 WallImpulses&) const;

}  // namespace sluice
