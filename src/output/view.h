#pragma once
/// view.json: the last state as the run page shows it in 3D and in pictures. Small enough for a page:
/// single precision, and no more than a stated number of water points.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "output/snapshot.h"

namespace sluice {

inline constexpr std::size_t view_water_points = 60000;

struct ViewWall {
  std::string name;
  std::vector<float> vertices;           ///< x y z ... [m]
  std::vector<std::uint32_t> triangles;  ///< three indices each
};

/// A place drawn as an outline: an exit, an emitter.
struct ViewMark {
  std::string name;
  std::string kind;                              ///< "exit", "feed", "jet"
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box, or a rectangle flat in one axis [m]
};

struct ViewRocks {
  std::vector<float> x;          ///< x y z [m]
  std::vector<float> q;          ///< w x y z
  std::vector<float> semi_axes;  ///< a b c [m]
  std::vector<float> blockiness;
  std::vector<float> speed;   ///< [m/s]
  std::vector<float> wetted;  ///< 0..1
  std::size_t count() const { return blockiness.size(); }
};

struct ViewWater {
  std::vector<float> x;      ///< x y z [m]
  std::vector<float> speed;  ///< [m/s]
  std::uint64_t total = 0;   ///< points in the scene
  std::uint64_t stride = 1;  ///< every stride-th point, in ascending id, is shown
  double point_radius = 0;   ///< of the volume one shown point stands for [m]
  std::size_t count() const { return speed.size(); }
};

struct View {
  double time = 0;  ///< [s]
  Vec3 up = Vec3::UnitZ();
  std::vector<ViewWall> walls;
  std::vector<ViewMark> marks;
  std::optional<ViewRocks> rocks;
  std::optional<ViewWater> water;
};

View make_view(const Snapshot& snapshot, std::vector<ViewMark> marks = {},
               std::size_t most_water_points = view_water_points);

/// Atomically. Arrays are base64 of little-endian float32 / uint32. @throws EnvironmentError
void write_view(const std::filesystem::path& file, const View& view);
/// The text that write_view writes, for the page.
std::string view_text(const View& view);
/// @throws EnvironmentError  not there;  InputError  damaged
View read_view(const std::filesystem::path& file);

}  // namespace sluice
