#include "reports/picture.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "output/rock_mesh.h"

namespace sluice {
namespace {

const Colour stone(0.70F, 0.64F, 0.56F), plate(0.46F, 0.55F, 0.64F), plate_edge(0.20F, 0.27F, 0.36F);
constexpr float plate_alpha = 0.085F, edge_alpha = 0.55F;

Vec3 point(const std::vector<float>& x, std::size_t i) {
  return {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
}

/// Stones of one quarry are not of one grey: a tint from the index.
Colour stone_tint(std::size_t i) {
  const auto unit = [&](std::uint32_t salt) {
    std::uint32_t h = static_cast<std::uint32_t>(i) * 2654435761U + salt;
    h = (h ^ (h >> 15)) * 2246822519U;
    return static_cast<float>(h >> 8) / 16777216.0F - 0.5F;
  };
  const float grey = 0.26F * unit(1), warm = 0.06F * unit(77);
  return stone * (1 + grey) + Colour(warm, 0, -warm);
}

/// Edges of a wall that one draws: the rim of a sheet, and folds of more than 20 degrees.
std::vector<std::array<Vec3, 2>> drawn_edges(const ViewWall& wall) {
  struct Edge {
    Vec3 from, to, normal;
    bool drawn = true;
  };
  // vertices are joined by place: files often repeat them for every triangle
  using Key = std::array<long, 6>;
  const auto grid = [](double x) { return std::lround(x * 1e5); };
  std::map<Key, Edge> edges;
  for (std::size_t t = 0; t + 2 < wall.triangles.size(); t += 3) {
    std::array<Vec3, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = point(wall.vertices, wall.triangles[t + k]);
    const Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 a = c[k], b = c[(k + 1) % 3];
      Key ka = {grid(a.x()), grid(a.y()), grid(a.z()), grid(b.x()), grid(b.y()), grid(b.z())};
      const Key kb = {ka[3], ka[4], ka[5], ka[0], ka[1], ka[2]};
      const auto [found, is_new] = edges.try_emplace(std::min(ka, kb), Edge{a, b, normal});
      if (!is_new)
        found->second.drawn = std::abs(found->second.normal.dot(normal)) < std::cos(20 * M_PI / 180);
    }
  }
  std::vector<std::array<Vec3, 2>> out;
  for (const auto& [key, edge] : edges)
    if (edge.drawn) out.push_back({edge.from, edge.to});
  return out;
}

void draw_rocks(Canvas& canvas, const ViewRocks& rocks, const SpeedScale* scale) {
  const std::array<SurfaceMesh, 3> grids = {cube_grid(2), cube_grid(5), cube_grid(12)};
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    const Vec3 x = point(rocks.x, i), axes = point(rocks.semi_axes, i);
    const Quat q(rocks.q[4 * i], rocks.q[4 * i + 1], rocks.q[4 * i + 2], rocks.q[4 * i + 3]);
    const double pixels = canvas.pixels_of(x, axes.maxCoeff());
    const SurfaceMesh mesh = superquadric_mesh(grids[pixels < 5    ? 0
                                                     : pixels < 30 ? 1
                                                                   : 2],
                                               axes, rocks.blockiness[i]);
    const Colour colour = scale ? speed_colour(rocks.speed[i] / scale->fastest) : stone_tint(i);
    std::vector<Corner> corners(mesh.vertices.size());
    for (std::size_t k = 0; k < corners.size(); ++k)
      corners[k] = {x + q * mesh.vertices[k], q * mesh.normals[k]};
    for (const auto& t : mesh.triangles)
      canvas.solid({corners[static_cast<std::size_t>(t[0])], corners[static_cast<std::size_t>(t[1])],
                    corners[static_cast<std::size_t>(t[2])]},
                   colour);
  }
}

/// Share of the half picture that the corner farthest from its middle reaches, up or across; 1 = its rim.
double reach(const SceneFrame& frame, const Camera& camera, const Vec3& direction, const PictureSize& size) {
  const Vec3 right = direction.cross(frame.up).normalized(), up = right.cross(direction);
  const double aspect = static_cast<double>(size.width) / size.height, half = 0.5 * camera.view_height;
  double most = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 x = frame.bounds.lo;
    for (int k = 0; k < 3; ++k)
      if ((corner >> k & 1) != 0) x[k] = frame.bounds.hi[k];
    const Vec3 d = x - camera.target;
    const double distance = half / half_angle_tangent;
    const double larger = camera.projection == Projection::perspective
                              ? distance / std::max(0.1 * distance, distance + d.dot(direction))
                              : 1;
    most = std::max(
        {most, larger * std::abs(d.dot(up)) / half, larger * std::abs(d.dot(right)) / (half * aspect)});
  }
  return most;
}

/// A camera that looks along `direction` at the middle of the scene and shows all of it.
Camera fitted(const SceneFrame& frame, Projection projection, const Vec3& direction,
              const PictureSize& size) {
  constexpr double margin = 1.06;
  Camera camera;
  camera.projection = projection;
  camera.up = frame.up;
  camera.target = frame.bounds.centre();
  camera.view_height = 2 * frame.bounds.size().norm();
  // nearer means larger: a few rounds settle it
  for (int round = 0; round < 12; ++round)
    camera.view_height *= margin * reach(frame, camera, direction, size);
  camera.eye = camera.target - direction * (2 * frame.bounds.size().norm() + camera.view_height);
  return camera;
}

}  // namespace

SpeedScale speed_scale(const View& view) {
  std::vector<float> speed;
  if (view.water && view.water->count() > 0)
    speed = view.water->speed;
  else if (view.rocks)
    speed = view.rocks->speed;
  if (speed.empty()) return {1};
  const auto most = speed.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(speed.size() - 1));
  std::nth_element(speed.begin(), most, speed.end());
  const double wanted = std::max(0.01, static_cast<double>(*most));
  const double ten = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (wanted <= step * ten) return {step * ten};
  return {10 * ten};
}

SceneFrame scene_frame(const View& view) {
  SceneFrame frame;
  for (const ViewWall& wall : view.walls)
    for (std::size_t i = 0; i < wall.vertices.size() / 3; ++i) frame.bounds.include(point(wall.vertices, i));
  const bool open = frame.bounds.empty();
  if (view.rocks && open)
    for (std::size_t i = 0; i < view.rocks->count(); ++i) frame.bounds.include(point(view.rocks->x, i));
  if (view.water && open)
    for (std::size_t i = 0; i < view.water->count(); ++i) frame.bounds.include(point(view.water->x, i));
  if (frame.bounds.empty()) frame.bounds = {Vec3::Constant(-0.5), Vec3::Constant(0.5)};

  // the two horizontal axes, the one nearest to gravity left out
  int vertical = 0;
  view.up.cwiseAbs().maxCoeff(&vertical);
  frame.up = Vec3::Zero();
  frame.up[vertical] = view.up[vertical] < 0 ? -1 : 1;
  int first = (vertical + 1) % 3, second = (vertical + 2) % 3;
  const Vec3 size = frame.bounds.size();
  int across = size[first] < size[second] ? first : second;
  Vec3 towards = frame.bounds.centre();
  for (const ViewMark& mark : view.marks) {
    if (mark.kind != "exit") continue;
    const Vec3 extent = mark.high - mark.low;
    if (extent[first] != extent[second]) across = extent[first] > extent[second] ? first : second;
    towards = 0.5 * (mark.low + mark.high);
    break;
  }
  const int along = across == first ? second : first;
  frame.across = frame.along = Vec3::Zero();
  frame.along[along] = towards[along] < frame.bounds.centre()[along] ? -1 : 1;
  frame.across = frame.up.cross(frame.along);
  return frame;
}

Camera overview_camera(const SceneFrame& frame, const PictureSize& size) {
  return fitted(frame, Projection::perspective,
                (-0.75 * frame.along + 0.85 * frame.across - 0.50 * frame.up).normalized(), size);
}

Camera side_camera(const SceneFrame& frame, const PictureSize& size) {
  return fitted(frame, Projection::orthographic, frame.across, size);
}

Camera exit_camera(const SceneFrame& frame, const PictureSize& size) {
  return fitted(frame, Projection::perspective, (-frame.along - 0.28 * frame.up).normalized(), size);
}

Image draw_picture(const View& view, const Camera& camera, const SpeedScale& scale, const PictureSize& size) {
  Canvas canvas(size.width, size.height, size.supersampling, camera);
  if (view.rocks) draw_rocks(canvas, *view.rocks, view.water ? nullptr : &scale);
  if (view.water) {
    for (std::size_t i = 0; i < view.water->count(); ++i)
      canvas.water_ball(point(view.water->x, i), 1.25 * view.water->point_radius,
                        speed_colour(view.water->speed[i] / scale.fastest));
  }
  for (const ViewWall& wall : view.walls) {
    for (std::size_t t = 0; t + 2 < wall.triangles.size(); t += 3)
      canvas.glass({point(wall.vertices, wall.triangles[t]), point(wall.vertices, wall.triangles[t + 1]),
                    point(wall.vertices, wall.triangles[t + 2])},
                   plate, plate_alpha);
    for (const auto& edge : drawn_edges(wall)) canvas.line(edge[0], edge[1], plate_edge, edge_alpha, 1);
  }
  return canvas.finish();
}

}  // namespace sluice
