#include "mpm/wall_sight.h"

#include <algorithm>
#include <cmath>

namespace sluice {
namespace {

constexpr int lanes = Targets::count;

std::uint32_t pack(const double* value, double at_least) {
  std::uint32_t bits = 0;
  for (int j = 0; j < lanes; ++j) bits |= value[j] >= at_least ? 1u << j : 0u;
  return bits;
}

}  // namespace

bool Sight::inside(const StencilPatch& p, const Vec3& q, double tolerance) const {
  const WallPatch& patch = plane(p);
  const double u = q[patch.u], v = q[patch.v];
  if (p.near.edge_count >= 0) {
    for (const Vec3& e : stencils.edges_of(p.near))
      if (e[0] * u + e[1] * v + e[2] < -tolerance) return false;
    return true;
  }
  for (std::int32_t t : stencils.triangles_of(p)) {
    const auto& e = walls.triangles[static_cast<std::size_t>(t)].edge;
    if (e[0][0] * u + e[0][1] * v + e[0][2] >= -tolerance &&
        e[1][0] * u + e[1][1] * v + e[1][2] >= -tolerance &&
        e[2][0] * u + e[2][1] * v + e[2][2] >= -tolerance)
      return true;
  }
  return false;
}

std::optional<double> Sight::crossing(const StencilPatch& p, const Vec3& a, const Vec3& b) const {
  const WallPatch& patch = plane(p);
  const double height_a = height_over(patch, a), height_b = height_over(patch, b);
  if (is_above(height_a) == is_above(height_b)) return std::nullopt;
  const double fall = height_a - height_b;
  const double s = std::clamp(height_a / fall, 0.0, 1.0);
  if (p.near.covered()) return s;
  // Corners off the plane open a seam towards the next patch, the wider the flatter the path
  const double along = std::sqrt(std::max(0.0, (b - a).squaredNorm() - fall * fall));
  const double seam = std::min(2 * patch.deviation * along / std::abs(fall), 1e-2);
  if (!inside(p, a + s * (b - a), walls.tolerance + seam)) return std::nullopt;
  return s;
}

bool Sight::sees(const StencilRecord& record, const Vec3& a, const Vec3& b, int except) const {
  for (const StencilPatch& p : stencils.patches_of(record))
    if (p.patch != except && crossing(p, a, b)) return false;
  for (const std::int32_t body : stencils.bodies_of(record)) {
    if (patch_of_body(body) == except) continue;
    const BodyFace near = face(body, a);
    if (near.hides(a - near.foot, b - near.foot)) return false;
  }
  return true;
}

std::uint32_t targets_beyond(const WallPatch& plane, const Vec3& x, const Targets& targets) {
  const double n0 = plane.normal[0], n1 = plane.normal[1], n2 = plane.normal[2], offset = plane.offset;
  alignas(64) double height[lanes];
  for (int j = 0; j < lanes; ++j)
    height[j] = n0 * targets.x[0][j] + n1 * targets.x[1][j] + n2 * targets.x[2][j] - offset;
  const std::uint32_t above = pack(height, 0.0);
  return is_above(height_over(plane, x)) ? ~above : above;
}

std::uint32_t hidden_by(const BodyFace& face, const Vec3& x, const Targets& targets) {
  // As BodyFace::hides, side by side.
  const Vec3 p = x - face.foot;
  const double start = face.over(p), half = 0.5 * face.curvature;
  alignas(64) double below[lanes];
  for (int j = 0; j < lanes; ++j) {
    const double qx = targets.x[0][j] - face.foot[0], qy = targets.x[1][j] - face.foot[1],
                 qz = targets.x[2][j] - face.foot[2];
    const double dx = qx - p[0], dy = qy - p[1], dz = qz - p[2];
    const double end = qx * face.normal[0] + qy * face.normal[1] + qz * face.normal[2] +
                       half * (qx * qx + qy * qy + qz * qz);
    const double bend = half * (dx * dx + dy * dy + dz * dz), slope = end - start - bend;
    const bool dips = start >= 0 && slope < 0 && -slope < 2 * bend && slope * slope > 4 * bend * start;
    below[j] = (end < 0 && (start >= 0 || end < start)) || dips ? 1.0 : 0.0;
  }
  return pack(below, 0.5);
}

std::uint32_t hidden_targets(const Sight& sight, const StencilPatch& p, Reach reach, const Vec3& x,
                             const Targets& targets, std::uint32_t candidates, double* s) {
  const PatchSection& section = reach == Reach::cut_box ? p.cut : p.near;
  const WallPatch& plane = sight.plane(p);
  const double n0 = plane.normal[0], n1 = plane.normal[1], n2 = plane.normal[2], offset = plane.offset;
  const double from = height_over(plane, x);
  for (int j = 0; j < lanes; ++j) {
    const double to = n0 * targets.x[0][j] + n1 * targets.x[1][j] + n2 * targets.x[2][j] - offset;
    s[j] = from / (from - to);
  }
  if (section.covered()) return candidates;

  alignas(64) double u[lanes], v[lanes], depth[lanes];
  const double *target_u = targets.x[plane.u], *target_v = targets.x[plane.v];
  const double xu = x[plane.u], xv = x[plane.v];
  for (int j = 0; j < lanes; ++j) {
    u[j] = xu + s[j] * (target_u[j] - xu);
    v[j] = xv + s[j] * (target_v[j] - xv);
  }
  if (section.edge_count > 0) {
    for (double& d : depth) d = 1e300;
    for (const Vec3& e : sight.stencils.edges_of(section)) {
      const double a = e[0], b = e[1], c = e[2];
      for (int j = 0; j < lanes; ++j) {
        const double d = a * u[j] + b * v[j] + c;
        depth[j] = depth[j] < d ? depth[j] : d;
      }
    }
    return candidates & pack(depth, -sight.walls.tolerance);
  }

  for (double& d : depth) d = -1e300;
  const std::int32_t* t = sight.stencils.triangles.data() + p.triangles;
  for (std::int32_t i = 0; i < section.triangles; ++i) {
    const auto& e = sight.walls.triangles[static_cast<std::size_t>(t[i])].edge;
    const double a0 = e[0][0], b0 = e[0][1], c0 = e[0][2], a1 = e[1][0], b1 = e[1][1], c1 = e[1][2],
                 a2 = e[2][0], b2 = e[2][1], c2 = e[2][2];
    for (int j = 0; j < lanes; ++j) {
      const double d0 = a0 * u[j] + b0 * v[j] + c0, d1 = a1 * u[j] + b1 * v[j] + c1,
                   d2 = a2 * u[j] + b2 * v[j] + c2;
      const double d01 = d0 < d1 ? d0 : d1, d = d01 < d2 ? d01 : d2;
      depth[j] = depth[j] < d ? d : depth[j];
    }
  }
  return candidates & pack(depth, -sight.walls.tolerance);
}

}  // namespace sluice
