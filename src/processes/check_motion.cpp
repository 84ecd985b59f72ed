#include "processes/check_motion.h"

#include <fmt/format.h>

#include <algorithm>

#include "processes/check_places.h"

namespace sluice {

std::vector<InputProblem> motion_problems(const ProcessConfig& config, const WallConfig& entry,
                                          std::span<const Wall> walls) {
  std::vector<InputProblem> problems;
  if (!entry.motion) return problems;
  std::vector<Vec3> corners;
  for (const Wall& wall : walls)
    corners.insert(corners.end(), wall.mesh.vertices.begin(), wall.mesh.vertices.end());
  if (corners.empty()) return problems;  // no part was found; that is said already
  const Box domain = config.domain.domain().box;
  for (const Box& bounds : motion_range(*entry.motion, corners).bounds)
    if (!domain.overlaps(bounds)) {
      problems.push_back({entry.motion_at, "motion",
                          fmt::format("carries '{}' to {}", entry.name, reach_of(bounds)),
                          fmt::format("the domain reaches {}", reach_of(domain)),
                          "shorten the motion, or enlarge the domain"});
      break;
    }
  return problems;
}

std::vector<InputProblem> unresolved_motions(const ProcessConfig& config, double rock_step,
                                             double water_step) {
  std::vector<InputProblem> problems;
  for (const WallConfig& entry : config.walls) {
    if (!entry.motion) continue;
    const double time = shortest_time(*entry.motion);
    const auto look = [&](const char* of, double step, double least, const char* key) {
      if (time >= least * step) return;
      problems.push_back(
          {entry.motion_at, "motion",
           fmt::format("has {:.3g} s for a period, a turn or from one keyframe to the next", time),
           fmt::format("that is {:.3g} time steps of the {}; {:.0f} are needed", time / step, of, least),
           fmt::format("slow it down, or {}", key)});
    };
    look("rocks", rock_step, least_rock_steps_per_period, "raise 'rocks.steps_per_contact'");
    if (entry.blocks != BlocksPhase::rocks_only)
      look("water", water_step, least_water_steps_per_period, "lower 'water.courant'");
  }
  return problems;
}

std::vector<std::string> motion_warnings(const ProcessConfig& config, std::span<const Wall> walls) {
  std::vector<std::string> warnings;
  const Box domain = config.domain.domain().box;
  const auto within = [&](const Box& box) { return domain.contains(box.lo) && domain.contains(box.hi); };
  for (const Wall& wall : walls) {
    if (!wall.motion || wall.mesh.vertices.empty()) continue;
    const MotionRange range = motion_range(*wall.motion, wall.mesh.vertices);
    if (within(wall.mesh.bounds()) && !within(range.swept))
      warnings.push_back(
          fmt::format("{}: its motion reaches out of the domain, to {}", wall.name, reach_of(range.swept)));
    if (config.water && wall.blocks != BlocksPhase::rocks_only &&
        range.speed > config.water->fastest_bulk_speed)
      warnings.push_back(
          fmt::format("{}: moves at {:.3g} m/s, faster than 'water.fastest_bulk_speed' ({:.3g} m/s)",
                      wall.name, range.speed, config.water->fastest_bulk_speed));
    if (config.rocks && range.speed > config.rocks->impact_speed)
      warnings.push_back(fmt::format("{}: moves at {:.3g} m/s, faster than 'rocks.impact_speed' ({:.3g} m/s)",
                                     wall.name, range.speed, config.rocks->impact_speed));
  }
  return warnings;
}

}  // namespace sluice
