#pragma once
/// What may look at a scene while it runs.

#include <cstdint>
#include <string>
#include <vector>

#include "base/state_archive.h"
#include "dem/dem_system.h"
#include "fluid/fluid_system.h"

namespace sluice {

/// What a probe sees; a part that the scene lacks is null.
struct SceneView {
  double t = 0;   ///< end of the step [s]
  double dt = 0;  ///< of the step [s]
  const DemSystem* rocks = nullptr;
  const FluidSystem* water = nullptr;
  const Walls* walls = nullptr;
};

class Probe {
 public:
  virtual ~Probe() = default;
  virtual const std::string& name() const = 0;
  virtual double interval() const = 0;  ///< simulated time between looks [s]
  virtual void look(const SceneView& scene) = 0;
  /// Columns for series.csv, named with unit ("level_m"), and their present values.
  virtual std::vector<std::string> columns() const = 0;
  virtual std::vector<double> values() const = 0;
  virtual void exchange(StateArchive& archive) = 0;
};

}  // namespace sluice
