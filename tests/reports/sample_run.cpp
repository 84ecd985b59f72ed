#include "reports/sample_run.h"

#include <cmath>
#include <random>

#include "output/run_folder.h"
#include "output/run_manifest.h"
#include "output/series.h"
#include "output/tables.h"
#include "output/view.h"

namespace sluice {
namespace {

std::vector<Wall> chute() {
  std::vector<Wall> walls;
  const auto add = [&](const char* name, TriMesh mesh) {
    walls.emplace_back().name = name;
    walls.back().mesh = std::move(mesh);
  };
  add("back plate",
      make_rectangle("a", {Vec3(0, -1.2, 0.9), Vec3(0, 1.2, 0.9), Vec3(0, 1.2, 2.6), Vec3(0, -1.2, 2.6)}));
  add("upper ledge", make_box("b", {Vec3(0.0, -1.2, 1.55), Vec3(0.55, 1.2, 1.6)}));
  add("slope", make_rectangle(
                   "c", {Vec3(0, -1.2, 0.9), Vec3(2.6, -1.2, 0.1), Vec3(2.6, 1.2, 0.1), Vec3(0, 1.2, 0.9)}));
  add("left side",
      make_rectangle("d", {Vec3(0, 1.2, 0.9), Vec3(2.6, 1.2, 0.1), Vec3(2.6, 1.2, 1.1), Vec3(0, 1.2, 2.6)}));
  add("right side <1>", make_rectangle("e", {Vec3(0, -1.2, 0.9), Vec3(2.6, -1.2, 0.1), Vec3(2.6, -1.2, 1.1),
                                             Vec3(0, -1.2, 2.6)}));
  return walls;
}

Snapshot moment(SampleScene scene, std::mt19937& random, const std::vector<Wall>& walls) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967296.0);
  };
  Snapshot s;
  s.time = 12.5;
  s.walls = &walls;
  const Vec3 slope = Vec3(2.6, 0, -0.8).normalized(), away(-slope.z(), 0, slope.x());
  RockSnapshot& r = s.rocks.emplace();
  for (std::uint64_t i = 0; i < 900; ++i) {
    const double size = 0.03 * std::pow(uniform(0.05, 1), -0.5);
    const double down = uniform(0.05, 2.65), speed = 0.6 + 1.3 * down;
    r.id.push_back(i);
    r.size.push_back(size);
    r.semi_axes.push_back(size * Vec3(uniform(0.5, 0.75), 0.5, uniform(0.3, 0.5)));
    r.blockiness.push_back(i % 3 == 0 ? 2 : i % 3 == 1 ? 4 : 8);
    r.x.push_back(Vec3(0, uniform(-1.1, 1.1), 0.9) + down * slope + away * uniform(0.4 * size, 0.18));
    r.v.push_back(speed * slope);
    r.q.push_back(Quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized());
    r.mass.push_back(2700 * size * size * size / 2);
    r.wetted.push_back(uniform(0, 1));
    r.shape.push_back(static_cast<int>(i % 3));
  }
  if (scene == SampleScene::dry) return s;
  WaterPoints& w = s.water.emplace();
  s.water_point_volume = 4e-6;
  for (std::uint64_t i = 0; i < 70000; ++i) {
    const bool jet = i % 10 == 0;
    const double down = uniform(0, 2.7), fall = uniform(0, 1);
    w.id.push_back(i);
    w.x.push_back(jet ? Vec3(0.15 + 0.5 * fall,
                             -1.05 + 0.3 * static_cast<double>(i / 10 % 8) + uniform(-0.03, 0.03),
                             2.3 - 1.5 * fall * fall)
                      : Vec3(0, uniform(-1.2, 1.2), 0.9) + down * slope + away * uniform(0.005, 0.07));
    w.v.push_back(jet ? Vec3(2, 0, -5 * fall) : Vec3((1 + 1.1 * down) * slope));
    w.mass.push_back(4e-3);
    w.fines_mass.push_back(2e-4);
    w.J.push_back(1);
    w.pressure.push_back(500);
  }
  return s;
}

RunManifest manifest_of(SampleScene scene, int seed) {
  const bool wet = scene == SampleScene::wet;
  RunManifest m;
  m.sluice = {"0.1.0", "0123abc", "g++ 12.2.0", "-O3 -march=native"};
  m.process = {"processes/sample.yaml", std::string(64, 'a'),
               wet ? "Sample chute, pipes & <rock>" : "Dry sample chute"};
  m.machine = {2, "a processor"};
  m.outcome = Outcome::completed;
  m.time.simulated_s = 12.5;
  m.time.planned_s = 12.5;
  m.time.wall_s = 754;
  m.time.steps = 62500;
  m.time.dt_rock_s = 2.1e-5;
  m.time.rock_steps = 595000;
  m.time.rock_step_governed_by = "steps_per_contact";
  m.parts.present = {"rocks", "5 walls", "1 conveyor"};
  m.counts.rocks = 900;
  m.counts.rocks_max = 1044;
  m.counts.wall_triangles = 20;
  m.budgets.rock = {0, 4166.25, 4160.75, 5.5, 812.5, {{"lip", 3340.0}, {"outside", 8.25}}, 0};
  m.budgets.momentum_residual_N_s = {1e-10, 0, -3e-11};
  m.budgets.energy = {{"rock_kinetic_J", 2210}, {"rock_dissipated_friction_J", 51300}};
  m.overlap = RunManifest::Overlap{0.31, 1.9, 4.4};
  m.memory = {412000000, wet ? 260000000 : 0, 31000000};
  m.stages = {{"inflow", 3.1, 62500}, {"rocks.substeps", 320.5, 62500}, {"exits", 4.4, 62500}};
  m.rates.rock_steps_per_s = 1.9e6;
  auto& lip = m.exits.emplace_back();
  lip.name = "lip";
  lip.rock_kg_s = 301.5 + 4 * seed;
  lip.rock_kg = 3340;
  lip.rock_cov_across_width = 0.27 + 0.02 * seed;
  lip.rock_cov_corrected = 0.21;
  lip.rock_size_p80_m = 0.081;
  lip.steady_from_s = 4.5;
  lip.averages = RunManifest::ExitAverages{4.5, 12.5, true, "", {}};
  lip.averages->figures = {{"rock_kg_s", *lip.rock_kg_s, *lip.rock_kg_s - 12, *lip.rock_kg_s + 12},
                           {"rock_cov_across_width", *lip.rock_cov_across_width,
                            *lip.rock_cov_across_width - 0.03, *lip.rock_cov_across_width + 0.03}};
  m.state_hash = "89abcdef01234567";
  m.warnings = {"8.25 kg of rock left through the open sides of the domain",
                "a warning with <tags> & \"quotes\""};
  if (!wet) {
    m.parts.left_out = {"water", "coupling"};
    return m;
  }
  m.parts.present = {"rocks", "water", "coupling", "5 walls", "1 conveyor", "8 pipes"};
  m.parts.left_out = {"nozzles", "moving walls"};
  m.time.dt_fluid_s = 2e-4;
  m.time.fluid_steps = 62500;
  m.time.fluid_step_governed_by = "acoustic";
  m.counts.water_points = 70000;
  m.counts.water_points_max = 71500;
  m.budgets.water = {0, 1875, 1875, 0, 280, {{"lip", 1595}, {"outside", 0}}, 0};
  m.budgets.fines = {0, 93.75, 93.75, 0, 14, {{"lip", 79.75}, {"outside", 0}}, 0};
  m.stages.push_back({"water.points_to_grid", 201.25, 62500});
  m.stages.push_back({"water.grid_to_points", 188.5, 62500});
  m.stages.push_back({"coupling.drag", 21.5, 62500});
  m.rates.water_point_steps_per_s = 1.1e7;
  m.exits[0].water_kg_s = 148;
  m.exits[0].water_kg = 1595;
  m.exits[0].water_cov_across_width = 0.14;
  m.exits[0].water_to_rock_cov = 0.33;
  m.exits[0].water_m3_per_t = 0.49;
  m.exits[0].dry_rock_fraction = 0.034;
  return m;
}

void write_tables(const RunFolder& folder, SampleScene scene, int seed) {
  const bool wet = scene == SampleScene::wet;
  std::vector<ExitBinRow> exits;
  for (int bin = 0; bin < 12; ++bin) {
    ExitBinRow& row = exits.emplace_back();
    row.exit = "lip";
    row.bin = bin;
    row.from_m = 0.2 * bin;
    row.to_m = 0.2 * (bin + 1);
    const double hill = std::exp(-std::pow((bin - 5.5 + 0.4 * seed) / 4.0, 2));
    row.rock_kg_s = {38 * hill, 34 * hill, 42 * hill};
    row.rock_size_mean_m = {0.05 + 0.01 * hill, 0.048 + 0.01 * hill, 0.052 + 0.01 * hill};
    row.rock_speed_m_s = {2.6 + 0.2 * hill, not_known, not_known};
    if (!wet) continue;
    row.water_kg_s = {12.3 + hill, 11.8 + hill, 12.9 + hill};
    row.water_m3_per_t = {(12.3 + hill) / (38 * hill), 0.9 * (12.3 + hill) / (38 * hill),
                          1.1 * (12.3 + hill) / (38 * hill)};
    row.water_speed_m_s = {3.1, 3.0, 3.2};
  }
  write_csv(folder.exits(), exit_table(exits));

  std::vector<MixingTableRow> mixing;
  for (int k = 0; k <= 25; ++k) {
    for (const char* zone : {"upper ledge", "slope"}) {
      MixingTableRow& row = mixing.emplace_back();
      row.time_s = 0.5 * k;
      row.zone = zone;
      row.water_rock_lacey = 0.6 + 0.3 * (1 - std::exp(-0.3 * k)) - (zone[0] == 'u' ? 0.15 : 0);
      if (wet) row.water_share_rsd = 0.9 * std::exp(-0.1 * k) + 0.3;
    }
  }
  write_csv(folder.mixing(), mixing_table(mixing));

  std::vector<WallRow> walls;
  for (const Wall& wall : chute()) {
    WallRow& row = walls.emplace_back();
    row.wall = wall.name;
    for (std::size_t t = 0; t < wall.mesh.triangles.size(); ++t)
      row.area_m2 += wall.mesh.area(static_cast<int>(t));
    row.time_s = 12.5;
    row.rock.impulse = Vec3(1200, 0, -9000) * row.area_m2;
    row.rock.sliding_energy = 9000 * row.area_m2;
    row.rock.impact_energy = 4000;
    if (wet) row.water.impulse = Vec3(100, 0, -2000);
  }
  write_csv(folder.walls(), wall_table(walls));

  std::vector<std::string> columns = {"time_s", "rock_in_kg_s",   "lip_rock_kg_s",
                                      "rocks",  "rock_inside_kg", "rock_kinetic_J"};
  if (wet) columns.insert(columns.end(), {"water_in_kg_s", "lip_water_kg_s", "water_fastest_m_s"});
  SeriesWriter series(folder.series(), columns, std::nullopt);
  for (int k = 1; k <= 125; ++k) {
    const double t = 0.1 * k, on = 1 - std::exp(-t / 2), ripple = std::sin(7 * t) + std::sin(3.1 * t);
    std::vector<double> row = {t, 333, 305 * on + 9 * ripple, 900 * on, 812.5 * on, 2210 * on};
    if (wet) row.insert(row.end(), {150, 148 * on + ripple, k < 3 ? not_known : 6.5 + 0.2 * ripple});
    series.append(row);
  }
}

}  // namespace

void write_sample_run(const std::filesystem::path& root, SampleScene scene, int seed) {
  const RunFolder folder = open_run_folder(root, FolderUse::fresh);
  write_manifest(folder.manifest(), manifest_of(scene, seed));
  write_tables(folder, scene, seed);
  std::mt19937 random(static_cast<unsigned>(seed));
  const std::vector<Wall> walls = chute();
  write_view(folder.view(), make_view(moment(scene, random, walls),
                                      {{"lip", "exit", Vec3(2.6, -1.2, -0.3), Vec3(2.6, 1.2, 1.1)}}));
}

}  // namespace sluice
