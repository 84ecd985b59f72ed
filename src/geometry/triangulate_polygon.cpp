#include "geometry/triangulate_polygon.h"

#include "geometry/exact_sign.h"

namespace sluice {

namespace {

using Vec2 = Eigen::Vector2d;

/// The polygon in the coordinate plane in which it is largest, counter-clockwise.
std::vector<Vec2> flattened(const std::vector<Vec3>& vertices, const std::vector<int>& corners) {
  const auto at = [&](std::size_t k) -> const Vec3& {
    return vertices[static_cast<std::size_t>(corners[k % corners.size()])];
  };
  Vec3 normal = Vec3::Zero();  // Newell's
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) normal += (at(k) - at(0)).cross(at(k + 1) - at(0));
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int i = (axis + 1) % 3, j = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(i, j);
  std::vector<Vec2> flat;
  for (std::size_t k = 0; k < corners.size(); ++k) flat.emplace_back(at(k)[i], at(k)[j]);
  return flat;
}

bool holds(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& x) {
  return orient2d(a, b, x) >= 0 && orient2d(b, c, x) >= 0 && orient2d(c, a, x) >= 0;
}

/// Whether the corner at `k` of what is left can be cut off.
bool is_ear(const std::vector<Vec2>& flat, const std::vector<std::size_t>& left, std::size_t k) {
  const std::size_t n = left.size(), before = (k + n - 1) % n, after = (k + 1) % n;
  const Vec2 &a = flat[left[before]], &b = flat[left[k]], &c = flat[left[after]];
  if (!(orient2d(a, b, c) > 0)) return false;
  for (std::size_t other = 0; other < n; ++other)
    if (other != before && other != k && other != after && holds(a, b, c, flat[left[other]])) return false;
  return true;
}

}  // namespace

std::optional<std::vector<std::array<int, 3>>> triangulate_polygon(const std::vector<Vec3>& vertices,
                                                                   const std::vector<int>& corners) {
  if (corners.size() == 3) return {{{corners[0], corners[1], corners[2]}}};
  const std::vector<Vec2> flat = flattened(vertices, corners);
  std::vector<std::size_t> left(corners.size());
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
  std::vector<std::array<int, 3>> triangles;
  while (left.size() > 2) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(flat, left, ear)) ++ear;
    if (ear == left.size()) return std::nullopt;
    const std::size_t n = left.size();
    triangles.push_back({corners[left[(ear + n - 1) % n]], corners[left[ear]], corners[left[(ear + 1) % n]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace sluice
