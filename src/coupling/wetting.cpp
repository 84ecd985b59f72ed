#include "coupling/wetting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

NodeTable::NodeTable(const Domain& domain, double spacing) : domain_(domain), spacing_(spacing) {
  // Half a cell beyond the box on each side: the fluid's outermost nodes stand there.
  for (int k = 0; k < 3; ++k) {
    const double margin = domain.periodic(k) ? 0 : 2 * spacing;
    origin_[k] = domain.box.lo[k] - margin;
    cells_[k] = static_cast<int>(std::ceil((domain.box.size()[k] + 2 * margin) / spacing - 1e-6)) + 1;
  }
  table_.assign(static_cast<std::size_t>(cells_.cast<long>().prod()), -1);
}

int NodeTable::slot(const Vec3& x) const {
  int index[3];
  for (int k = 0; k < 3; ++k) {
    index[k] = static_cast<int>(std::floor((x[k] - origin_[k]) / spacing_ + 0.5));
    if (domain_.periodic(k)) {
      const int n = std::max(1, static_cast<int>(std::lround(domain_.box.size()[k] / spacing_)));
      index[k] = ((index[k] % n) + n) % n;
    } else if (index[k] < 0 || index[k] >= cells_[k]) {
      return -1;
    }
  }
  return index[0] + cells_.x() * (index[1] + cells_.y() * index[2]);
}

void NodeTable::set(const FluidNodes& nodes) {
  for (int s : filled_) table_[static_cast<std::size_t>(s)] = -1;
  filled_.clear();
  for (std::size_t i = 0; i < nodes.count(); ++i) {
    const int s = slot(nodes.x[i]);
    if (s < 0) continue;
    table_[static_cast<std::size_t>(s)] = static_cast<int>(i);
    filled_.push_back(s);
  }
}

int NodeTable::nearest(const Vec3& x) const {
  const int s = slot(x);
  return s < 0 ? -1 : table_[static_cast<std::size_t>(s)];
}

std::vector<std::vector<Vec3>> wetting_points(const std::vector<RockShape>& shapes, int per_rock) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<std::vector<Vec3>> all;
  for (const RockShape& shape : shapes) {
    std::vector<Vec3> points;
    for (int i = 0; i < per_rock; ++i) {
      // Directions on a Fibonacci spiral; radii in a shuffled order, even by volume.
      const double z = 1 - (2 * i + 1.0) / per_rock;
      const double r = std::sqrt(1 - z * z);
      const Vec3 stretched =
          Vec3(r * std::cos(golden * i), r * std::sin(golden * i), z).cwiseProduct(shape.semi_axes);
      const double f = superquadric_function(shape.semi_axes, shape.blockiness, stretched);
      const double rank = std::fmod((i + 0.5) * 0.6180339887498949, 1.0);
      points.push_back(stretched * std::pow(f, -1 / shape.blockiness) * std::cbrt(rank));
    }
    all.push_back(std::move(points));
  }
  return all;
}

double wetted_fraction(const DemSystem& rocks, std::size_t rock, const std::vector<Vec3>& points,
                       const NodeTable& table, const FluidNodes& nodes) {
  const Rocks& all = rocks.rocks();
  const Mat3 turn = all.q[rock].toRotationMatrix() * all.size[rock];
  double sum = 0;
  for (const Vec3& p : points) {
    const int node = table.nearest(all.x[rock] + turn * p);
    if (node < 0) continue;
    const double fill = nodes.fill[static_cast<std::size_t>(node)];
    if (fill > dry_fill) sum += std::min(1.0, fill);
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace sluice
