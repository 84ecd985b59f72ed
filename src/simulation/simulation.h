#pragma once
/// The clock and the stages over the parts.

#include "base/memory_archive.h"
#include "simulation/parts.h"
#include "simulation/stages.h"
#include "simulation/watch.h"

namespace sluice {

class Simulation {
 public:
  /// @param step  any other than the one that the parts' limits allow, to find out where it breaks
  explicit Simulation(Parts parts, const std::optional<TimeStep>& step = std::nullopt);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  void step();                                                                 ///< @throws NumericalError
  double time() const { return static_cast<double>(steps_) * time_step_.dt; }  ///< [s]
  std::uint64_t steps() const { return steps_; }
  const TimeStep& time_step() const { return time_step_; }
  const Parts& parts() const { return *parts_; }
  const std::vector<Stage>& stages() const { return stages_; }
  const Watch& watch() const { return watch_; }
  std::size_t rocks_max() const { return rocks_max_; }    ///< most rocks at once
  std::size_t points_max() const { return points_max_; }  ///< most water points at once
  double rock_steps() const { return rock_steps_; }       ///< sum of rocks over rock steps
  double point_steps() const { return point_steps_; }     ///< sum of points over fluid steps
  std::uint64_t state_hash() const;                       ///< of rocks and water; equal for any thread count
  SceneView view() const;
  void exchange(StateArchive& archive);

 private:
  std::unique_ptr<Parts> parts_;  ///< stays where it is: the stages point to it
  TimeStep time_step_;
  std::vector<Stage> stages_;
  Watch watch_;
  std::uint64_t steps_ = 0;
  std::size_t rocks_max_ = 0, points_max_ = 0;
  double rock_steps_ = 0, point_steps_ = 0;
};

}  // namespace sluice
