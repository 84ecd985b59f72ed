#include <algorithm>
#include <cmath>

#include "dem/rock_shape.h"
#include "dem/wall_contact.h"

namespace sluice {

namespace {
constexpr double same_place = 1e-6;  // of the least semi-axis: contacts closer than this are one

struct Search {
  const WallSurface& surface;
  std::span<const int> triangles;
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
void add_face(const Search& s, const WallTriangle& patch, double deepest) {
  const double height = patch.normal.dot(s.body.x) - patch.offset;
  if (std::abs(height) >= s.bounding_radius) return;
  const WallTouch* known = remembered(s, patch.patch, -1);
  WallTouch touch;
  touch.patch = patch.patch;
  touch.wall = patch.wall;
  touch.side = known ? known->side : height >= 0 ? 1 : -1;
  const Vec3 n = touch.side * patch.normal;
  const ContactGeometry geometry = superquadric_plane(s.body, patch.offset * patch.normal, n);
  if (geometry.overlap <= 0 || (!known && geometry.overlap > deepest)) return;
  touch.normal = geometry.normal;
  touch.point = geometry.point;
  touch.overlap = geometry.overlap;
  const Vec3 foot = on_wall(touch);
  const bool inside = std::any_of(s.triangles.begin(), s.triangles.end(), [&](int t) {
    const WallTriangle& triangle = s.surface.triangle(t);
    return triangle.patch == patch.patch && inside_triangle(triangle, foot, 0);
  });
  if (inside) s.scratch.found.push_back(touch);
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

/// True if a plane through the feature's point nearest to the centre parts the two.
bool apart(const Search& s, const WallFeature& feature) {
  const Vec3 along = feature.end[1] - feature.end[0];
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(along.dot(s.body.x - feature.end[0]) / length2, 0.0, 1.0) : 0.0;
  const Vec3 away = s.body.x - feature.end[0] - t * along;
  const double distance = away.norm();
  if (distance >= s.bounding_radius) return true;
  if (distance == 0) return false;
  return support_height(s.body.semi_axes, s.body.m, s.body.q.conjugate() * (-away / distance)) <= distance;
}

void add_feature(const Search& s, const WallFeature& feature, int label) {
  if (apart(s, feature)) return;
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
  if (!touches || geometry.overlap <= 0 || !feature.admits(-geometry.normal)) return;
  touch.normal = geometry.normal;
  touch.point = geometry.point;
  touch.overlap = geometry.overlap;
  if (!already_touched(s, on_wall(touch))) s.scratch.found.push_back(touch);
}

template <class Id>
void unique_ids(const Search& s, std::vector<int>& ids, const Id& id) {
  ids.clear();
  for (int t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const int value = id(s.surface.triangle(t), k); value >= 0) ids.push_back(value);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}
}  // namespace

void find_superquadric_contacts(const WallSurface& surface, std::span<const int> triangles,
                                const Superquadric& body, double bounding_radius, double deepest,
                                std::span<const WallTouch> before, WallScratch& scratch) {
  scratch.found.clear();
  const Search s{
      surface, triangles, body, bounding_radius, before, scratch, same_place * body.semi_axes.minCoeff()};
  std::vector<int>& ids = scratch.features;
  ids.clear();
  for (int t : triangles) {
    const WallTriangle& triangle = surface.triangle(t);
    if (std::find(ids.begin(), ids.end(), triangle.patch) != ids.end()) continue;
    ids.push_back(triangle.patch);
    add_face(s, triangle, deepest);
  }
  drop_hidden_faces(s);
  unique_ids(s, ids, [](const WallTriangle& t, std::size_t k) { return t.edge[k]; });
  for (int e : ids) add_feature(s, surface.edge(e), 2 * e);
  unique_ids(s, ids, [](const WallTriangle& t, std::size_t k) { return t.vertex[k]; });
  for (int v : ids) add_feature(s, surface.vertex(v), 2 * v + 1);
}

}  // namespace sluice
