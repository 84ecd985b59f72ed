#pragma once
/// The tables of a run folder besides the series. The run page reads them by column name.

#include <limits>
#include <string>
#include <vector>

#include "base/load.h"
#include "output/csv.h"

namespace sluice {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A mean with its 95 % confidence limits; NaN = not known.
struct TableEstimate {
  double mean = not_known, low = not_known, high = not_known;
};

/// One bin across the width of one exit; averages over [from_s, to_s]. One row of exits.csv.
struct ExitBinRow {
  std::string exit;
  int bin = 0;                                  ///< from 0
  double from_m = 0, to_m = 0;                  ///< along the width, from its first end
  double from_s = not_known, to_s = not_known;  ///< averaging interval
  TableEstimate rock_kg_s, water_kg_s;          ///< water with its fines
  TableEstimate fines_kg_s;
  TableEstimate water_m3_per_t;  ///< water per tonne of rock
  TableEstimate rock_speed_m_s, water_speed_m_s;
  TableEstimate rock_size_mean_m;  ///< by mass
  TableEstimate rock_size_p80_m;   ///< 80 % of the mass is finer
  TableEstimate rock_energy_W;     ///< kinetic energy landing per second
  TableEstimate dry_rock_kg_s;     ///< rock that left unwetted
  TableEstimate rock_residence_s;  ///< mean time since the feed
};
CsvTable exit_table(const std::vector<ExitBinRow>& rows);

/// Mixing of one zone along the box at one time. One row of mixing.csv.
struct MixingTableRow {
  double time_s = 0;
  std::string zone;               ///< name of the zone, or of the station along the box
  double position_m = not_known;  ///< along the box
  double rock_kg = not_known, water_kg = not_known;
  double water_rock_lacey = not_known;      ///< of water and rock: 0 apart, 1 random mixture
  double water_share_rsd = not_known;       ///< of the water's share of the volume, over the zone's cells
  double wetted_rock_fraction = not_known;  ///< of rock mass
};
CsvTable mixing_table(const std::vector<MixingTableRow>& rows);

/// One wall: loads since the run began and mean forces over it. One row of walls.csv.
struct WallRow {
  std::string wall;
  double area_m2 = 0;
  double time_s = 0;  ///< over which the loads were gathered
  WallLoad rock, water;
};
CsvTable wall_table(const std::vector<WallRow>& rows);

}  // namespace sluice
