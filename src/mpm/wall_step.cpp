#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "mpm/explicit_mpm.h"
#include "mpm/spline_weights.h"

namespace sluice {

namespace {
/// Fill over which a node turns from spray (own velocities) to bulk (shared velocity).
constexpr double spray_below = 0.1, bulk_above = 0.3;
/// Fill over which water gets time: under pressure it ceases to be stopped by walls at once, for its pressure
/// stops it too, and where it accelerates its nodes' pull is eased.
constexpr double eased_above = 0.6, eased_wholly = 0.9;
/// Acceleration at which a full node's pull on its points is halved [c2 / h]: it takes a pressure that
/// compresses the water by this much from one node to the next. Below a quarter of it all of the pull
/// stays.
constexpr double halved_at = 2e-4, eased_from = halved_at / 4;
/// Rate of shear, times the time in which points forget, at which nodes pull by their velocity alone.
constexpr double sheared_wholly = 0.05;
/// Share of the bend of the flow beside bodies.
constexpr double bend_that_counts = 0.9;

double share_full(double fill) {
  return std::clamp((fill - eased_above) / (eased_wholly - eased_above), 0.0, 1.0);
}

/// Points of one cell differ by more than an affine field where the flow turns or narrows within a few cells,
/// and the nodes' pull evens that out as a viscosity of the order of 0.1 h c does. It is there against noise
/// in still water; where water accelerates it only brakes. As a factor of a node's pull it moves no net
/// momentum.
/// @param change  of v in the step [m/s];  @param speed_for_half  c2 dt / h times `halved_at`
/// @return  above 0
double pull_of(const Vec3& change, double fill, double speed_for_half) {
  constexpr double from = eased_from / halved_at;
  const double strength =
      std::max(0.0, change.squaredNorm() / (speed_for_half * speed_for_half) - from * from);
  const double full = share_full(fill);
  return 1 - full + full / (1 + strength);
}

/// Share of the wall's area that a node at s cells from it stands for, so that the nodes' and their hidden
/// mirror's impulses add up to the stress on the area. Films thinner than a cell spread over the nodes by
/// the spline; deep water is held at the first layer alone.
/// @param filled  fluid volume of the node [cells]
double film_share(double s, double filled) {
  const double spline = quadratic_spline(s);
  if (spline <= 0) return 0;
  const double visible = 1 - spline_beyond(s);
  const double hidden = s < 1 ? spline_beyond(1 - s) + spline_beyond(2 - s) : 0.0;
  const double deep = s < 1 ? visible / (visible + hidden) : 0.0;
  const double thickness = std::min(1.0, filled / spline);  // of the film [cells]
  return (1 - thickness) * spline + thickness * deep;
}

/// Gives a wall the impulse of a node. In a corner the node holds only the water that it sees: the mirror
/// image of what the other walls hide presses on this wall too. That part of the impulse went to those walls
/// when the points' hidden nodes were counted, but nothing holds it there, along the wall. The first layer of
/// nodes stands for what the wall hides.
void add_with_images(std::span<const WallPlane> planes, std::size_t k, double spacing, const Vec3& impulse,
                     const Vec3& at, WallImpulses& out) {
  out.add(planes[k].wall, impulse, at);
  for (std::size_t j = 0; j < planes.size(); ++j) {
    if (j == k || planes[j].wall == planes[k].wall) continue;
    const Vec3& normal = planes[j].normal;
    const double s =
        planes[j].distance / spacing - normal.dot(node_offset);  // where the node counts as being
    if (s >= 1) continue;
    const double image =
        (spline_beyond(1 - s) + spline_beyond(2 - s)) / (1 - spline_beyond(std::max(0.0, s)));
    const Vec3 moved = image * (impulse - impulse.dot(normal) * normal);
    out.add(planes[k].wall, moved, at);
    out.add(planes[j].wall, -moved, at);
  }
}

/// Beside a ball of curvature k the speed across it rises from the surface as that past a sphere in ideal
/// flow, 1 - (1 + k s)^-3, not evenly: an even field that has its value and slope at s still flows at the
/// surface, by its slope times (2 x^2 + 4/3 x^3 + x^4/3) / k, x = k s. The node speaks for points at s^2 +
/// 1/4 in the mean square. Without this a ball is braked as by a liquid of the viscosity h c.
/// No more than x = 0.35 counts: at the edges of blocks, which bend within a cell, more of it makes spikes,
/// and with x = 0.6 a ball of four cells as dense as water swims off, at 0.23 m/s after 0.75 s.
/// @return  the length that multiplies the slope [cells]
double bend_of_flow(double curvature, double s) {
  if (curvature == 0) return 0;
  const double x = std::min(0.35, curvature * std::sqrt(s * s + 0.25));
  return x * x * (2 + x * (4.0 / 3 + x / 3)) / curvature;
}

/// Beside a ball of curvature k the speed along it rises from the surface as that past a sphere in creeping
/// flow, 1 - 3/4 / (1 + x) - 1/4 / (1 + x)^3, x = k s, and there it is as many times as steep as its mean
/// slope up to s (Stokes 1851; Batchelor, Introduction to Fluid Dynamics, 4.9). Flow that is not creeping is
/// steeper still. No more than x = 1/2 counts.
/// @param distance  s [m];  @param curvature  k [1/m], 0 for what is flat
double steeper_at_ball(double curvature, double distance) {
  const double x = std::min(0.5, curvature * distance);
  if (!(x > 1e-6)) return 1;
  const double r = 1 + x;
  return 1.5 * x / (1 - 0.75 / r - 0.25 / (r * r * r));
}

template <class Real>
Vec3 vector_at(const Lanes<Real>& node, int lane) {
  return {static_cast<double>(node[lane]), static_cast<double>(node[lane + 1]),
          static_cast<double>(node[lane + 2])};
}

/// @param sum  of m D of the points beside walls;  @param mass  theirs
template <class Half>
Mat3 mean_strain(const Half& sum, double mass) {
  Mat3 mean;
  for (int r = 0; r < 3; ++r) {
    mean(r, r) = static_cast<double>(sum[r]) / mass;
    mean((r + 1) % 3, (r + 2) % 3) = mean((r + 2) % 3, (r + 1) % 3) = static_cast<double>(sum[3 + r]) / mass;
  }
  return mean;
}

template <class Real>
void add_to(Lanes<Real>& node, int lane, const Vec3& v) {
  for (int r = 0; r < 3; ++r) node[lane + r] += static_cast<Real>(v[r]);
}
}  // namespace

template <class Real>
void ExplicitMpm<Real>::walls(double dt) {
  step_.dt = dt;
  const std::vector<std::int32_t>& active = grid_.active();
  parallel_for(
      active.size(),
      [&](std::size_t b) { wall_block(grid_.slot_of(active[b]), node_begin_[b], impulses_[b]); }, 4);
  if (has_walls()) pour_loads(active.size());
}

template <class Real>
void ExplicitMpm<Real>::wall_block(std::int32_t slot, std::uint32_t first, WallImpulses& impulses) {
  using namespace node_lane;
  const double h = config_.spacing;
  const double cell = h * h * h;
  const Vec3i place = BlockLayout::edge * layout_.block_place(grid_.block_of(slot));
  const Real spray = static_cast<Real>(spray_below),
             ramp = static_cast<Real>(1.0 / (bulk_above - spray_below));
  const Real gravity_change[3] = {static_cast<Real>(step_.dt * gravity_.x()),
                                  static_cast<Real>(step_.dt * gravity_.y()),
                                  static_cast<Real>(step_.dt * gravity_.z())};
  const Real sheared_for_all = static_cast<Real>(step_.t_velocity / sheared_wholly);
  const double speed_for_half = halved_at * step_.dt * sound_speed_ * sound_speed_ / h;
  Node* nodes = grid_.nodes(slot);
  for (int n = 0; n < BlockLayout::nodes; ++n) {
    Node& node = nodes[n];
    if (node[mass] == 0) continue;
    Vec3 pushed = Vec3::Zero();
    if (!impulse_.empty()) {
      pushed = impulse_[first++] / static_cast<double>(node[mass]);
      add_to(node, change, pushed);
    }
    std::span<const WallPlane> planes;
    Vec3 at = Vec3::Zero();
    WaterBeside water;
    const Vec3 cut_off = vector_at(node, gradient);
    if (const std::int32_t stencil = grid_.stencil(slot)[n]; stencil >= 0) {
      const Vec3i where = place + Vec3i(n & 3, (n >> 2) & 3, n >> 4);
      const WallRecord record = record_of(stencil);
      planes = record.field->planes_at(record.stencil);
      if (!planes.empty()) {
        at = layout_.node_position(where);
        water.volume =
            static_cast<double>(node[fill] * open_fraction(slot, n) * grid_.void_fraction(slot)[n]) * cell;
        if (node[near_wall] > 0) {
          const auto& sum = grid_.strain(slot)[n];
          const double beside = static_cast<double>(node[near_wall]);
          water.strain = mean_strain(sum, beside);
          water.chi = beside / (beside + static_cast<double>(sum[6]));
        }
        close_pressure(node, water, planes, at, impulses);
      }
    }
    for (int r = 0; r < 3; ++r)
      node[gradient + r] = node[change + r] - gravity_change[r] - static_cast<Real>(pushed[r]);
    if (!planes.empty()) hold_at_walls(node, water, cut_off, planes, at, impulses);
    const Real bulk = std::clamp((node[fill] - spray) * ramp, Real(0), Real(1));
    for (int r = 0; r < 3; ++r) node[velocity + r] *= bulk;
    node[mass] = bulk;
    // Bodies that water pushes drift by themselves where it may be pulled less.
    const bool beside_body = std::any_of(planes.begin(), planes.end(), [&](const WallPlane& plane) {
      return poses_.free_body(plane.wall) >= 0;
    });
    const double pull =
        beside_body ? 1 : pull_of(vector_at(node, change), static_cast<double>(node[fill]), speed_for_half);
    const Real felt = static_cast<Real>(pull) * bulk;
    node[near_wall] = felt;
    Vector& blend = grid_.blend(slot)[n];
    // Beside walls that stand nothing of the misfit may stay: it would not let still water rest. A film that
    // rubs on its wall is turbulent, and mixed as far as the wall is seen. Layers between walls without slip
    // are thinned where the misfit stays in their middle and goes at their walls: there it goes everywhere.
    const bool seen_by_film = config_.wall_slip == WallSlip::turbulent_film && grid_.stencil(slot)[n] >= 0 &&
                              grid_.stencil(slot)[n] < first_moving;
    const bool by_walls = seen_by_film || !planes.empty() || config_.wall_slip == WallSlip::no_slip;
    const bool all_goes = bulk < 1 || (by_walls && !beside_body);
    const Real by_velocity = all_goes ? Real(1) : std::min(Real(1), blend[3] * sheared_for_all);
    const Vector pulled = static_cast<Real>(pull) * by_velocity * node.quad(0);
    blend = with_fourth(pulled - felt * (1 - by_velocity) * blend, felt * by_velocity);
  }
}

/// Near a wall the kernel is cut off and sum p grad w does not vanish: the wall pushes back with the
/// pressure at its own place.
template <class Real>
void ExplicitMpm<Real>::close_pressure(Node& node, const WaterBeside& water,
                                       std::span<const WallPlane> planes, const Vec3& at,
                                       WallImpulses& impulses) const {
  using namespace node_lane;
  const double m = static_cast<double>(node[mass]);
  const double density = water.volume > 0 ? m / water.volume : config_.fluid.density;
  const double e = static_cast<double>(node[dilation]);
  const double mean_pressure = -density * sound_speed_ * sound_speed_ * e;  // as V p = -m c2 e of the points
  if (!(mean_pressure > 0)) return;
  const Vec3 centre_offset = config_.spacing * vector_at(node, centre);  // of the water from the node
  Vec3 c = vector_at(node, gradient);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const WallPlane& plane = planes[k];
    const double cn = c.dot(plane.normal);
    if (cn <= 0) continue;
    // Beside a wall whose motion changes, the water's does too, across the wall.
    const Vec3 contact = at + plane.distance * plane.normal;
    const double surge = poses_.change(plane.wall, contact).dot(plane.normal) / step_.dt;
    const double at_wall = std::max(
        0.0,
        mean_pressure +
            density * (gravity_ - surge * plane.normal).dot(plane.distance * plane.normal - centre_offset));
    const Vec3 impulse = -step_.dt * water.chi * at_wall * cn * plane.normal;
    add_to(node, change, impulse / m);
    add_with_images(planes, k, config_.spacing, -impulse, contact, impulses);
    c -= cn * plane.normal;
  }
}

/// No flow into walls, and friction along them. A wall mirrors the flow: a node holds the mean of the water
/// that it sees and of its image. Where the water would move into the wall at u, and evenly, the share 2 F(s)
/// of the image takes that much of u from the node; where its normal part fades towards the wall, as it does
/// beside any wall along which water flows, u is what is left of it at the wall, not at the node. Bodies bend
/// it (bend_of_flow).
/// @param cut_off  sum V grad w of the points, which is zero where the kernel is whole [m2]
template <class Real>
void ExplicitMpm<Real>::hold_at_walls(Node& node, const WaterBeside& water, Vec3 cut_off,
                                      std::span<const WallPlane> planes, const Vec3& at,
                                      WallImpulses& impulses) const {
  using namespace node_lane;
  const double h = config_.spacing;
  const double m = static_cast<double>(node[mass]);
  const bool pressed = node[dilation] < 0 || config_.keep_tension;
  const double density = water.volume > 0 ? m / water.volume : config_.fluid.density;
  const bool no_slip = config_.wall_slip == WallSlip::no_slip;
  const double rest_density = density * (1 + static_cast<double>(node[dilation]));
  const double full = pressed ? share_full(static_cast<double>(node[fill])) : 0.0;
  // In corners and gaps, and beside bodies that water pushes, it must stop at once.
  const bool alone = planes.size() == 1 && poses_.free_body(planes[0].wall) < 0;
  const double in_step = alone ? 1 - full * (1 - static_cast<double>(step_.relax_velocity)) : 1.0;
  Vec3 v = vector_at(node, velocity) + vector_at(node, change);
  const Vec3 before = v;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const WallPlane& plane = planes[k];
    const Vec3 contact = at + plane.distance * plane.normal;
    const Vec3 surface = poses_.surface_velocity(plane.wall, contact);
    const double s = plane.distance / h;
    const double hold = in_step * water.chi * 2 * spline_beyond(s);
    const double vn = (v - poses_.velocity(plane.wall, contact)).dot(plane.normal);
    const double reach = plane.distance + bend_that_counts * h * bend_of_flow(plane.curvature, s);
    const double at_wall = vn + reach * plane.normal.dot(water.strain * plane.normal);
    Vec3 held = Vec3::Zero(), change_here = Vec3::Zero();
    if (at_wall > 0 || pressed) {
      const double change = -hold * at_wall;
      held = change_here = change * plane.normal;
      impulses.add_impact(plane.wall, std::max(0.0, -0.5 * m * change * (2 * vn + change)));
    }
    const Vec3 sliding = v - surface - (v - surface).dot(plane.normal) * plane.normal;
    double kept = 1;
    if (no_slip) {
      // The points' stress lacks what lies beyond the wall: the wall's traction mu u / distance closes it, so
      // that linear shear stays as it is. Implicit, so never beyond rest.
      const double cn = std::max(0.0, cut_off.dot(plane.normal));
      cut_off -= cn * plane.normal;
      const double arm = std::max(0.0, plane.distance - h * plane.normal.dot(node_offset));
      const double rate =
          arm > 0 ? steeper_at_ball(plane.curvature / h, arm) / arm : 0.0;  // per sliding speed
      const double viscosity = arm > 0 && cn > 0 ? viscosity_of(rest_density, rate * sliding.norm()) : 0.0;
      kept = arm > 0 ? 1 / (1 + step_.dt * water.chi * rate * viscosity * cn / m) : 0.0;
    } else if (config_.wall_slip == WallSlip::turbulent_film) {
      // Stress rho f/8 |u| u on the wall area that this node stands for; implicit, so never beyond rest.
      // Seen from a ball's centre its cell is wider than what it covers of the surface.
      const double wider = 1 + plane.curvature * s;
      const double area = h * h * film_share(s, water.volume / (h * h * h)) / (wider * wider);
      const double rate = density * config_.film_friction / 8 * area / m;
      kept = 1 / (1 + water.chi * rate * step_.dt * sliding.norm());
    }
    if (kept != 1) {
      change_here -= (1 - kept) * sliding;
      impulses.add_sliding(plane.wall, 0.5 * m * sliding.squaredNorm() * (1 - kept * kept));
    }
    add_with_images(planes, k, h, -m * held, contact, impulses);
    impulses.add(plane.wall, -m * (change_here - held), contact);
    v += change_here;
  }
  add_to(node, change, v - before);
}

template void ExplicitMpm<float>::walls(double);
template void ExplicitMpm<double>::walls(double);

}  // namespace sluice
