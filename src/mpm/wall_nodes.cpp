#include "mpm/wall_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace sluice {
namespace {

constexpr double least_open_fraction = 0.02;
constexpr double eye_slack = 2e-3;  // more than the offset at which a node is seen [h]
constexpr int sample_groups = 32;   // 1024 samples: a plane's fraction within 0.01

struct Candidate {
  double distance;   ///< to the foot
  int order;         ///< as it was found
  int patch;         ///< or a body as one
  Vec3 normal;       ///< towards the wall
  Vec3 foot;         ///< nearest place of it
  Vec3 surface;      ///< a place of its plane
  double curvature;  ///< mean
  bool around;       ///< the place lies within the body
};

/// Nearest first; of two alike the one found first.
void sort_by_distance(std::vector<Candidate>& candidates) {
  if (candidates.size() < 2) return;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.order < b.order);
  });
}

Vec3 closest_on_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  return a + (length2 > 0 ? std::clamp((x - a).dot(ab) / length2, 0.0, 1.0) : 0.0) * ab;
}

/// The patch's point closest to x, if it is an inner point or one where the surface goes on smoothly.
std::optional<Vec3> foot_on(const Sight& sight, const StencilPatch& p, const Vec3& x, double height) {
  const Vec3 q = x - height * sight.plane(p).normal;
  if (p.near.covered() || sight.inside(p, q, sight.walls.tolerance)) return q;
  if (!p.goes_on) return std::nullopt;
  double nearest_smooth = std::numeric_limits<double>::infinity(), nearest_free = nearest_smooth;
  Vec3 foot = q;
  for (std::int32_t index : sight.stencils.triangles_of(p)) {
    const WallTriangle& t = sight.walls.triangles[static_cast<std::size_t>(index)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(t.boundary >> k & 1)) continue;
      const Vec3 c = closest_on_segment(x, t.corner[k], t.corner[(k + 1) % 3]);
      const double d = (c - x).norm();
      if (!(t.smooth >> k & 1)) {
        nearest_free = std::min(nearest_free, d);
      } else if (d < nearest_smooth) {
        nearest_smooth = d;
        foot = c;
      }
    }
  }
  // A corner where a smooth edge meets a lip is the lip's
  if (nearest_smooth >= plane_reach || nearest_free <= nearest_smooth + 1e-6) return std::nullopt;
  // Beyond the edge, between the facet's plane and the facet that goes on, is not in front of it
  if (std::abs(height) < smooth_cosine * nearest_smooth) return std::nullopt;
  return foot;
}

/// Abscissa below which the fraction f of a quadratic B-spline lies, by bisection.
double spline_quantile(double f) {
  auto below = [](double x) {
    const double r = 1.5 - std::abs(x);
    const double tail = r * r * r / 6;  // of |x| > 1/2
    const double a = std::abs(x);
    const double beyond = a >= 0.5 ? tail : 0.5 - (0.75 * a - a * a * a / 3);
    return x < 0 ? beyond : 1 - beyond;
  };
  double lo = -1.5, hi = 1.5;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lo + hi);
    (below(middle) < f ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

/// Places about a node that each stand for the same share of its spline: an additive lattice (Roberts 2018,
/// R3 sequence: powers of the root of g^4 = g + 1) sent through the spline's quantiles.
const std::array<Targets, sample_groups>& spline_samples() {
  static const auto samples = [] {
    constexpr std::array<double, 3> step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    std::array<Targets, sample_groups> s{};
    for (int i = 0; i < sample_groups * Targets::count; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double r = 0.5 + step[k] * (i + 1);
        s[static_cast<std::size_t>(i / Targets::count)].x[k][i % Targets::count] =
            spline_quantile(r - std::floor(r));
      }
    }
    return s;
  }();
  return samples;
}

}  // namespace

int active_planes(const Sight& sight, const StencilRecord& record, const Vec3& x, const Vec3& seen_at,
                  WallPlane* out, int max) {
  const auto patches = sight.stencils.patches_of(record);
  if (patches.size() == 1 && patches[0].near.covered() && max > 0 && record.body_count == 0) {
    const WallPatch& plane = sight.plane(patches[0]);
    const double height = height_over(plane, seen_at);
    if (!(std::abs(height) < plane_reach)) return 0;
    const double side = is_above(height) ? 1 : -1;
    out[0] = {-side * plane.normal, std::max(0.0, side * height_over(plane, x)), plane.wall, patches[0].patch,
              0};
    return 1;
  }
  thread_local std::vector<Candidate> candidates;  // keeps its memory: this is asked for each point
  candidates.clear();
  const auto add = [&](Candidate candidate) {
    if (!(candidate.distance < plane_reach)) return;
    candidate.order = static_cast<int>(candidates.size());
    candidates.push_back(candidate);
  };
  for (const StencilPatch& p : patches) {
    const WallPatch& plane = sight.plane(p);
    const double height = height_over(plane, seen_at);
    if (!(std::abs(height) < plane_reach)) continue;
    const std::optional<Vec3> foot = foot_on(sight, p, seen_at, height);
    if (!foot) continue;
    const Vec3 normal = is_above(height) ? Vec3(-plane.normal) : plane.normal;
    add({(*foot - seen_at).norm(), 0, p.patch, normal, *foot, plane.offset * plane.normal, 0, false});
  }
  for (const std::int32_t body : sight.stencils.bodies_of(record)) {
    const BodyFace face = sight.face(body, seen_at);
    add({std::max(0.0, face.height), 0, sight.patch_of_body(body), -face.normal, face.foot, face.foot,
         face.curvature, face.height <= 0});
  }
  sort_by_distance(candidates);
  const bool alone = patches.size() + static_cast<std::size_t>(record.body_count) < 2;
  int written = 0;
  for (const Candidate& next : candidates) {
    if (written == max) break;
    if (std::any_of(out, out + written, [&](const WallPlane& earlier) {
          return earlier.normal.dot(next.normal) > smooth_cosine;
        }))
      continue;
    // Within a body that reaches into another wall, that wall may stand before the body's surface.
    const Vec3 before_foot = next.foot + 1e-3 * (seen_at - next.foot);
    if (!alone && !next.around && !sight.sees(record, seen_at, before_foot, next.patch)) continue;
    out[written++] = {next.normal, std::max(0.0, next.normal.dot(next.surface - x)),
                      sight.wall_of(next.patch), next.patch, next.curvature};
  }
  return written;
}

double open_fraction_of(const Sight& sight, const StencilRecord& record) {
  const Vec3 node = (record.base.cast<double>().array() + 1).matrix();
  const Vec3 eye = node + node_offset;
  // Patches whose plane passes by the support hide nothing of it.
  std::vector<const StencilPatch*> patches;
  for (const StencilPatch& p : sight.stencils.patches_of(record)) {
    const WallPatch& plane = sight.plane(p);
    if (std::abs(height_over(plane, node)) <= plane_reach * plane.normal.cwiseAbs().sum() + eye_slack)
      patches.push_back(&p);
  }
  std::vector<BodyFace> faces;
  for (const std::int32_t body : sight.stencils.bodies_of(record)) {
    faces.push_back(sight.face(body, eye));
    if (faces.back().height > plane_reach * std::sqrt(3.0)) faces.pop_back();
  }
  if (patches.empty() && faces.empty()) return 1;
  int open = 0;
  for (const Targets& sample : spline_samples()) {
    Targets targets;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < Targets::count; ++j) targets.x[k][j] = node[k] + sample.x[k][j];
    std::uint32_t hidden = 0;
    for (const StencilPatch* p : patches) {
      const std::uint32_t beyond = targets_beyond(sight.plane(*p), eye, targets) & ~hidden;
      if (!beyond) continue;
      alignas(64) double s[Targets::count];
      hidden |= hidden_targets(sight, *p, Reach::near_box, eye, targets, beyond, s);
    }
    for (const BodyFace& face : faces) hidden |= hidden_by(face, eye, targets);
    open += Targets::count - std::popcount(hidden);
  }
  return std::max(least_open_fraction, open / static_cast<double>(sample_groups * Targets::count));
}

}  // namespace sluice
