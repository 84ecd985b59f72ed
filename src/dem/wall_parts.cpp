#include "dem/wall_parts.h"

#include <algorithm>

namespace sluice {

namespace {
/// Chord between two unit quaternions up to which the turn is at most 1.001 times twice the chord.
constexpr double small_turn = 0.1;
/// Travel after which its sum begins anew, of the radius: long before its rounding reaches that of a gap.
constexpr double longest_travel = 1e3;

/// Appends what `of` gives for each corner of the triangles, ascending, each once.
template <class Of>
void append_each(const std::vector<int>& triangles, std::vector<int>& parts, const Of& of) {
  const auto first = static_cast<std::ptrdiff_t>(parts.size());
  for (const int t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const int part = of(t, k); part >= 0) parts.push_back(part);
  std::sort(parts.begin() + first, parts.end());
  parts.erase(std::unique(parts.begin() + first, parts.end()), parts.end());
}
}  // namespace

void WallParts::list(const WallSurface& surface) {
  parts_.clear();
  for (const int t : triangles) {
    const int patch = surface.triangle(t).patch;
    if (std::none_of(parts_.begin(), parts_.end(),
                     [&](int known) { return surface.triangle(known).patch == patch; }))
      parts_.push_back(t);
  }
  patches_ = parts_.size();
  append_each(triangles, parts_, [&](int t, std::size_t k) { return surface.triangle(t).edge[k]; });
  edges_ = parts_.size() - patches_;
  append_each(triangles, parts_, [&](int t, std::size_t k) { return surface.triangle(t).vertex[k]; });
  forget();
}

void WallParts::forget() {
  travel_ = quiet_until_ = 0;
  clear_until_.clear();
}

void WallParts::follow(const Vec3& x, const Quat& q, double radius, bool turns) {
  double moved = (x - x_).norm();
  if (turns) {
    const double chord = (q.coeffs() - q_.coeffs()).norm();
    moved += radius * (chord < small_turn ? 2.002 * chord : 2.0);
    q_ = q;
  }
  x_ = x;
  travel_ += moved;
  if (travel_ > longest_travel * radius) forget();
}

void WallParts::begin_search(std::size_t copies) {
  if (clear_until_.size() != copies * count()) clear_until_.assign(copies * count(), 0.0);
}

void WallParts::end_search() {
  quiet_until_ = std::numeric_limits<double>::infinity();
  for (const double one : clear_until_) quiet_until_ = std::min(quiet_until_, one);
}

}  // namespace sluice
