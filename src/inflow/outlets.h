#pragma once
/// A row of equal water outlets: one entry of a process file makes ten pipes or forty nozzles.

#include <optional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "base/vec.h"

namespace sluice {

/// Keys that pipes and nozzles share.
struct OutletRow {
  Vec3 position = Vec3::Zero();   ///< middle of the first outlet [m]
  Vec3 direction = Vec3::Zero();  ///< the way the water goes; any length
  std::int64_t count = 1;
  Vec3 spacing = Vec3::Zero();       ///< from one outlet to the next [m]
  std::vector<double> blocked;       ///< outlets that give nothing, counted from 1
  std::optional<double> flow;        ///< of each open outlet [m3/s]
  std::optional<double> total_flow;  ///< of all open outlets together [m3/s]
  double start = 0;                  ///< [s]
  std::optional<double> stop;        ///< [s]

  void keys(Schema& s);
  Vec3 axis() const { return direction.normalized(); }
  /// Of one open outlet, where a flow is given [m3/s].
  double flow_each() const;
  /// Middles of the outlets that are open [m].
  std::vector<Vec3> open_outlets() const;
};

}  // namespace sluice
