#include "mpm/block_layout.h"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.h"

namespace sluice {

namespace {
/// Cells beyond an open or walled face: a point that left is found and removed a step later.
constexpr int margin = 4;
constexpr double largest_block_count = 3.0e7;  // keys of cells are 32 bits

InputError bad_grid(const std::string& problem, const std::string& reason, const std::string& suggestion) {
  InputProblem found;
  found.key = "spacing";
  found.problem = problem;
  found.reason = reason;
  found.suggestion = suggestion;
  return InputError(std::move(found));
}
}  // namespace

BlockLayout::BlockLayout(const Domain& domain, double h) : h_(h) {
  if (!(h > 0) || !std::isfinite(h))
    throw bad_grid("is not a length above 0", "the water grid needs one", "");
  const Vec3 size = domain.box.size();
  if (domain.box.empty() || !size.allFinite())
    throw bad_grid("has no domain to fill", "the domain's box is empty or not finite", "give 'domain: box'");
  double blocks = 1;
  for (int axis = 0; axis < 3; ++axis) {
    periodic_[axis] = domain.periodic(axis);
    const double cells = size[axis] / h;
    if (cells > 1e6)
      throw bad_grid("is too fine for the domain", "more than a million cells along an axis", "");
    if (periodic_[axis]) {
      const double whole = std::nearbyint(cells);
      if (whole < 1 || std::abs(cells - whole) > 1e-6 * whole)
        throw bad_grid(
            fmt::format("of {:.6g} m does not divide the periodic length of {:.6g} m", h, size[axis]),
            fmt::format("{:.6g} cells along axis {}", cells, axis),
            fmt::format("use {:.6g} m", size[axis] / std::max(1.0, whole)));
      cells_[axis] = static_cast<int>(whole);
      origin_[axis] = domain.box.lo[axis];
    } else {
      const int needed = static_cast<int>(std::ceil(cells)) + 1 + 2 * margin;
      cells_[axis] = (needed + edge - 1) / edge * edge;
      origin_[axis] = domain.box.lo[axis] - margin * h;
    }
    blocks_[axis] = (cells_[axis] + edge - 1) / edge;
    blocks *= blocks_[axis];
  }
  if (blocks > largest_block_count)
    throw bad_grid("is too fine for the domain", fmt::format("{:.3g} blocks of 64 cells", blocks),
                   "raise it or make the domain smaller");
}

std::int32_t BlockLayout::neighbour(const Vec3i& place, int dx, int dy, int dz) const {
  Vec3i there = place + Vec3i(dx, dy, dz);
  for (int axis = 0; axis < 3; ++axis) {
    if (periodic_[axis]) {
      there[axis] = (there[axis] + blocks_[axis]) % blocks_[axis];
    } else if (there[axis] < 0 || there[axis] >= blocks_[axis]) {
      return none;
    }
  }
  return there.x() + blocks_.x() * (there.y() + blocks_.y() * there.z());
}

std::int32_t BlockLayout::key(Vec3i cell) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (periodic_[axis]) {
      cell[axis] %= cells_[axis];
      if (cell[axis] < 0) cell[axis] += cells_[axis];
    } else if (cell[axis] < 1 || cell[axis] > cells_[axis] - 2) {
      return none;
    }
  }
  const Vec3i place(cell.x() / edge, cell.y() / edge, cell.z() / edge);
  const Vec3i local = cell - edge * place;
  const std::int32_t block = place.x() + blocks_.x() * (place.y() + blocks_.y() * place.z());
  return (block << 6) + local.x() + 4 * local.y() + 16 * local.z();
}

}  // namespace sluice
