#pragma once
/// Small bodies of water for the measures.

#include <functional>
#include <memory>
#include <vector>

#include "mpm/mpm_system.h"

namespace sluice {

struct WaterSetup {
  MpmConfig config;
  Domain domain;
  Vec3 gravity = Vec3::Zero();  ///< [m/s2]
};

/// Points on a lattice in a box, moved by up to `jitter` of their distance.
struct WaterFill {
  Box box;
  double jitter = 0;
  std::function<Vec3(const Vec3&)> velocity = [](const Vec3&) { return Vec3(Vec3::Zero()); };  ///< [m/s]
  std::function<double(const Vec3&)> pressure = [](const Vec3&) { return 0.0; };               ///< [Pa]
};

/// A FluidSystem with its walls and clock.
class WaterScene {
 public:
  WaterScene(const WaterSetup& setup, std::vector<Wall> walls);
  void fill(const WaterFill& fill);
  /// One step; `look` is called between the transfer to the grid and the walls.
  void step(const std::function<void()>& look = {});
  /// Steps until `time` [s], the last one included, with the step that fits.
  void run_to(double time);

  Walls walls;
  std::unique_ptr<FluidSystem> water;
  double t = 0;  ///< [s]
  double point_steps = 0;
};

/// Rectangle through four corners, in order.
Wall sheet(const char* name, const std::array<Vec3, 4>& corners);
/// Floor and ends of a tank along x, from 0 to `length`, for a domain that is periodic across, `width` wide.
/// Sheets that reach `beyond` one another.
std::vector<Wall> trough(double length, double width, double top, double beyond);
/// Open box whose faces along an axis are periodic.
Domain water_domain(const Box& box, std::array<bool, 3> periodic);

/// p at a depth below the surface of still water that obeys p = rho0 c^2 (1/J - 1):
/// rho0 c^2 (exp(g d / c^2) - 1) [Pa].
double still_pressure(double density, double gravity, double sound_speed, double depth);

}  // namespace sluice
