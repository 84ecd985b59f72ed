#pragma once
/// A fluid as the rest of the house sees it. Explicit MPM is the first; an implicit MPM and SPH can
/// stand here too: walls, emitters, coupling and analysis use nothing but this.
///
/// One fluid step is   points_to_grid  [coupling acts on nodes]  walls  grid_to_points.
/// A node is a place that carries fluid mass and velocity between those calls.

#include <functional>
#include <span>

#include "base/domain.h"
#include "base/load.h"
#include "base/state_archive.h"
#include "fluid/fluid_body.h"
#include "fluid/fluid_model.h"
#include "fluid/water_points.h"

namespace sluice {

/// Nodes with mass, in a fixed order; structure of arrays of #N. Valid until the next fluid call.
struct FluidNodes {
  double spacing = 0;               ///< [m]
  std::vector<Vec3> x;              ///< [m]
  std::vector<double> mass;         ///< [kg]
  std::vector<Vec3> v;              ///< after forces and gravity, before walls and coupling [m/s]
  std::vector<double> open_volume;  ///< space of the node that walls leave free, whatever is in it [m3]
  std::vector<double> pressure;     ///< mass-weighted [Pa]
  std::vector<double> fill;         ///< fluid volume over the space open to it, 1 = full
  std::vector<double> viscosity;    ///< [Pa s]; at rest, where it depends on the rate of shear
  std::vector<double> density;      ///< of the fluid itself [kg/m3]
  std::size_t count() const { return mass.size(); }
};

struct FluidStepLimits {
  double sound_speed = 0;  ///< [m/s]
  double acoustic = 0;     ///< [s]
  double viscous = 0;      ///< [s]
  double step = 0;         ///< chosen [s]
  const char* governed_by = "";
};

class FluidSystem {
 public:
  virtual ~FluidSystem() = default;

  virtual double spacing() const = 0;  ///< [m]
  virtual const FluidStepLimits& limits() const = 0;
  virtual const FluidModel& model() const = 0;
  /// True where water sticks to walls: then the drag of a body is its own, else only its form's part in ideal
  /// flow, which is none.
  virtual bool sticks_to_walls() const = 0;
  virtual double point_volume() const = 0;  ///< rest volume of one point [m3]

  virtual std::uint64_t add(const NewPoint& point) = 0;  ///< returns the id
  virtual std::size_t count() const = 0;
  /// All points as a copy, ascending id.
  virtual WaterPoints points() const = 0;
  /// Removes points for which `leaves` says so and returns them in ascending id. Called in parallel.
  virtual std::vector<RemovedPoint> remove_if(
      const std::function<bool(const Vec3& before, const Vec3& now)>& leaves) = 0;
  /// Removes and returns points beyond the open faces of the domain.
  virtual std::vector<RemovedPoint> remove_outside() = 0;

  /// @param t  time at the start of the step [s];  @param dt  [s]
  virtual void points_to_grid(double t, double dt) = 0;
  virtual void walls(double dt) = 0;
  /// @throws NumericalError: NaN, a step longer than a point's path allows
  virtual void grid_to_points(double dt) = 0;

  /// Material acceleration Du/Dt of each node in the step that just ended, walls, pressure, gravity and
  /// coupling included: (v at the end - v that the points brought) / dt [m/s2]. In the order of
  /// read_nodes; valid after grid_to_points until the next points_to_grid.
  virtual void read_accelerations(std::vector<Vec3>& acceleration) const = 0;
  /// For the coupling, between points_to_grid and walls.
  virtual void read_nodes(FluidNodes& nodes) const = 0;
  /// Impulse per node [N s], in the order of read_nodes; momentum arrives exactly.
  virtual void add_impulse(std::span<const Vec3> impulse) = 0;
  /// Fraction of the space at each node that rocks leave free, in the order of read_nodes; acts where
  /// fluid and rock together fill the space. Held until set again; not called = 1 everywhere.
  virtual void set_void_fraction(std::span<const double> void_fraction) = 0;

  /// Bodies that the fluid meets in the next step, besides the walls; held until set again, but to be set
  /// before each step in which they move. For the coupling, before points_to_grid.
  virtual void set_bodies(std::span<const FluidBody> bodies) = 0;
  /// What each of them received since they were set.
  virtual const std::vector<BodyLoad>& body_loads() const = 0;

  virtual const std::vector<WallLoad>& wall_loads() const = 0;  ///< one per wall
  virtual Vec3 momentum() const = 0;                            ///< [N s]
  virtual Vec3 impulse_from_gravity() const = 0;                ///< since start [N s]
  virtual Vec3 momentum_added() const = 0;                      ///< by add() since start [N s]
  virtual Vec3 momentum_removed() const = 0;     ///< by remove_if and remove_outside since start [N s]
  virtual double kinetic_energy() const = 0;     ///< [J]
  virtual double kinetic_added() const = 0;      ///< by add() since start [J]
  virtual double kinetic_removed() const = 0;    ///< by remove_if and remove_outside since start [J]
  virtual double wall_work() const = 0;          ///< that walls in motion did on the fluid since start [J]
  virtual double largest_speed() const = 0;      ///< of any point in the last step [m/s]
  virtual double total_mass() const = 0;         ///< of the points inside, as stored, summed in double [kg]
  virtual double total_fines() const = 0;        ///< [kg]
  virtual std::uint64_t state_hash() const = 0;  ///< sum of hashes per point by id
  virtual std::size_t memory_bytes() const = 0;
  virtual void exchange(StateArchive& archive) = 0;
};

}  // namespace sluice
