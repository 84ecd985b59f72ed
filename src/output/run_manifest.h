#pragma once
/// What a run has to say about itself: run.json. A documented interface (docs in the README); keys are
/// added, never renamed. SI units; an absent optional becomes null, and so does a number that is not
/// finite (JSON has none).

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sluice {

enum class Outcome { running, completed, interrupted, failed };

/// Names with numbers, in a fixed order.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

struct BudgetEntry {
  double initial_kg = 0;
  double requested_kg = 0;  ///< rate x time of every source
  double entered_kg = 0;
  double waiting_kg = 0;  ///< requested but not yet placed
  double inside_kg = 0;
  NamedNumbers left_kg;  ///< per exit, then "outside"
  double lost_kg = 0;    ///< initial + entered - inside - sum of left

  double left_total() const;  ///< [kg]
  /// initial + entered - inside - left [kg]
  double residual() const;
};

struct RunManifest {
  struct Program {
    std::string version, commit, compiler, flags;
  } sluice;
  struct Process {
    std::string file, sha256, title;
  } process;
  struct Machine {
    int threads = 0;
    std::string cpu;
  } machine;

  /// `running` is written while the run goes on; at the end it is one of the other three.
  Outcome outcome = Outcome::running;
  struct Failure {
    std::string stage;
    double time_s = 0;
    std::string message;
  };
  std::optional<Failure> failure;

  struct Clock {
    double simulated_s = 0, wall_s = 0;
    std::int64_t steps = 0;
    std::optional<double> dt_fluid_s, dt_rock_s;          ///< last values
    std::optional<std::int64_t> rock_steps, fluid_steps;  ///< counts
    std::optional<double> planned_s;                      ///< end asked for, by `--until` where given
    std::string rock_step_governed_by, fluid_step_governed_by;
  } time;

  struct PartList {
    std::vector<std::string> present, left_out;
  } parts;

  struct Counts {
    std::optional<std::int64_t> rocks, rocks_max, water_points, water_points_max;
    std::int64_t wall_triangles = 0;
  } counts;

  /// Rocks that water meets with their own shape, by size; most of them at once.
  struct Resolved {
    double from_m = 0, partly_from_m = 0;
    std::int64_t rocks_max = 0, rocks_partly_max = 0;
  };
  std::optional<Resolved> resolved;

  struct Budgets {
    std::optional<BudgetEntry> rock, water;
    std::optional<BudgetEntry> fines;  ///< the part of `water` that is fines
    std::optional<std::array<double, 3>> momentum_residual_N_s;
    NamedNumbers energy;  ///< terms [J], named as in the manifest ("rock_kinetic_J"); empty = null
  } budgets;

  struct Overlap {
    double mean_percent_of_radius = 0, p99_percent_of_radius = 0, max_percent_of_radius = 0;
  };
  std::optional<Overlap> overlap;

  struct Memory {
    std::int64_t peak_bytes = 0, fluid_bytes = 0, rock_bytes = 0;
  } memory;

  struct StageTime {
    std::string name;
    double seconds = 0;
    std::int64_t calls = 0;
  };
  std::vector<StageTime> stages;

  struct Rates {
    std::optional<double> water_point_steps_per_s, rock_steps_per_s;
  } rates;

  /// A figure of an exit with its 95 % limits; NaN where not known.
  struct Figure {
    std::string name;
    double value = 0, low95 = 0, high95 = 0;
  };
  /// Averages over [from_s, to_s]: after steady state where it is reached, else over the second half of the
  /// run, and then `reason` says why nobody may rely on them.
  struct ExitAverages {
    double from_s = 0, to_s = 0;
    bool steady = false;
    std::string reason;           ///< empty where steady
    std::vector<Figure> figures;  ///< of what the scene has
  };

  /// Averages after steady state; absent with a reason in `warnings` where it is not reached.
  struct ExitSummary {
    std::string name;
    std::optional<double> rock_kg_s, water_kg_s, rock_cov_across_width, water_cov_across_width,
        water_to_rock_cov, steady_from_s;
    // more than pipelines are promised; null where unknown
    std::optional<double> rock_cov_corrected;  ///< shot noise taken out
    std::optional<double> water_m3_per_t, dry_rock_fraction, rock_size_p80_m, rock_kg, water_kg;
    std::optional<ExitAverages> averages;
  };
  std::vector<ExitSummary> exits;

  std::string state_hash;  ///< hexadecimal
  std::vector<std::string> warnings;
};

/// The file's text; every key of the interface is there, whatever the scene.
std::string manifest_text(const RunManifest& manifest);

/// Writes run.json atomically. @throws EnvironmentError
void write_manifest(const std::filesystem::path& file, const RunManifest& manifest);

/// Reads run.json back. Keys of a later version are ignored, missing ones keep their defaults.
/// @throws EnvironmentError  not there;  InputError  not a manifest
RunManifest read_manifest(const std::filesystem::path& file);

}  // namespace sluice
