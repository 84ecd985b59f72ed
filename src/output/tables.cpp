#include "output/tables.h"

namespace sluice {

CsvTable exit_table(const std::vector<ExitBinRow>& rows) {
  CsvTable table;
  table.columns = {"exit",
                   "bin",
                   "from_m",
                   "to_m",
                   "from_s",
                   "to_s",
                   "rock_kg_s",
                   "rock_kg_s_low95",
                   "rock_kg_s_high95",
                   "water_kg_s",
                   "water_kg_s_low95",
                   "water_kg_s_high95",
                   "fines_kg_s",
                   "water_m3_per_t",
                   "water_m3_per_t_low95",
                   "water_m3_per_t_high95",
                   "rock_speed_m_s",
                   "water_speed_m_s",
                   "rock_size_mean_m",
                   "rock_size_p80_m",
                   "rock_energy_W",
                   "dry_rock_kg_s",
                   "rock_residence_s"};
  for (const ExitBinRow& r : rows)
    table.add({r.exit,
               static_cast<double>(r.bin),
               r.from_m,
               r.to_m,
               r.from_s,
               r.to_s,
               r.rock_kg_s.mean,
               r.rock_kg_s.low,
               r.rock_kg_s.high,
               r.water_kg_s.mean,
               r.water_kg_s.low,
               r.water_kg_s.high,
               r.fines_kg_s,
               r.water_m3_per_t.mean,
               r.water_m3_per_t.low,
               r.water_m3_per_t.high,
               r.rock_speed_m_s,
               r.water_speed_m_s,
               r.rock_size_mean_m,
               r.rock_size_p80_m,
               r.rock_energy_W,
               r.dry_rock_kg_s,
               r.rock_residence_s});
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
