#pragma once
/// The `.vtp` time series that ParaView opens through frames/rocks.pvd, rocks_surface.pvd, water.pvd,
/// moving_walls.pvd and the single file walls.vtp. Binary, LZ4, appended raw data.
///
///   rocks          points: id, size, mass, velocity, semi_axes, blockiness, quaternion (w x y z), wetted,
///                  shape
///   rocks_surface  every rock's real shape as a coarse mesh; cells: id, size, speed, wetted
///   water          points: id, velocity, mass, fines_fraction, J, pressure
///   walls          those that stand: triangles; cells: wall (index), names as field data
///   moving_walls   the same for those that move, where they are

#include <filesystem>
#include <map>
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

  /// Those that stand; once a run. @throws EnvironmentError
  void write_walls(const std::vector<Wall>& walls);
  /// The files of one moment, then the collections. @throws EnvironmentError
  void write(const Snapshot& snapshot);
  /// Frames there are, those of an earlier part of the run included.
  std::size_t count() const;

 private:
  struct Entry {
    double time = 0;   ///< [s]
    std::string file;  ///< inside the folder
  };
  void add(const std::string& series, double time, const std::string& file);
  void write_collection(const std::string& series) const;
  void read_collections(double resume_time);
  void clear_folder() const;

  std::filesystem::path folder_;
  RockSurface surface_;
  std::map<std::string, std::vector<Entry>> collections_;  ///< by series: "rocks", "water", ...
  int next_number_ = 0;
};

}  // namespace sluice
