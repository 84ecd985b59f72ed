#include "coupling/wetting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace sluice {

namespace {
constexpr std::size_t row = 16;  // points side by side
}

FillTable::FillTable(const Domain& domain, double spacing) : domain_(domain), spacing_(spacing) {
  // Cells beyond the box on each side: the fluid's outermost nodes stand there.
  for (int k = 0; k < 3; ++k) {
    const double margin = domain.periodic(k) ? 0 : 2 * spacing;
    origin_[k] = domain.box.lo[k] - margin;
    cells_[k] = static_cast<int>(std::ceil((domain.box.size()[k] + 2 * margin) / spacing - 1e-6)) + 1;
    period_[k] = std::max(1, static_cast<int>(std::lround(domain.box.size()[k] / spacing)));
  }
  table_.assign(static_cast<std::size_t>(cells_.cast<long>().prod()), 0.0F);
}

int FillTable::slot(int i, int j, int k) const {
  int index[3] = {i, j, k};
  for (int a = 0; a < 3; ++a) {
    if (domain_.periodic(a)) {
      index[a] = ((index[a] % period_[a]) + period_[a]) % period_[a];
    } else if (index[a] < 0 || index[a] >= cells_[a]) {
      return -1;
    }
  }
  return index[0] + cells_.x() * (index[1] + cells_.y() * index[2]);
}

void FillTable::set(const FluidNodes& nodes, std::span<const double> fill) {
  parallel_for(
      filled_.size(), [&](std::size_t i) { table_[static_cast<std::size_t>(filled_[i])] = 0; }, 4096);
  filled_.assign(nodes.count(), 0);
  parallel_for(
      nodes.count(),
      [&](std::size_t i) {
        const Vec3 place = (nodes.x[i] - origin_) / spacing_ + Vec3::Constant(0.5);
        const int s = slot(static_cast<int>(std::floor(place.x())), static_cast<int>(std::floor(place.y())),
                           static_cast<int>(std::floor(place.z())));
        if (s < 0) return;
        filled_[i] = s;
        table_[static_cast<std::size_t>(s)] =
            fill[i] > dry_fill ? static_cast<float>(std::min(1.0, fill[i])) : 0.0F;
      },
      4096);
}

double FillTable::wetted_fraction(const WettingPoints& points, const Vec3& centre, const Mat3& turn,
                                  double reach) const {
  // Points as cells above the lowest cell of the rock's box: never negative, so a cut is a floor.
  const Vec3 place = (centre - origin_) / spacing_ + Vec3::Constant(0.5);
  const double half = reach / spacing_ * (1 + 1e-6) + 1e-6;
  int low[3];
  float at[3];
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    low[k] = static_cast<int>(std::floor(place[k] - half));
    at[k] = static_cast<float>(place[k] - low[k]);
    const int end = domain_.periodic(k) ? period_[k] : cells_[k];
    inside = inside && low[k] >= 0 && place[k] + half < end;
  }
  float m[3][3];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) m[a][b] = static_cast<float>(turn(a, b) / spacing_);
  const int stride_y = cells_.x(), stride_z = cells_.x() * cells_.y();
  const int first = low[0] + stride_y * low[1] + stride_z * low[2];

  // Sums in lanes, then over the lanes: one order, whatever the processor does side by side.
  std::array<float, row> sum{};
  for (std::size_t from = 0; from < points.count(); from += row) {
    const std::size_t n = std::min(row, points.count() - from);
    const float *x = points.x.data() + from, *y = points.y.data() + from, *z = points.z.data() + from;
    const auto cell = [&](int axis, std::size_t p) {
      const float* turned = m[axis];
      return static_cast<int>(at[axis] + turned[0] * x[p] + turned[1] * y[p] + turned[2] * z[p]);
    };
    if (n == row && inside) {
      std::array<int, row> at_slot;
      for (std::size_t p = 0; p < row; ++p)
        at_slot[p] = first + cell(0, p) + stride_y * cell(1, p) + stride_z * cell(2, p);
      for (std::size_t p = 0; p < row; ++p) sum[p] += table_[static_cast<std::size_t>(at_slot[p])];
      continue;
    }
    for (std::size_t p = 0; p < n; ++p) {
      const int s = slot(low[0] + cell(0, p), low[1] + cell(1, p), low[2] + cell(2, p));
      if (s >= 0) sum[p] += table_[static_cast<std::size_t>(s)];
    }
  }
  double total = 0;
  for (const float s : sum) total += static_cast<double>(s);
  return total / static_cast<double>(points.count());
}

std::vector<WettingPoints> wetting_points(const std::vector<RockShape>& shapes, int per_rock) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<WettingPoints> all;
  for (const RockShape& shape : shapes) {
    WettingPoints points;
    for (int i = 0; i < per_rock; ++i) {
      // Directions on a Fibonacci spiral; radii in a shuffled order, even by volume.
      const double z = 1 - (2 * i + 1.0) / per_rock;
      const double r = std::sqrt(1 - z * z);
      const Vec3 stretched =
          Vec3(r * std::cos(golden * i), r * std::sin(golden * i), z).cwiseProduct(shape.semi_axes);
      const double f = superquadric_function(shape.semi_axes, shape.blockiness, stretched);
      const double rank = std::fmod((i + 0.5) * 0.6180339887498949, 1.0);
      const Vec3 point = stretched * std::pow(f, -1 / shape.blockiness) * std::cbrt(rank);
      points.x.push_back(static_cast<float>(point.x()));
      points.y.push_back(static_cast<float>(point.y()));
      points.z.push_back(static_cast<float>(point.z()));
    }
    all.push_back(std::move(points));
  }
  return all;
}

std::vector<WettingPoints> skin_points(const std::vector<RockShape>& shapes, int per_rock) {
  std::vector<WettingPoints> all;
  for (const RockShape& shape : shapes) {
    WettingPoints points;
    for (const Vec3& x : surface_points(shape.semi_axes, shape.blockiness, per_rock)) {
      points.x.push_back(static_cast<float>(x.x()));
      points.y.push_back(static_cast<float>(x.y()));
      points.z.push_back(static_cast<float>(x.z()));
    }
    all.push_back(std::move(points));
  }
  return all;
}

}  // namespace sluice
