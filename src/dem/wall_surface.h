#pragma once
/// The walls as rocks meet them: coplanar triangles of one wall merged into plane patches, so that a
/// plane is one plane whatever its triangulation; edges and vertices only where the surface bends or
/// ends, each with the directions in which the surface goes on from there.
///
/// Corners closer than a millionth of the walls' extent count as one, since STL has no shared
/// vertices; a triangle belongs to a patch if its corners lie in the patch's plane to the same length.

#include <array>
#include <vector>

#include "geometry/wall.h"

namespace sluice {

struct WallTriangle {
  std::array<Vec3, 3> corner;  ///< [m]
  Vec3 normal = Vec3::Zero();  ///< of the patch, unit
  double offset = 0;           ///< normal . x on the patch's plane [m]
  int patch = -1;              ///< -1: rocks pass (water only, or without area)
  int wall = 0;
  std::array<int, 3> edge{-1, -1, -1};    ///< from corner k to k + 1; -1 where the surface goes on flat
  std::array<int, 3> vertex{-1, -1, -1};  ///< -1 where no edge ends
  std::array<Vec3, 3> inward;             ///< unit, in its plane, away from side k into it; only of a patch's
};

/// An edge or a vertex: a body touches it only along directions u (wall to body) with u . d <= 0 for
/// every direction d in which the surface goes on, its normal cone.
struct WallFeature {
  std::array<Vec3, 2> end;  ///< [m]; both the same for a vertex
  int patch = 0;
  int wall = 0;
  std::vector<Vec3> onward;  ///< unit
  bool admits(const Vec3& u) const;
};

class WallSurface {
 public:
  explicit WallSurface(const Walls& walls);

  const std::vector<WallTriangle>& triangles() const { return triangles_; }
  const WallTriangle& triangle(int t) const { return triangles_[static_cast<std::size_t>(t)]; }
  const WallFeature& edge(int e) const { return edges_[static_cast<std::size_t>(e)]; }
  const WallFeature& vertex(int v) const { return vertices_[static_cast<std::size_t>(v)]; }
  std::size_t patch_count() const { return patches_; }
  std::size_t edge_count() const { return edges_.size(); }
  std::size_t memory_bytes() const;

 private:
  void merge_patches(const std::vector<std::array<int, 3>>& corners, double tolerance);
  void find_features(const std::vector<std::array<int, 3>>& corners);

  std::vector<WallTriangle> triangles_;
  std::vector<WallFeature> edges_, vertices_;
  std::size_t patches_ = 0;
};

/// True if a point of a triangle's plane lies in the triangle, its border included, to within `tolerance`
/// [m].
bool inside_triangle(const WallTriangle& triangle, const Vec3& x, double tolerance);

}  // namespace sluice
