#pragma once
/// Exits take out rock and water and count them, per bin across their width.
///
/// plane: taken when the path of a step crosses a rectangle, in either direction
/// box:   taken when inside
/// deck:  a wall part whose apertures let water and fines through and stop rocks: water whose path
///        crosses the part's triangles is taken; rocks are not
/// `outside` (open faces of the domain) is counted here too. Of several exits that one step would take a
/// particle to, the first of the process file gets it.

#include <array>
#include <memory>
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
  /// Ends of the width; bins lie between [m]. Alike: the longest level edge of the rectangle, box or part.
  Vec3 width_from = Vec3::Zero(), width_to = Vec3::Zero();
  double aperture = 0;  ///< deck: of the screen cloth [m]
  double dry_dose = 0;  ///< a rock with a wet dose up to this left dry [s]
  Location where;       ///< of the mapping, for messages
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
  double rock_kg = 0, rock_kg2 = 0, rock_count = 0, water_kg = 0, water_kg2 = 0, fines_kg = 0;
  double rock_momentum = 0, water_momentum = 0;  ///< mass x speed [kg m/s]
  double rock_size_kg = 0;                       ///< mass x size [kg m]
  double rock_energy = 0;                        ///< kinetic [J]
  double rock_residence_kg = 0;                  ///< mass x time since birth [kg s]
  double dry_rock_kg = 0;                        ///< rock that left with a wet dose below the stated one
};

/// Every rock that left through one exit: structure of arrays, in order of passage.
struct RockRecord {
  std::vector<double> t;          ///< [s]
  std::vector<double> size;       ///< [m]
  std::vector<double> mass;       ///< [kg]
  std::vector<double> residence;  ///< time since birth [s]
  std::vector<double> wet_dose;   ///< [s]
  std::vector<std::int32_t> bin;

  std::size_t count() const { return t.size(); }
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
  const Vec3& rock_momentum() const { return rock_momentum_; }    ///< taken along since start [N s]
  const Vec3& water_momentum() const { return water_momentum_; }  ///< [N s]
  const RockRecord& rocks() const { return rocks_; }
  const std::vector<double>& sizes() const { return rocks_.size; }  ///< of every rock that left [m]
  const std::vector<double>& size_masses() const { return rocks_.mass; }
  std::size_t bin_of(const Vec3& x) const;
  void exchange(StateArchive& archive);

 private:
  ExitConfig config_;
  double interval_;
  std::vector<BinSums> bins_per_slot_;
  RockRecord rocks_;
  double rock_kg_ = 0, water_kg_ = 0, fines_kg_ = 0;
  Vec3 rock_momentum_ = Vec3::Zero(), water_momentum_ = Vec3::Zero();
};

/// Checks exits against the scene.
/// @param cell  of the water's grid [m], 0 = no water: a deck has apertures of at most two cells
/// @throws InputError: an exit outside the domain, a deck whose part is missing or stops water
void check_exits(const std::vector<ExitConfig>& configs, const Domain& domain, const Walls& walls,
                 double cell = 0);

class Exits {
 public:
  /// @param walls  must outlive the exits;  @param interval  length of the time slots [s]
  /// @param domain  for paths that run through periodic faces
  /// @throws InputError where the part of a deck is missing
  Exits(std::vector<ExitConfig> configs, const Walls& walls, double interval, Domain domain = {});
  /// Removes what left in the step that ended at t and counts it; null for an absent phase.
  void collect(double t, DemSystem* rocks, FluidSystem* water);
  const std::vector<ExitTally>& tallies() const { return tallies_; }  ///< in configuration order
  const ExitTally& outside() const { return outside_; }               ///< open faces of the domain
  void exchange(StateArchive& archive);

 private:
  void collect_rocks(double t, DemSystem& rocks);
  void collect_water(double t, FluidSystem& water);
  /// Exit that takes a particle on its way, or -1.
  int exit_of(const Vec3& before, const Vec3& now, bool rock) const;
  /// Centre of each rock at the last call; its present one where it was not there.
  std::vector<Vec3> places_before(const Rocks& rocks) const;
  void remember_places(const Rocks& rocks);

  std::vector<ExitTally> tallies_;
  ExitTally outside_;
  Domain domain_;
  std::vector<std::unique_ptr<SurfaceQuery>> decks_;  ///< one per exit, null where it is no deck
  std::vector<Box> bounds_;                           ///< one per exit
  std::vector<Vec3> rock_before_;                     ///< centres at the last call, in rock order
  std::vector<std::uint64_t> rock_before_id_;
};

}  // namespace sluice
