#include "output/tables.h"

#include <array>

namespace sluice {

namespace {

/// Where a column's limits stand: columns are added at the end, never moved.
enum class Limits { beside, at_the_end };
struct ExitColumn {
  const char* name;
  TableEstimate ExitBinRow::*value;
  Limits limits;
};
constexpr std::array<ExitColumn, 11> exit_columns = {{
    {"rock_kg_s", &ExitBinRow::rock_kg_s, Limits::beside},
    {"water_kg_s", &ExitBinRow::water_kg_s, Limits::beside},
    {"fines_kg_s", &ExitBinRow::fines_kg_s, Limits::at_the_end},
    {"water_m3_per_t", &ExitBinRow::water_m3_per_t, Limits::beside},
    {"rock_speed_m_s", &ExitBinRow::rock_speed_m_s, Limits::at_the_end},
    {"water_speed_m_s", &ExitBinRow::water_speed_m_s, Limits::at_the_end},
    {"rock_size_mean_m", &ExitBinRow::rock_size_mean_m, Limits::at_the_end},
    {"rock_size_p80_m", &ExitBinRow::rock_size_p80_m, Limits::at_the_end},
    {"rock_energy_W", &ExitBinRow::rock_energy_W, Limits::at_the_end},
    {"dry_rock_kg_s", &ExitBinRow::dry_rock_kg_s, Limits::at_the_end},
    {"rock_residence_s", &ExitBinRow::rock_residence_s, Limits::at_the_end},
}};

void add_limit_columns(CsvTable& table, const std::string& name) {
  table.columns.push_back(name + "_low95");
  table.columns.push_back(name + "_high95");
}

}  // namespace

CsvTable exit_table(const std::vector<ExitBinRow>& rows) {
  CsvTable table;
  table.columns = {"exit", "bin", "from_m", "to_m", "from_s", "to_s"};
  for (const ExitColumn& column : exit_columns) {
    table.columns.emplace_back(column.name);
    if (column.limits == Limits::beside) add_limit_columns(table, column.name);
  }
  for (const ExitColumn& column : exit_columns)
    if (column.limits == Limits::at_the_end) add_limit_columns(table, column.name);
  for (const ExitBinRow& r : rows) {
    std::vector<CsvCell> cells = {r.exit, static_cast<double>(r.bin), r.from_m, r.to_m, r.from_s, r.to_s};
    for (const ExitColumn& column : exit_columns) {
      const TableEstimate& e = r.*column.value;
      cells.emplace_back(e.mean);
      if (column.limits == Limits::beside) cells.insert(cells.end(), {e.low, e.high});
    }
    for (const ExitColumn& column : exit_columns)
      if (column.limits == Limits::at_the_end)
        cells.insert(cells.end(), {(r.*column.value).low, (r.*column.value).high});
    table.add(std::move(cells));
  }
  return table;
}

CsvTable mixing_table(const std::vector<MixingTableRow>& rows) {
  CsvTable table;
  table.columns = {"time_s",          "zone",
                   "position_m",      "rock_kg",
                   "water_kg",        "water_rock_lacey",
                   "water_share_rsd", "wetted_rock_fraction"};
  for (const MixingTableRow& r : rows)
    table.add({r.time_s, r.zone, r.position_m, r.rock_kg, r.water_kg, r.water_rock_lacey, r.water_share_rsd,
               r.wetted_rock_fraction});
  return table;
}

CsvTable wall_table(const std::vector<WallRow>& rows) {
  CsvTable table;
  table.columns = {"wall", "area_m2", "time_s"};
  for (const char* phase : {"rock", "water"}) {
    for (const char* name : {"mean_force_x_N", "mean_force_y_N", "mean_force_z_N", "impulse_x_N_s",
                             "impulse_y_N_s", "impulse_z_N_s", "sliding_energy_J", "impact_energy_J"})
      table.columns.push_back(std::string(phase) + "_" + name);
  }
  for (const WallRow& r : rows) {
    std::vector<CsvCell> cells = {r.wall, r.area_m2, r.time_s};
    for (const WallLoad* load : {&r.rock, &r.water}) {
      const Vec3 force = r.time_s > 0 ? Vec3(load->impulse / r.time_s) : Vec3(Vec3::Constant(not_known));
      for (int k = 0; k < 3; ++k) cells.emplace_back(force[k]);
      for (int k = 0; k < 3; ++k) cells.emplace_back(load->impulse[k]);
      cells.emplace_back(load->sliding_energy);
      cells.emplace_back(load->impact_energy);
    }
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace sluice
