#pragma once
/// Exits take out rock and water and count them, per bin across their width.
///
/// plane: taken when the path of a step crosses a rectangle, in either direction
/// box:   taken when inside
/// deck:  a wall part whose apertures let water and fines through and stop rocks: water whose path
///        crosses the part's triangles is taken; rocks are not
/// `outside` (open faces of the domain) is counted here too.

#include <span>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/state_archive.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

enum class ExitKind { plane, box, deck };

/// Keys under `exits: NAME:` of a process file.
struct ExitConfig {
  std::string name;
  ExitKind kind = ExitKind::plane;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< box, or a rectangle flat in one axis [m]
  std::string part;                              ///< deck: name of the wall
  std::int64_t bins = 12;
  Vec3 width_from = Vec3::Zero(), width_to = Vec3::Zero();  ///< ends of the width; bins lie between [m]
  double aperture = 0;                                      ///< deck: of the screen cloth [m]
  Location where;                                           ///< of the mapping, for messages
  void keys(Schema& s);
};

/// One particle's passage.
struct Passage {
  double t = 0;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  double mass = 0;        ///< [kg], fines included
  double fines_mass = 0;  ///< [kg]
  double size = 0;        ///< rocks [m]
  double birth = 0;       ///< rocks [s]
  double wet_dose = 0;    ///< rocks [s]
  bool rock = false;
};

/// Sums of one bin over one interval of time.
struct BinSums {
  double rock_kg = 0, rock_kg2 = 0, rock_count = 0, water_kg = 0, fines_kg = 0;
  double rock_momentum = 0, water_momentum = 0;  ///< mass x speed [kg m/s]
  double rock_size_kg = 0;                       ///< mass x size [kg m]
  double rock_energy = 0;                        ///< kinetic [J]
  double rock_residence_kg = 0;                  ///< mass x time since birth [kg s]
  double dry_rock_kg = 0;                        ///< rock that left with a wet dose below the stated one
};

/// One exit's record: sums per interval and bin, kept for the whole run.
class ExitTally {
 public:
  ExitTally(ExitConfig config, double interval);
  const ExitConfig& config() const { return config_; }
  double interval() const { return interval_; }  ///< length of a time slot [s]
  void add(const Passage& p);
  std::size_t slots() const { return bins_per_slot_.size() / bin_count(); }
  std::size_t bin_count() const { return static_cast<std::size_t>(config_.bins); }
  const BinSums& at(std::size_t slot, std::size_t bin) const {
    return bins_per_slot_[slot * bin_count() + bin];
  }
  double rock_kg() const { return rock_kg_; }    ///< since start
  double water_kg() const { return water_kg_; }  ///< since start, fines included
  double fines_kg() const { return fines_kg_; }
  const std::vector<double>& sizes() const { return sizes_; }  ///< of every rock that left [m]
  const std::vector<double>& size_masses() const { return size_masses_; }
  std::size_t bin_of(const Vec3& x) const;
  void exchange(StateArchive& archive);

 private:
  ExitConfig config_;
  double interval_;
  std::vector<BinSums> bins_per_slot_;
  std::vector<double> sizes_, size_masses_;
  double rock_kg_ = 0, water_kg_ = 0, fines_kg_ = 0;
};

class Exits {
 public:
  /// @param interval  length of the time slots [s];  @param dry_dose  wet dose below which a rock left dry
  /// [s]
  Exits(std::vector<ExitConfig> configs, const Walls& walls, double interval);
  /// Removes what left in the step that ended at t and counts it; null for an absent phase.
  void collect(double t, DemSystem* rocks, FluidSystem* water);
  const std::vector<ExitTally>& tallies() const { return tallies_; }  ///< in configuration order
  const ExitTally& outside() const { return outside_; }               ///< open faces of the domain
  void exchange(StateArchive& archive);

 private:
  std::vector<ExitTally> tallies_;
  ExitTally outside_;
  const Walls* walls_;
  std::vector<std::vector<int>> deck_triangles_;
  std::vector<Vec3> rock_before_;  ///< centres at the last call, in rock order
  std::vector<std::uint64_t> rock_before_id_;
};

}  // namespace sluice
