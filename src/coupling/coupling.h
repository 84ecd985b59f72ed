#pragma once
/// What rock and water do to each other. Rocks of many cells are resolved, if asked (resolved_rocks.h), those
/// of a few in part. All else is not: void fraction and drag on a coupling grid that is coarser than the
/// fluid's nodes, called between points_to_grid and walls of a fluid step.
///
///   solids_to_grid  rocks -> volume on the coupling grid (kernel renormalised per rock)
///   drag            fluid nodes -> coupling grid; wetted fraction, drag, buoyancy; the same impulse to
///                   both sides; void fraction to the fluid
///   fluid_to_grid   after the fluid has moved: its acceleration, walls included, for the buoyancy
///
/// Drag is evaluated once per exchange; the rocks keep the force over their substeps.
///
/// Per wet node n of the coupling grid, rocks r with weights w (sum 1 over the wet nodes of a rock):
///   b = m_r (1 - exp(-beta dt / m_r))                       what a rock can take up in dt [kg]
///   u' = (m u + sum b w v_r) / (m + sum b w)                all rocks of a node at once
///   impulse on r from n = b w (u' - v_r), its opposite on n
/// so that no node is overdrawn, nothing overshoots, and the third law holds to rounding.
///
/// Buoyancy is s V rho (Du/Dt - g - f), s the wetted fraction, f what drag does to the fluid [m/s2],
/// low-passed: that is -s V grad p of model A, Archimedes in still water, nothing in free fall, and the
/// weight of water and rock together in a suspension that neither rises nor falls. The fluid carries the
/// pressure gradient of the whole space and gives the rocks' share back through this impulse. No added mass
/// in this range. Where asked, drag acts at the centre of pressure of long and flat rocks, and spin against
/// the water's is resisted (turning.h). That couple is not given to the water, whose cells are larger than
/// the rock.
///
/// A rock that is resolved in part has a core of c times its size (resolved_rocks.h). Void fraction and
/// buoyancy here are those of the other 1 - c^3 of its volume. The core's own drag is its force, filtered,
/// less its buoyancy; cells exaggerate a small core's, and the share c^4 of it counts: what is too much is
/// taken back here, so that all is continuous in the size of rocks, from a chip to a lump. How much of the
/// law acts is a matter of the surface:
///   water slips, or has a film   the flow past what is resolved is nearly ideal, without the separation that
///                                makes a rock's drag: the law acts on every rock, resolved or not
///   water sticks                 a resolved rock's drag is its own; the law's share is 1 - c^6
/// On what is resolved no torque acts here.

#include <memory>
#include <optional>

#include "base/schema.h"
#include "base/state_archive.h"
#include "coupling/drag_law.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

struct ResolvedExtent;

enum class CouplingMode { two_way, one_way };  ///< one-way: rocks feel the water, not the other way round
enum class CouplingTorque { none, centre_of_pressure };  ///< on rocks that are not resolved; turning.h
enum class FilmModel { none, normal };  ///< lubrication between resolved rocks and walls; lubrication.h
/// Keys under `coupling:` of a process file.
struct CouplingConfig {
  CouplingMode mode = CouplingMode::two_way;
  DragModel drag = DragModel::di_felice;
  CouplingTorque torque = CouplingTorque::none;
  double kernel_diameters = 4;       ///< full width of the kernel over the rock's size
  double filter_time_factor = 7;     ///< buoyancy is filtered over this many h / c
  std::int64_t wetting_points = 32;  ///< points on each rock that find its wetted fraction
  /// Size over the water's spacing from which on rocks are resolved; none are where it is not given.
  std::optional<double> resolve_from;
  std::optional<double> resolve_partly_from;  ///< the same for their core; a third of it where not given
  Location resolve_from_at;
  FilmModel lubrication = FilmModel::none;
  double lubrication_roughness = 1e-3;  ///< thinnest film over the radius
  Location lubrication_at;
  double partly_from() const { return resolve_partly_from.value_or(resolve_from.value_or(0) / 3); }
  void keys(Schema& s);
};

class Coupling {
 public:
  /// Both systems must outlive the coupling.
  Coupling(const CouplingConfig& config, const Domain& domain, const Vec3& gravity, DemSystem& rocks,
           FluidSystem& fluid);
  ~Coupling();

  /// True where rocks may be resolved: only then the two calls around each fluid step are needed.
  bool resolves() const { return resolved() != nullptr; }
  const ResolvedExtent* resolved() const;  ///< null where none may be
  /// Takes water out of the fluid that lies inside resolved rocks: where both were put in one place.
  std::vector<RemovedPoint> make_room();
  /// Before and after substep k of the fluid's n in a step of dt [s].
  void place_resolved(double dt, int k, int n);
  void take_resolved(double dt, int k, int n);

  void solids_to_grid();
  /// @param dt  over which the forces will act on both sides [s]
  void drag(double dt);
  /// @param dt  of the fluid step that just ended [s]
  void fluid_to_grid(double dt);

  const std::vector<double>& wetted_fraction() const;  ///< per rock, of the last call, 0..1
  const std::vector<Vec3>& drag_force() const;         ///< per rock, of what is not resolved [N]
  const std::vector<Vec3>& buoyancy_force() const;     ///< per rock, of what is not resolved [N]
  const std::vector<Vec3>& force() const;              ///< all of it, per rock [N]
  const std::vector<Vec3>& torque() const;             ///< per rock [N m]
  const std::vector<WallLoad>& film_loads() const;  ///< one per wall, of films that rocks press on; or none
  Vec3 impulse_on_rocks() const;                    ///< by the water, films apart, since start [N s]
  Vec3 impulse_on_fluid() const;                    ///< since start; the opposite in two-way [N s]
  double smallest_kernel_ratio() const;   ///< kernel width over rock size, least so far; 0 = no rock yet
  double smallest_void_fraction() const;  ///< handed to the fluid, least so far
  std::size_t memory_bytes() const;
  void exchange(StateArchive& archive);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sluice
