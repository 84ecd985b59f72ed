#pragma once
/// The rocks and everything that moves them. Valid after the constructor; owns its scratch.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/domain.h"
#include "base/load.h"
#include "base/schema.h"
#include "base/state_archive.h"
#include "base/statistics.h"
#include "dem/contact_law.h"
#include "dem/materials.h"
#include "dem/near_walls.h"
#include "dem/rock_shape.h"
#include "dem/rocks.h"
#include "geometry/wall.h"

namespace sluice {

/// Keys under `rocks:` of a process file.
struct DemConfig {
  double impact_speed = 5;                   ///< fastest impact to be expected [m/s]
  double impact_overlap = 0.05;              ///< at that speed, of the radius
  double bed_overlap = 0.005;                ///< mean in the bed, of the radius
  double bed_depth = 1;                      ///< depth of rock that rests on the lowest layer [m]
  std::optional<double> stiffness_per_size;  ///< k_n / size, instead of the two rules [N/m2]
  double tangential_ratio = 2.0 / 7.0;       ///< k_t / k_n
  double network_fraction = 0.2;             ///< time step over the critical step of a contact network
  double steps_per_contact = 30;             ///< at least
  EndOfContact end_of_contact = EndOfContact::no_tension;
  double overlap_limit = 0.3;  ///< of the radius; beyond it the run stops (exit 3)
  std::vector<std::pair<const char*, Location>> linear_keys;  ///< given, and of the linear law alone
  void keys(Schema& s);
};

/// What the time step comes from, for `check` and the run header.
struct DemStepLimits {
  double stiffness_per_size = 0;  ///< k_n / size of the linear law; 0 where it is not used [N/m2]
  double network = 0;             ///< critical step of the stiffest contact possible [s]
  double contact_time = 0;        ///< shortest contact duration [s]
  double step = 0;                ///< chosen [s]
  const char* governed_by = "";   ///< "network_fraction" or "steps_per_contact"
  const char* stiffness_from =
      "";                    ///< "impact_overlap", "bed_overlap", "stiffness_per_size", "youngs_modulus"
  std::string contact;       ///< that governs: "" for the linear law, else "hertz_mindlin, rock on steel"
  double hertz_overlap = 0;  ///< over radius, at the impact speed or in the bed; 0 without hertz_mindlin
};

struct DemEnergy {
  double kinetic = 0, elastic = 0, potential = 0;                                        ///< now [J]
  double dissipated_normal = 0, dissipated_friction = 0, wall_work = 0, fluid_work = 0;  ///< since start [J]
  double gravity_work = 0;        ///< on rocks inside, since start [J]
  double added = 0, removed = 0;  ///< kinetic, by add() and by remove(), since start [J]

  /// Everything that gravity, walls, water and new rocks do not account for: zero but for the scheme's
  /// error, negative where rocks left while they touched [J].
  double created() const {
    return kinetic + elastic + dissipated_normal + dissipated_friction - wall_work - fluid_work -
           gravity_work - added + removed;
  }
};

struct DemScene {
  Materials materials;
  std::vector<RockShape> shapes;
  Domain domain;
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s2]
  double smallest_size = 0;          ///< that a feed or fill can make [m]; sets stiffness and step
  double largest_size = 0;           ///< [m]
  double densest = 0;                ///< [kg/m3]
};

/// A rock that left through an open face of the domain or was taken by an exit.
struct RemovedRock {
  std::uint64_t id = 0;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  double size = 0, mass = 0, birth = 0, wet_dose = 0;
  int source = 0;
};

class DemSystem {
 public:
  /// The walls must outlive the system.
  /// @throws InputError for a scene that cannot be (zero size or density, m < 2)
  DemSystem(const DemConfig& config, DemScene scene, const Walls& walls);
  ~DemSystem();

  const Rocks& rocks() const;
  const std::vector<RockShape>& shapes() const;
  const Materials& materials() const;
  const DemScene& scene() const;
  Vec3 semi_axes(std::size_t rock) const;  ///< [m]
  Vec3 inertia(std::size_t rock) const;    ///< principal, body frame [kg m2]
  double volume(std::size_t rock) const;   ///< [m3]

  const DemStepLimits& limits() const;
  double step_size() const { return limits().step; }

  /// Adds a rock; its mass follows from shape, size and material. Returns its id.
  std::uint64_t add(const NewRock& rock);
  /// Mass that `add` would give it [kg].
  double mass_of(int shape, int material, double size) const;
  /// True if a sphere [m] meets no rock's bounding sphere and (if asked) no wall. `added` since the
  /// last step counts too.
  bool has_room(const Vec3& x, double radius, bool check_walls) const;

  /// The walls within `reach` [m] of the sphere of a rock's size about its centre, as they are now.
  std::vector<NearWall> near_walls(std::size_t rock, double reach) const;

  /// Takes rocks out; indices ascending. Returns what was removed, in that order.
  std::vector<RemovedRock> remove(std::span<const std::size_t> indices);
  /// Removes and returns rocks beyond the open faces of the domain.
  std::vector<RemovedRock> remove_outside();

  /// Force [N] and torque [N m] from the fluid, space frame, one per rock; held until set again.
  /// Rocks added later start with none; removals keep the others.
  void set_fluid_force(std::span<const Vec3> force, std::span<const Vec3> torque);

  /// Adds wetted fraction x dt to each rock's wet dose; one entry per rock.
  void add_wet_dose(std::span<const double> wetted_fraction, double dt);

  /// One time step of `dt` [s] starting at time `t` [s]; one of no time finds the forces on rocks that touch.
  /// @throws NumericalError: NaN, overlap beyond the limit
  /// @throws std::invalid_argument: dt is negative, or zero where walls move
  void step(double t, double dt);
  /// `n` of them: the same bits as one after the other, in less time.
  void steps(double t, double dt, int n);

  std::size_t contact_count() const;
  const Histogram& overlaps() const;                ///< overlap over radius, in percent, sampled over the run
  double overlap_mean() const;                      ///< percent of radius, over the run's samples
  double overlap_max() const;                       ///< percent of radius, over the run
  const std::vector<WallLoad>& wall_loads() const;  ///< one per wall
  DemEnergy energy() const;
  Vec3 momentum() const;              ///< [N s]
  Vec3 impulse_from_gravity() const;  ///< since start, on rocks inside [N s]
  Vec3 impulse_from_fluid() const;    ///< since start [N s]
  Vec3 momentum_added() const;        ///< by add() since start [N s]
  Vec3 momentum_removed() const;      ///< by remove() and remove_outside() since start [N s]

  std::uint64_t state_hash() const;  ///< sum of hashes per rock by id
  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sluice
