#include "output/view.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/errors.h"
#include "output/base64.h"
#include "output/run_folder.h"

namespace sluice {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

void push(std::vector<float>& to, const Vec3& x) {
  for (int k = 0; k < 3; ++k) to.push_back(static_cast<float>(x[k]));
}

constexpr std::size_t any = std::numeric_limits<std::size_t>::max();

template <class T>
Json packed(const std::vector<T>& x) {
  return base64(x.data(), x.size() * sizeof(T));
}

/// @throws std::runtime_error  unless the array has `columns` numbers for each of `rows` rows
template <class T>
void unpack(const Json& json, const char* key, std::size_t columns, std::size_t rows, std::vector<T>& to) {
  const auto bytes = from_base64(json.at(key).get<std::string>());
  if (!bytes || bytes->size() % (columns * sizeof(T)) != 0)
    throw std::runtime_error(std::string("the array '") + key + "' is damaged");
  to.resize(bytes->size() / sizeof(T));
  if (rows != any && to.size() != rows * columns)
    throw std::runtime_error(std::string("the array '") + key + "' has another length");
  if (!to.empty()) std::memcpy(to.data(), bytes->data(), bytes->size());
}

Json vec_json(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}
Vec3 vec_of(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

ViewRocks view_rocks(const RockSnapshot& rocks) {
  ViewRocks out;
  for (std::size_t i = 0; i < rocks.count(); ++i) {
    push(out.x, rocks.x[i]);
    out.q.push_back(static_cast<float>(rocks.q[i].w()));
    push(out.q, rocks.q[i].vec());
    push(out.semi_axes, rocks.semi_axes[i]);
    out.blockiness.push_back(static_cast<float>(rocks.blockiness[i]));
    out.speed.push_back(static_cast<float>(rocks.v[i].norm()));
    out.wetted.push_back(static_cast<float>(rocks.wetted[i]));
  }
  return out;
}

ViewWater view_water(const WaterPoints& water, double point_volume, std::size_t most) {
  ViewWater out;
  out.total = water.count();
  out.stride = std::max<std::uint64_t>(1, (out.total + most - 1) / std::max<std::size_t>(1, most));
  for (std::size_t i = 0; i < water.count(); i += out.stride) {
    push(out.x, water.x[i]);
    out.speed.push_back(static_cast<float>(water.v[i].norm()));
  }
  out.point_radius = std::cbrt(point_volume * static_cast<double>(out.stride) * 3 / (4 * std::numbers::pi));
  return out;
}

Json to_json(const View& view) {
  Json json;
  json["format"] = "sluice view 1: arrays are base64 of little-endian float32 (triangles: uint32)";
  json["time_s"] = view.time;
  json["up"] = vec_json(view.up);
  json["walls"] = Json::array();
  for (const ViewWall& w : view.walls)
    json["walls"].push_back(
        {{"name", w.name}, {"vertices", packed(w.vertices)}, {"triangles", packed(w.triangles)}});
  json["marks"] = Json::array();
  for (const ViewMark& m : view.marks)
    json["marks"].push_back(
        {{"name", m.name}, {"kind", m.kind}, {"low", vec_json(m.low)}, {"high", vec_json(m.high)}});
  json["rocks"] = nullptr;
  json["water"] = nullptr;
  if (const auto& r = view.rocks)
    json["rocks"] = {{"count", r->count()},
                     {"x", packed(r->x)},
                     {"q", packed(r->q)},
                     {"semi_axes", packed(r->semi_axes)},
                     {"blockiness", packed(r->blockiness)},
                     {"speed", packed(r->speed)},
                     {"wetted", packed(r->wetted)}};
  if (const auto& w = view.water)
    json["water"] = {{"count", w->count()}, {"total", w->total},
                     {"stride", w->stride}, {"point_radius", w->point_radius},
                     {"x", packed(w->x)},   {"speed", packed(w->speed)}};
  return json;
}

View from_json(const Json& json) {
  View view;
  view.time = json.at("time_s").get<double>();
  view.up = vec_of(json.at("up"));
  for (const Json& w : json.at("walls")) {
    ViewWall& wall = view.walls.emplace_back();
    wall.name = w.at("name").get<std::string>();
    unpack(w, "vertices", 3, any, wall.vertices);
    unpack(w, "triangles", 3, any, wall.triangles);
    for (const std::uint32_t index : wall.triangles)
      if (index >= wall.vertices.size() / 3) throw std::runtime_error("a triangle has no such vertex");
  }
  for (const Json& m : json.at("marks"))
    view.marks.push_back({m.at("name").get<std::string>(), m.at("kind").get<std::string>(),
                          vec_of(m.at("low")), vec_of(m.at("high"))});
  if (const Json& r = json.at("rocks"); !r.is_null()) {
    ViewRocks& rocks = view.rocks.emplace();
    unpack(r, "blockiness", 1, any, rocks.blockiness);
    const std::size_t n = rocks.count();
    if (n != r.at("count").get<std::size_t>()) throw std::runtime_error("rocks are missing");
    unpack(r, "x", 3, n, rocks.x);
    unpack(r, "q", 4, n, rocks.q);
    unpack(r, "semi_axes", 3, n, rocks.semi_axes);
    unpack(r, "speed", 1, n, rocks.speed);
    unpack(r, "wetted", 1, n, rocks.wetted);
  }
  if (const Json& w = json.at("water"); !w.is_null()) {
    ViewWater& water = view.water.emplace();
    unpack(w, "speed", 1, any, water.speed);
    const std::size_t n = water.count();
    if (n != w.at("count").get<std::size_t>()) throw std::runtime_error("water points are missing");
    unpack(w, "x", 3, n, water.x);
    water.total = w.at("total").get<std::uint64_t>();
    water.stride = w.at("stride").get<std::uint64_t>();
    water.point_radius = w.at("point_radius").get<double>();
  }
  return view;
}

}  // namespace

View make_view(const Snapshot& snapshot, std::vector<ViewMark> marks, std::size_t most_water_points) {
  View view;
  view.time = snapshot.time;
  view.up = snapshot.up;
  view.marks = std::move(marks);
  if (snapshot.walls) {
    for (const Wall& wall : *snapshot.walls) {
      ViewWall& w = view.walls.emplace_back();
      w.name = wall.name;
      for (const Vec3& x : mesh_at(wall, snapshot.time).vertices) push(w.vertices, x);
      for (const auto& t : wall.mesh.triangles)
        for (const int index : t) w.triangles.push_back(static_cast<std::uint32_t>(index));
    }
  }
  if (snapshot.rocks) view.rocks = view_rocks(*snapshot.rocks);
  if (snapshot.water)
    view.water = view_water(*snapshot.water, snapshot.water_point_volume, most_water_points);
  return view;
}

std::string view_text(const View& view) {
  return to_json(view).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_view(const std::filesystem::path& file, const View& view) {
  write_atomically(file, view_text(view) + "\n");
}

View read_view(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  try {
    return from_json(Json::parse(text));
  } catch (const std::exception& error) {
    refuse_file(file, {"is a damaged view", error.what(), "run the case again"});
  }
}

}  // namespace sluice
