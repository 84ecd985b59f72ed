#include "processes/check_motion.h"

#include <fmt/format.h>

#include <algorithm>

#include "processes/check_places.h"

namespace sluice {

std::vector<InputProblem> motion_problems(const ProcessConfig& config, const WallConfig& entry,
                                          std::span<const Wall> walls) {
  std::vector<InputProblem> problems;
  if (!entry.motion) return problems;
  if (config.water && entry.blocks != BlocksPhase::rocks_only)
    problems.push_back({entry.motion_at, "motion", fmt::format("moves '{}', which blocks water", entry.name),
                        "water does not see walls move yet",
                        fmt::format("set 'walls.{}.blocks: rocks_only', or leave 'motion' out", entry.name)});
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

std::vector<InputProblem> unresolved_motions(const ProcessConfig& config, double step) {
  std::vector<InputProblem> problems;
  for (const WallConfig& entry : config.walls) {
    if (!entry.motion) continue;
    const double steps = shortest_time(*entry.motion) / step;
    if (steps >= least_steps_per_period) continue;
    problems.push_back({entry.motion_at, "motion",
                        fmt::format("has {:.3g} s for a period, a turn or from one keyframe to the next",
                                    shortest_time(*entry.motion)),
                        fmt::format("that is {:.3g} time steps of the rocks; {:.0f} are needed", steps,
                                    least_steps_per_period),
                        "slow it down, or raise 'rocks.steps_per_contact'"});
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
    if (config.rocks && range.speed > config.rocks->impact_speed)
      warnings.push_back(fmt::format("{}: moves at {:.3g} m/s, faster than 'rocks.impact_speed' ({:.3g} m/s)",
                                     wall.name, range.speed, config.rocks->impact_speed));
  }
  return warnings;
}

}  // namespace sluice
