#pragma once
/// Questions to a set of triangles. Embree finds candidates in single precision, with a margin;
/// double precision decides. All calls are const and may run in parallel.

#include <memory>
#include <optional>
#include <vector>

#include "geometry/tri_mesh.h"

namespace sluice {

struct NearestPoint {
  int triangle = -1;
  Vec3 point = Vec3::Zero();  ///< [m]
  double distance = 0;        ///< [m]
};

struct SegmentHit {
  int triangle = -1;
  double s = 0;               ///< along the segment, 0 at its start and 1 at its end
  Vec3 point = Vec3::Zero();  ///< [m]
};

class SurfaceQuery {
 public:
  /// Keeps its own copy of the corners; the mesh may go.
  explicit SurfaceQuery(const TriMesh& mesh);
  ~SurfaceQuery();
  SurfaceQuery(const SurfaceQuery&) = delete;
  SurfaceQuery& operator=(const SurfaceQuery&) = delete;

  /// Triangles whose bounding box meets the closed box, ascending; `found` is cleared first.
  void triangles_in(const Box& box, std::vector<int>& found) const;
  /// Nearest point of the surface within `reach` [m]; of equally near triangles the lowest.
  std::optional<NearestPoint> nearest(const Vec3& x, double reach) const;
  /// First triangle that the closed segment a-b crosses or touches; ties go to the lowest triangle.
  /// Watertight, by exact signs: a segment through a shared edge or vertex hits at least one triangle.
  /// A segment inside a triangle's plane hits where it enters the triangle. Triangles without area are
  /// not there.
  std::optional<SegmentHit> first_hit(const Vec3& a, const Vec3& b) const;
  /// Number of crossings of the ray x + s d, s > 0 (for the inside test).
  int crossings(const Vec3& x, const Vec3& d) const;
  /// True if x is inside the closed surface: majority of three rays.
  bool inside(const Vec3& x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Point of a triangle closest to x (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 closest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace sluice
