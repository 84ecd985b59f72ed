#pragma once
/// A process file as a plain struct: everything an engineer can say about a run.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/exits.h"
#include "analysis/gauges.h"
#include "analysis/mixing.h"
#include "base/domain.h"
#include "coupling/coupling.h"
#include "dem/dem_system.h"
#include "geometry/wall.h"
#include "inflow/channel_inflow.h"
#include "inflow/conveyor_feed.h"
#include "inflow/initial_fill.h"
#include "inflow/pipe_jet.h"
#include "inflow/spray_nozzle.h"
#include "mpm/mpm_system.h"

namespace sluice {

/// `domain:`
struct DomainConfig {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [m]
  std::array<Face, 3> low_face{Face::open, Face::open, Face::open};
  std::array<Face, 3> high_face{Face::open, Face::open, Face::open};
  std::string wall_material;  ///< of the faces that are walls
  Location wall_material_at;
  void keys(Schema& s);
  Domain domain() const;
};

/// One entry of `materials:`.
struct MaterialConfig {
  std::string name;
  double density = 0;                    ///< [kg/m3]
  std::optional<double> youngs_modulus;  ///< [Pa]
  std::optional<double> poissons_ratio;
  Location where, youngs_modulus_at, poissons_ratio_at;
  void keys(Schema& s);
};

/// One entry of `contacts:`.
struct ContactConfig {
  std::vector<std::string> between;
  PairProperties properties;
  Location where, law_at;
  void keys(Schema& s);
};

enum class LengthUnit { mm, cm, m, inch };
double metres(LengthUnit unit);

/// One entry of `walls:`: parts of a CAD file with one material and one motion.
struct WallConfig {
  std::string name;
  std::filesystem::path file;
  LengthUnit unit = LengthUnit::mm;
  std::vector<std::string> parts;  ///< empty = all parts of the file
  std::string material;
  Vec3 surface_velocity = Vec3::Zero();  ///< [m/s]
  BlocksPhase blocks = BlocksPhase::both;
  bool repair = false;
  std::optional<WallMotion> motion;
  Location where, file_at, parts_at, material_at, motion_at;
  void keys(Schema& s);
};

/// `output:`
struct OutputConfig {
  double frames_every = 0.1;       ///< [s]; 0 = no frames
  double series_every = 0.02;      ///< [s]
  double checkpoint_every = 0.25;  ///< [s]
  double exit_slot = 0.1;          ///< length of the time slots of exit counts [s]
  bool rock_surface = true;
  void keys(Schema& s);
};

/// `stop:`  the run ends early when enough rock leaves.
struct StopConfig {
  std::string exit;
  double rock_rate = 0.8;  ///< share of what the feeds ask for
  double over = 0.5;       ///< averaging time [s]
  Location where;
  void keys(Schema& s);
};

struct ProcessConfig {
  std::string title;
  std::int64_t seed = 1;
  double duration = 0;               ///< [s]
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s2]
  DomainConfig domain;
  std::vector<MaterialConfig> materials;
  std::vector<ContactConfig> contacts;
  std::vector<WallConfig> walls;
  std::optional<DemConfig> rocks;
  std::optional<MpmConfig> water;
  std::optional<CouplingConfig> coupling;
  bool coupled = true;  ///< false: rock and water in one scene ignore each other
  std::vector<ConveyorFeedConfig> conveyors;
  std::vector<PipeJetConfig> pipes;
  std::vector<ChannelInflowConfig> channels;
  std::vector<SprayNozzleConfig> sprays;
  std::vector<WaterFillConfig> water_fills;
  std::vector<RockFillConfig> rock_fills;
  std::vector<ExitConfig> exits;
  std::vector<GaugeConfig> gauges;
  std::vector<MixingConfig> mixing;
  OutputConfig output;
  std::optional<StopConfig> stop;
  Location duration_at, rocks_at, water_at;

  void keys(Schema& s);
};

/// Reads a process file with overrides ("a.b=value").
/// @throws InputError with everything that is wrong; EnvironmentError where the file is not there
ProcessConfig read_process(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace sluice
