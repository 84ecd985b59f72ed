#include <algorithm>
#include <cmath>

#include "dem/rock_shape.h"
#include "dem/wall_contact.h"

namespace sluice {

namespace {
constexpr double same_place = 1e-6;  // of the least semi-axis: contacts closer than this are one

struct Search {
  const WallSurface& surface;
  std::span<const int> triangles;  ///< all that are near
  const Superquadric& body;
  double bounding_radius;
  std::span<const WallTouch> before;
  WallScratch& scratch;
  double tolerance;
};

const WallTouch* remembered(const Search& s, int patch, int feature) {
  for (const WallTouch& touch : s.before)
    if (touch.feature == feature && (feature >= 0 || touch.patch == patch)) return &touch;
  return nullptr;
}

bool touches_face(const std::vector<WallTouch>& found, int patch) {
  return std::any_of(found.begin(), found.end(),
                     [&](const WallTouch& touch) { return touch.feature == -1 && touch.patch == patch; });
}

Vec3 on_wall(const WallTouch& touch) {
  return touch.point - 0.5 * touch.overlap * touch.normal;
}

/// The foot of the body's lowest point must lie in one of the patch's triangles.
/// @return gap that the body is apart from its plane at least; not above 0 where it reaches through [m]
double add_face(const Search& s, const WallTriangle& patch, double deepest) {
  const double height = patch.normal.dot(s.body.x) - patch.offset;
  if (std::abs(height) >= s.bounding_radius) return std::abs(height) - s.bounding_radius;
  const WallTouch* known = remembered(s, patch.patch, -1);
  WallTouch touch;
  touch.patch = patch.patch;
  touch.wall = patch.wall;
  touch.side = known ? known->side : height >= 0 ? 1 : -1;
  const Vec3 n = touch.side * patch.normal;
  const ContactGeometry geometry = superquadric_plane(s.body, patch.offset * patch.normal, n);
  if (geometry.overlap <= 0 || (!known && geometry.overlap > deepest)) return -geometry.overlap;
  touch.normal = geometry.normal;
  touch.point = geometry.point;
  touch.overlap = geometry.overlap;
  const Vec3 foot = on_wall(touch);
  const bool inside = std::any_of(s.triangles.begin(), s.triangles.end(), [&](int t) {
    const WallTriangle& triangle = s.surface.triangle(t);
    return triangle.patch == patch.patch && inside_triangle(triangle, foot, 0);
  });
  if (inside) s.scratch.found.push_back(touch);
  return -geometry.overlap;
}

/// Drops faces that lie behind another one that is touched, as the far face of a thin plate does.
void drop_hidden_faces(const Search& s) {
  std::vector<WallTouch>& found = s.scratch.found;
  if (found.size() < 2) return;
  const auto hidden = [&](const WallTouch& touch) {
    const Vec3 foot = on_wall(touch);
    return std::any_of(s.triangles.begin(), s.triangles.end(), [&](int index) {
      const WallTriangle& t = s.surface.triangle(index);
      if (t.patch == touch.patch || !touches_face(found, t.patch)) return false;
      const double from = t.normal.dot(s.body.x) - t.offset, to = t.normal.dot(foot) - t.offset;
      if (from * to >= 0 || std::abs(to) <= s.tolerance) return false;
      return inside_triangle(t, s.body.x + (foot - s.body.x) * (from / (from - to)), 0);
    });
  };
  // One after the other, each against those that remain.
  for (std::size_t f = 0; f < found.size();)
    if (hidden(found[f]))
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(f));
    else
      ++f;
}

/// True if the place is already a contact, or lies on a face that is touched elsewhere.
bool already_touched(const Search& s, const Vec3& place) {
  for (const WallTouch& touch : s.scratch.found)
    if ((on_wall(touch) - place).norm() <= s.tolerance) return true;
  for (int index : s.triangles) {
    const WallTriangle& t = s.surface.triangle(index);
    if (std::abs(t.normal.dot(place) - t.offset) > s.tolerance || !touches_face(s.scratch.found, t.patch))
      continue;
    if (inside_triangle(t, place, s.tolerance)) return true;
  }
  return false;
}

/// Gap at least between the two, by a plane through the feature's point nearest to the centre; below 0 where
/// that does not part them [m].
double gap_at_least(const Search& s, const WallFeature& feature) {
  const Vec3 along = feature.end[1] - feature.end[0];
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(along.dot(s.body.x - feature.end[0]) / length2, 0.0, 1.0) : 0.0;
  const Vec3 away = s.body.x - feature.end[0] - t * along;
  const double distance = away.norm();
  if (distance >= s.bounding_radius) return distance - s.bounding_radius;
  if (distance == 0) return -s.bounding_radius;
  return distance - support_height(s.body.semi_axes, s.body.m, s.body.q.conjugate() * (-away / distance));
}

/// @return gap as gap_at_least
double add_feature(const Search& s, const WallFeature& feature, int label) {
  const double gap = gap_at_least(s, feature);
  if (gap >= 0) return gap;
  const bool is_edge = label % 2 == 0;
  const WallTouch* known = remembered(s, feature.patch, label);
  WallTouch touch;
  touch.patch = feature.patch;
  touch.wall = feature.wall;
  touch.feature = label;
  if (known) touch.start = known->start;
  ContactGeometry geometry;
  const bool touches =
      is_edge ? superquadric_segment(s.body, feature.end[0], feature.end[1], touch.start, geometry)
              : superquadric_point(s.body, feature.end[0], touch.start, geometry);
  if (!touches || geometry.overlap <= 0 || !feature.admits(-geometry.normal)) return gap;
  touch.normal = geometry.normal;
  touch.point = geometry.point;
  touch.overlap = geometry.overlap;
  if (!already_touched(s, on_wall(touch))) s.scratch.found.push_back(touch);
  return gap;
}
}  // namespace

void find_superquadric_contacts(const WallSurface& surface, WallParts& parts, std::size_t copy,
                                const Superquadric& body, double bounding_radius, double deepest,
                                std::span<const WallTouch> before, WallScratch& scratch) {
  scratch.found.clear();
  const Search s{surface,
                 parts.triangles,
                 body,
                 bounding_radius,
                 before,
                 scratch,
                 same_place * body.semi_axes.minCoeff()};
  std::size_t part = 0;
  const auto look_at = [&](std::span<const int> some, const auto& add) {
    for (const int one : some) {
      if (!parts.is_clear(copy, part)) parts.set_gap(copy, part, add(one), bounding_radius);
      ++part;
    }
  };
  look_at(parts.patches(), [&](int t) { return add_face(s, surface.triangle(t), deepest); });
  drop_hidden_faces(s);
  look_at(parts.edges(), [&](int e) { return add_feature(s, surface.edge(e), 2 * e); });
  look_at(parts.vertices(), [&](int v) { return add_feature(s, surface.vertex(v), 2 * v + 1); });
}

}  // namespace sluice
