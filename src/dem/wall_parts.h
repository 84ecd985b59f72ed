#pragma once
/// The parts of the walls near a rock, and which of them it cannot have reached yet.
///
/// A part from which a rock was a gap apart is not looked at again before some point of the rock may have
/// gone that far: what is left out could not have touched, so that contacts are the same bit for bit. Travel
/// is the sum over the steps of what the centre moved and of what turning moved the point farthest from it.

#include <limits>
#include <span>
#include <vector>

#include "base/vec.h"
#include "dem/wall_surface.h"

namespace sluice {

class WallParts {
 public:
  std::vector<int> triangles;  ///< ascending; call list() when they have changed

  /// Lists the patches, edges and vertices of the triangles; none counts as clear.
  void list(const WallSurface& surface);
  /// Takes the rock to where it is now. @param radius  of the ball about it [m]
  /// @param turns  whether turning moves its surface: not that of a sphere
  void follow(const Vec3& x, const Quat& q, double radius, bool turns);
  /// True while the rock cannot touch any part.
  bool quiet() const { return travel_ < quiet_until_; }

  /// One triangle of each patch, in order; then edges and vertices, by index of the WallSurface.
  std::span<const int> patches() const { return std::span(parts_).first(patches_); }
  std::span<const int> edges() const { return std::span(parts_).subspan(patches_, edges_); }
  std::span<const int> vertices() const { return std::span(parts_).subspan(patches_ + edges_); }
  std::size_t count() const { return parts_.size(); }

  /// Before the parts are asked about. @param copies  of the rock, each with gaps of its own
  void begin_search(std::size_t copies);
  /// @param part  counted through patches, edges and vertices
  bool is_clear(std::size_t copy, std::size_t part) const {
    return travel_ < clear_until_[copy * count() + part];
  }
  /// @param gap  that the rock is apart from it at least [m]; not above 0 where they may touch
  /// @param size  of the rock: what a gap is measured to, by far [m]
  void set_gap(std::size_t copy, std::size_t part, double gap, double size) {
    clear_until_[copy * count() + part] = travel_ + gap - rounding * size;
  }
  /// After the parts were asked about.
  void end_search();
  /// The same for a rock that keeps only its least gap, from all parts.
  void set_least_gap(double gap, double size) { quiet_until_ = travel_ + gap - rounding * size; }

  std::size_t memory_bytes() const {
    return (triangles.capacity() + parts_.capacity()) * sizeof(int) +
           clear_until_.capacity() * sizeof(double);
  }

 private:
  static constexpr double rounding = 1e-6;  ///< of a gap and of the sum of a travel, of the rock's size

  void forget();

  double travel_ = 0, quiet_until_ = 0;  ///< [m]
  Vec3 x_ = Vec3::Zero();
  Quat q_ = Quat::Identity();
  std::vector<int> parts_;
  std::size_t patches_ = 0, edges_ = 0;
  std::vector<double> clear_until_;  ///< travel [m], by copy and part
};

}  // namespace sluice
