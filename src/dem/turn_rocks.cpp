/// Free rotation of the rocks of a chunk, as many side by side as the processor has lanes.

#include <algorithm>

#include "dem/dem_state.h"
#include "dem/lane_rows.h"
#include "dem/rigid_motion.h"

namespace sluice {

namespace {
using lanes::all_lanes;
using lanes::kLanes;
using lanes::LaneIndices;
using lanes::LaneMask;
using lanes::Lanes;
using LaneTriple = lanes::Triple<Lanes>;

// Free rotation changes the angular velocity within a step, by far less than this.
constexpr double rotation_margin = 1.05;
}  // namespace

/// Orientation at the end of the step, angular velocity there with the momentum of the half step, and what
/// contacts read of both. A sphere keeps its orientation.
void DemSystem::Implementation::turn_rocks(std::size_t begin, std::size_t end, double dt) {
  for (std::size_t first = begin; first < end; first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, end - first);
    LaneIndices at;
    LaneMask round;
    Turn<Lanes> before;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::size_t i = first + std::min(k, count - 1);
      at[k] = static_cast<std::uint32_t>(i);
      round[k] = has_sphere_shape(rocks.shape[i]) ? -1 : 0;
      const Quat& q = rocks.q[i];
      before.v.x[k] = q.x();
      before.v.y[k] = q.y();
      before.v.z[k] = q.z();
      before.w[k] = q.w();
    }
    const LaneTriple l = lanes::load_triples(angular, at), by = lanes::load_triples(per_inertia, at);
    Turn<Lanes> q = before;
    rotate_freely(q, l, by, dt);
    q = {lanes::select(round, before.v, q.v), lanes::select(round, before.w, q.w)};
    const LaneTriple w = angular_velocity(q, l, by);
    lanes::store_triples(w, rocks.w, at, count);
    const Lanes rim = rotation_margin * lanes::root(dot(w, w));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = at[k];
      const RockShape& shape = shape_of(i);
      rocks.q[i] = Quat(q.w[k], q.v.x[k], q.v.y[k], q.v.z[k]);
      turned_shapes[i] = {rocks.q[i], shape.semi_axes * rocks.size[i], shape.blockiness};
      rim_speed[i] = rim[k] * rocks.radius[i];
    }
  }
}

}  // namespace sluice
