#include "mpm/hidden_nodes.h"

namespace sluice {

namespace {

constexpr int lanes = Targets::count;

/// Places of the nodes about the middle one, and five more that fill the registers.
struct NodePlaces {
  alignas(64) double x[3][lanes];
  constexpr NodePlaces() : x{} {
    for (int n = 0; n < lanes; ++n) {
      x[0][n] = n % 3 - 1;
      x[1][n] = n / 3 % 3 - 1;
      x[2][n] = n / 9 - 1;
    }
  }
};
constexpr NodePlaces node_places;

std::uint32_t above_zero(const double* value) {
  std::uint32_t bits = 0;
  for (int n = 0; n < lanes; ++n) bits |= value[n] > 0 ? 1U << n : 0U;
  return bits;
}

/// Which nodes lie beyond each plane, and at which planes the point's field is mirrored to reach them.
struct PlaneSides {
  std::uint32_t beyond[most_planes];
  std::uint32_t mirrored[most_planes];
};

/// Sides are decided where nodes count as being, as in visibility(): a node on the plane has one. Planes
/// mirror one after the other, each what the ones before it left.
PlaneSides sides_of_planes(const Surroundings& around, const Vec3& offset, std::uint32_t holds) {
  PlaneSides sides;
  Targets at;  // from the point [cells]
  for (int c = 0; c < 3; ++c)
    for (int n = 0; n < lanes; ++n) at.x[c][n] = node_places.x[c][n] + (node_offset[c] - offset[c]);
  Targets image;
  bool moved = false;
  alignas(64) double height[lanes];
  const auto heights = [&](const WallPlane& plane, const Targets& of) {
    const double n0 = plane.normal[0], n1 = plane.normal[1], n2 = plane.normal[2];
    const double distance = plane.distance / around.h;
    for (int n = 0; n < lanes; ++n)
      height[n] = n0 * of.x[0][n] + n1 * of.x[1][n] + n2 * of.x[2][n] - distance;
    return above_zero(height);
  };
  for (int q = 0; q < around.plane_count; ++q) {
    const WallPlane& plane = around.planes[q];
    sides.beyond[q] = heights(plane, at);
    sides.mirrored[q] = 0;
    if (!(holds >> q & 1)) continue;
    sides.mirrored[q] = moved ? heights(plane, image) : sides.beyond[q];
    if (q + 1 == around.plane_count || sides.mirrored[q] == 0) continue;
    if (!moved) image = at;
    moved = true;
    const double shift = plane.normal.dot(node_offset);
    for (int n = 0; n < lanes; ++n) height[n] = height[n] > 0 ? 2 * (height[n] - shift) : 0;
    for (int c = 0; c < 3; ++c)
      for (int n = 0; n < lanes; ++n) image.x[c][n] -= height[n] * plane.normal[c];
  }
  return sides;
}

/// Those of `nodes` that the wall which hides node n hides, too.
std::uint32_t hidden_by_wall_of(const Surroundings& around, int n, int wall, std::uint32_t nodes) {
  const auto of_patch = [&](int node) {
    const std::int32_t patch = around.seen.patch[static_cast<std::size_t>(node)];
    std::uint32_t bits = 0;
    for (int m = 0; m < 27; ++m)
      bits |= around.seen.patch[static_cast<std::size_t>(m)] == patch ? 1U << m : 0U;
    return bits;
  };
  std::uint32_t same = nodes;
  for (std::uint32_t left = nodes & ~of_patch(n); left != 0;) {
    const int other = std::countr_zero(left);
    const std::uint32_t theirs = of_patch(other);
    if (around.field.patch_wall(around.seen.patch[static_cast<std::size_t>(other)]) != wall) same &= ~theirs;
    left &= ~theirs;
  }
  return same;
}

/// Sums of the weights and their moments over some of the nodes, row by row.
void sum_up(const SplineWeights<double> (&axis)[3], std::uint32_t nodes, HiddenNodes& out) {
  using Row = Quad<double>;
  static constexpr double kept[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const SplineWeights<double>&x = axis[0], &y = axis[1], &z = axis[2];
  const Row along = {x.w[0], x.w[1], x.w[2], 0}, d = {x.d[0], x.d[1], x.d[2], 0};
  Row plain{}, by_y{}, by_z{}, yy{}, zz{}, yz{};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      const double* keep = kept[nodes >> (3 * j + 9 * k) & 7];
      const Row w = (y.w[j] * z.w[k]) * (along * Row{keep[0], keep[1], keep[2], 0});
      const Row wy = y.d[j] * w, wz = z.d[k] * w;
      plain += w;
      by_y += wy;
      by_z += wz;
      yy += y.d[j] * wy;
      zz += z.d[k] * wz;
      yz += y.d[j] * wz;
    }
  const auto sum = [](const Row& r) { return r[0] + r[1] + r[2]; };
  out.w = sum(plain);
  out.first[0] = sum(d * plain);
  out.first[1] = sum(by_y);
  out.first[2] = sum(by_z);
  out.second[0] = sum(d * d * plain);
  out.second[1] = sum(yy);
  out.second[2] = sum(zz);
  out.second[3] = sum(yz);
  out.second[4] = sum(d * by_z);
  out.second[5] = sum(d * by_y);
}

}  // namespace

void group_hidden(const Surroundings& around, const Vec3& offset, std::uint32_t holds, HiddenGroups& out) {
  const PlaneSides sides = sides_of_planes(around, offset, holds);
  const SplineWeights<double> axis[3] = {SplineWeights<double>(offset[0]), SplineWeights<double>(offset[1]),
                                         SplineWeights<double>(offset[2])};
  for (std::uint32_t left = around.seen.hidden; left != 0;) {
    const int n = std::countr_zero(left);
    HiddenNodes& hidden = out.group[out.count++];
    hidden.mirrors = hidden.between = 0;
    std::uint32_t same = left;
    for (int q = 0; q < around.plane_count; ++q) {
      const std::uint32_t beyond = sides.beyond[q] >> n & 1, mirrored = sides.mirrored[q] >> n & 1;
      hidden.between |= beyond << q;
      hidden.mirrors |= mirrored << q;
      same &= beyond != 0 ? sides.beyond[q] : ~sides.beyond[q];
      same &= mirrored != 0 ? sides.mirrored[q] : ~sides.mirrored[q];
    }
    hidden.wall = around.field.patch_wall(around.seen.patch[static_cast<std::size_t>(n)]);
    same = hidden_by_wall_of(around, n, hidden.wall, same);
    sum_up(axis, same, hidden);
    left &= ~same;
  }
}

}  // namespace sluice
