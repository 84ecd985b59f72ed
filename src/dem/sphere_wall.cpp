#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/wall_contact.h"

namespace sluice {

namespace {
constexpr double same_place = 1e-6;  // of the radius: nearest points closer than this are one

/// Side of the patch on which the sphere already is, or 0.
int remembered_side(std::span<const WallTouch> before, int patch) {
  for (const WallTouch& touch : before)
    if (touch.patch == patch && touch.feature == -1) return touch.side;
  return 0;
}

/// True if the nearest point of `hit` is no minimum of the distance to the whole surface: it lies on
/// a triangle that comes nearer, or behind one.
bool superseded(const WallSurface& surface, const std::vector<WallHit>& hits, std::size_t index,
                const Vec3& x, double tolerance) {
  const WallHit& hit = hits[index];
  for (std::size_t g = 0; g < hits.size(); ++g) {
    if (g == index) continue;
    const WallHit& other = hits[g];
    if ((other.nearest - hit.nearest).squaredNorm() <= tolerance * tolerance) {
      if (other.distance2 < hit.distance2 || (other.distance2 == hit.distance2 && g < index)) return true;
      continue;
    }
    if (other.distance2 >= hit.distance2) continue;
    const WallTriangle& t = surface.triangle(other.triangle);
    const double height = t.normal.dot(hit.nearest) - t.offset;
    if (std::abs(height) <= tolerance) {
      if (inside_triangle(t, hit.nearest, tolerance)) return true;
      continue;
    }
    const double from = t.normal.dot(x) - t.offset;
    if (from * height < 0) {
      const Vec3 crossing = x + (hit.nearest - x) * (from / (from - height));
      if (inside_triangle(t, crossing, tolerance)) return true;
    }
  }
  return false;
}
}  // namespace

double find_sphere_contacts(const WallSurface& surface, std::span<const int> triangles, const Vec3& x,
                            double radius, std::span<const WallTouch> before, WallScratch& scratch) {
  scratch.found.clear();
  scratch.hits.clear();
  double least2 = std::numeric_limits<double>::infinity();
  for (int index : triangles) {
    const WallTriangle& t = surface.triangle(index);
    const double height = t.normal.dot(x) - t.offset;
    if (std::abs(height) >= radius) {
      least2 = std::min(least2, height * height);
      continue;
    }
    const Vec3 nearest = closest_on_triangle(x, t.corner[0], t.corner[1], t.corner[2]);
    const double distance2 = (x - nearest).squaredNorm();
    least2 = std::min(least2, distance2);
    if (distance2 < radius * radius) scratch.hits.push_back({nearest, distance2, index});
  }
  const double tolerance = same_place * radius;
  for (std::size_t h = 0; h < scratch.hits.size(); ++h) {
    if (scratch.hits.size() > 1 && superseded(surface, scratch.hits, h, x, tolerance)) continue;
    const WallHit& hit = scratch.hits[h];
    const WallTriangle& t = surface.triangle(hit.triangle);
    const double height = t.normal.dot(x) - t.offset;
    WallTouch touch;
    touch.patch = t.patch;
    touch.wall = t.wall;
    touch.side = height >= 0 ? 1 : -1;
    const bool face = hit.distance2 - height * height <= tolerance * tolerance;
    if (face) {
      // The patch's own plane, so that every triangle of it gives the same bits.
      if (const int side = remembered_side(before, t.patch)) touch.side = side;
      touch.normal = -touch.side * t.normal;
      touch.overlap = radius - touch.side * height;
    } else {
      const double distance = std::sqrt(hit.distance2);
      touch.feature = 2 * hit.triangle;
      touch.normal = (hit.nearest - x) / distance;
      touch.overlap = radius - distance;
    }
    touch.point = x + (radius - 0.5 * touch.overlap) * touch.normal;
    scratch.found.push_back(touch);
  }
  return std::sqrt(least2) - radius;
}

}  // namespace sluice
