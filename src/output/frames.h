#pragma once
/// The `.vtp` time series that ParaView opens through frames/rocks.pvd, rocks_surface.pvd, water.pvd
/// and the single file walls.vtp. Binary, LZ4, appended raw data.
///
///   rocks          points: id, size, mass, velocity, semi_axes, blockiness, quaternion (w x y z), wetted,
///   shape rocks_surface  every rock's real shape as a coarse mesh; cells: id, size, speed, wetted water
///   points: id, velocity, mass, fines_fraction, J, pressure walls          triangles; cells: wall (index),
///   names as field data

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/snapshot.h"

namespace sluice {

enum class RockSurface { none, tessellated };

class FrameWriter {
 public:
  /// @param resume_time  frames later than this [s] are dropped; without it all older frames are
  /// @throws EnvironmentError
  FrameWriter(std::filesystem::path folder, RockSurface surface, std::optional<double> resume_time);

  /// Once a run. @throws EnvironmentError
  void write_walls(const std::vector<Wall>& walls);
  /// The files of one moment, then the collections. @throws EnvironmentError
  void write(const Snapshot& snapshot);
  std::size_t count() const { return frames_.size(); }

 private:
  struct Frame {
    int number = 0;
    double time = 0;                  ///< [s]
    std::vector<std::string> series;  ///< "rocks", "water", ...
  };
  void write_collections() const;
  void read_index(std::optional<double> resume_time);

  std::filesystem::path folder_;
  RockSurface surface_;
  std::vector<Frame> frames_;
};

}  // namespace sluice
