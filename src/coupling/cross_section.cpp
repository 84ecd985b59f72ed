#include "coupling/cross_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

namespace {

// Patches of the surface as vectors of area, on a spiral of directions: dA = r^2 dw n / (n . w).
std::vector<Vec3> patches_of(const RockShape& shape) {
  constexpr int count = 4096;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> patches;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    // Directions on the ellipsoid's sphere, so that long bodies are covered evenly.
    const Vec3 on_sphere(r * std::cos(golden * i), r * std::sin(golden * i), z);
    const Vec3 u = on_sphere.cwiseProduct(shape.semi_axes);
    const double m = shape.blockiness;
    const Vec3 x = u * std::pow(superquadric_function(shape.semi_axes, m, u), -1 / m);
    Vec3 normal;
    for (int k = 0; k < 3; ++k)
      normal[k] =
          std::copysign(std::pow(std::abs(x[k]) / shape.semi_axes[k], m - 1) / shape.semi_axes[k], x[k]);
    // Volume of the cone over a patch is dw/3 |on sphere|^3 abc (x/u)^3: dA = 3 V n / (n . x).
    const double scale = x.norm() / u.norm();
    const double cone = 4 * std::numbers::pi / count * shape.semi_axes.prod() * std::pow(scale, 3);
    patches.emplace_back(normal * (cone / normal.dot(x)));
  }
  return patches;
}

}  // namespace

CrossSection::CrossSection(const RockShape& shape) {
  const std::vector<Vec3> patches = patches_of(shape);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const double z = static_cast<double>(i) / (rows - 1), r = std::sqrt(1 - z * z);
      const double angle = std::numbers::pi / 2 * j / (rows - 1);
      const Vec3 direction(r * std::cos(angle), r * std::sin(angle), z);
      double sum = 0;
      for (const Vec3& patch : patches) sum += std::abs(patch.dot(direction));
      area_[static_cast<std::size_t>(i * rows + j)] = 0.5 * sum;
    }
}

double CrossSection::seen_along(const Vec3& direction) const {
  const double height = std::min(1.0, std::abs(direction.z())) * (rows - 1);
  const double angle = std::atan2(std::abs(direction.y()), std::abs(direction.x()));
  const double turn = angle / (std::numbers::pi / 2) * (rows - 1);
  const int i = std::min(static_cast<int>(height), rows - 2), j = std::min(static_cast<int>(turn), rows - 2);
  const double up = height - i, on = turn - j;
  const auto at = [&](int a, int b) { return area_[static_cast<std::size_t>(a * rows + b)]; };
  return (1 - up) * ((1 - on) * at(i, j) + on * at(i, j + 1)) +
         up * ((1 - on) * at(i + 1, j) + on * at(i + 1, j + 1));
}

}  // namespace sluice
