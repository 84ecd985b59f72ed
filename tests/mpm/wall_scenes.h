#pragma once
/// Small scenes that try every way in which walls can stand to a grid.

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/domain.h"
#include "base/parallel.h"
#include "geometry/wall.h"

namespace sluice::wall_scenes {

constexpr double spacing = 0.05;                 ///< [m]
inline const Vec3 origin{0.013, -0.021, 0.007};  ///< of the grid [m]

inline Vec3 place_of(const Vec3i& node) {
  return origin + spacing * node.cast<double>();
}
inline Vec3i base_of(const Vec3& x) {
  return ((x - origin) / spacing - Vec3::Constant(0.5)).array().floor().matrix().cast<int>();
}

struct Scene {
  Walls walls;
  Domain domain;
  Box look;                    ///< where points are tried; no wall ends unseen here
  Vec3 corner = Vec3::Zero();  ///< a place that the scene is about
  /// True where a segment through this place of an edge has to hit, whatever its direction.
  std::function<bool(const Vec3&)> seams_are_shared = [](const Vec3&) { return false; };
};

inline Scene make_scene(std::vector<TriMesh> meshes, const Vec3& corner, double look_cells) {
  std::vector<Wall> walls;
  for (TriMesh& m : meshes) {
    walls.emplace_back();
    walls.back().mesh = std::move(m);
  }
  Scene scene;
  scene.walls = Walls(std::move(walls));
  scene.look = Box{corner, corner}.grown(look_cells * spacing);
  scene.domain.box = scene.look.grown(2 * spacing);
  scene.corner = corner;
  return scene;
}

/// Rectangle about a centre, spanned by two half edges given in cells.
inline TriMesh sheet(const Vec3& centre, const Vec3& half_a, const Vec3& half_b) {
  const Vec3 a = spacing * half_a, b = spacing * half_b;
  return make_rectangle("sheet", {centre - a - b, centre + a - b, centre + a + b, centre - a + b});
}

inline Scene sheet_at(double shift) {
  const Vec3 middle = place_of({0, 0, 1}) - Vec3(0, 0, shift * spacing);
  return make_scene({sheet(middle, {30, 0, 0}, {0, 30, 0})}, middle, 5);
}
inline Scene sheet_on_nodes() {
  const Vec3 middle = place_of({0, 0, 0});
  Scene scene = make_scene({sheet(middle, {30, 0, 0}, {0, 30, 0})}, middle, 5);
  scene.seams_are_shared = [](const Vec3&) { return true; };
  return scene;
}
inline Scene tilted_sheet(double degrees) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  const Vec3 middle = place_of({0, 0, 0}) + Vec3(0.004, 0.002, 0.011);
  Scene scene = make_scene({sheet(middle, Vec3(30 * c, 0, 30 * s), {0, 30, 0})}, middle, 5);
  scene.seams_are_shared = [](const Vec3&) { return true; };
  return scene;
}
/// A sheet that ends at the corner, in the middle of the scene.
inline Scene lip() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.4, 0.3, 0.35) * spacing;
  return make_scene({sheet(corner - Vec3(30 * spacing, 0, 0), {30, 0, 0}, {0, 30, 0})}, corner, 5);
}
/// The same with every triangle twice, and one triangle without area.
inline Scene damaged_lip() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.4, 0.3, 0.35) * spacing;
  TriMesh mesh = sheet(corner - Vec3(30 * spacing, 0, 0), {30, 0, 0}, {0, 30, 0});
  mesh.append(TriMesh(mesh));
  mesh.triangles.push_back({1, 2, 1});
  mesh.part.push_back(0);
  return make_scene({mesh}, corner, 5);
}
/// A lip that follows grid lines.
inline Scene lip_on_nodes() {
  const Vec3 corner = place_of({0, 0, 0});
  return make_scene({sheet(corner - Vec3(30 * spacing, 0, 0), {30, 0, 0}, {0, 30, 0})}, corner, 3);
}
inline Scene t_joint() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.2, 0.3, 0.65) * spacing;
  return make_scene({sheet(corner, {30, 0, 0}, {0, 30, 0}),
                     sheet(corner + Vec3(0, 0, 15 * spacing), {0, 30, 0}, {0, 0, 15})},
                    corner, 4);
}
/// Two sheets that meet at 30 degrees.
inline Scene wedge() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.1, 0.3, 0.25) * spacing;
  const Vec3 along = 15 * Vec3(std::cos(M_PI / 6), 0, std::sin(M_PI / 6));
  return make_scene({sheet(corner + Vec3(15 * spacing, 0, 0), {15, 0, 0}, {0, 30, 0}),
                     sheet(corner + spacing * along, along, {0, 30, 0})},
                    corner, 4);
}
/// Inside a box near its lowest corner, which lies on a node.
inline Scene corner_box() {
  const Vec3 corner = place_of({0, 0, 0});
  Scene scene = make_scene({make_box("box", {corner, corner + Vec3::Constant(40 * spacing)})}, corner, 6);
  // Every segment through the edges from inside to outside has to hit; those through a corner's outside not
  scene.seams_are_shared = [corner](const Vec3& x) { return ((x - corner).array() > 1e-9).count() >= 2; };
  return scene;
}
/// A closed plate a tenth of a cell thick, with one rim in the scene.
inline Scene thin_plate() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.2, 0.1, 0.3) * spacing;
  const Vec3 half(30 * spacing, 30 * spacing, 0.05 * spacing);
  return make_scene({make_box("plate", {corner - half, corner + half})}, corner, 4);
}
inline Scene plate_rim() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.2, 0.1, 0.3) * spacing;
  const Vec3 lo(60 * spacing, 30 * spacing, 0.05 * spacing), hi(0, 30 * spacing, 0.05 * spacing);
  return make_scene({make_box("plate", {corner - lo, corner + hi})}, corner, 3);
}
inline Scene two_sheets() {
  const Vec3 corner = place_of({0, 0, 0}) + Vec3(0.2, 0.1, 0.3) * spacing;
  return make_scene(
      {sheet(corner, {30, 0, 0}, {0, 30, 0}), sheet(corner - Vec3(0, 0, spacing), {30, 0, 0}, {0, 30, 0})},
      corner, 4);
}
/// A trough of radius `radius` cells in facets of `facet` cells, corners shared.
inline TriMesh trough(const Vec3& bottom, double radius, double facet, double half_width) {
  TriMesh mesh;
  mesh.part_names = {"trough"};
  const int across = static_cast<int>(std::ceil(half_width / facet));
  auto at = [&](int i, int j) {
    const double angle = facet / radius * i;
    return Vec3(bottom + spacing * Vec3(radius * std::sin(angle), facet * j, radius * (1 - std::cos(angle))));
  };
  for (int i = -across; i <= across; ++i)
    for (int j = -across; j <= across; ++j) mesh.vertices.push_back(at(i, j));
  const int row = 2 * across + 1;
  for (int i = 0; i + 1 < row; ++i) {
    for (int j = 0; j + 1 < row; ++j) {
      const int a = i * row + j, b = a + row;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
      mesh.part.insert(mesh.part.end(), 2, 0);
    }
  }
  return mesh;
}
inline Scene curved_floor() {
  const Vec3 bottom = place_of({0, 0, 0}) + Vec3(0.2, 0.1, 0.3) * spacing;
  Scene scene = make_scene({trough(bottom, 12, 1.3, 10)}, bottom, 4);
  scene.seams_are_shared = [](const Vec3&) { return true; };
  return scene;
}
inline Scene tiny_triangles() {
  const Vec3 bottom = place_of({0, 0, 0}) + Vec3(0.2, 0.1, 0.3) * spacing;
  Scene scene = make_scene({trough(bottom, 5, 0.3, 5)}, bottom, 1.5);
  scene.seams_are_shared = [](const Vec3&) { return true; };
  return scene;
}

inline std::vector<std::pair<std::string, std::function<Scene()>>> all_scenes() {
  return {{"sheet on nodes", sheet_on_nodes},
          {"sheet at 17 degrees", [] { return tilted_sheet(17); }},
          {"sheet at 45 degrees", [] { return tilted_sheet(45); }},
          {"lip", lip},
          {"damaged lip", damaged_lip},
          {"lip on nodes", lip_on_nodes},
          {"T-joint", t_joint},
          {"wedge", wedge},
          {"corner of a box", corner_box},
          {"thin plate", thin_plate},
          {"rim of a plate", plate_rim},
          {"two sheets", two_sheets},
          {"curved floor", curved_floor},
          {"tiny triangles", tiny_triangles}};
}

}  // namespace sluice::wall_scenes
