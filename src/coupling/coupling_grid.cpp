#include "coupling/coupling_grid.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace sluice {

namespace {

// A level's spacing along one axis, and how many nodes that needs.
struct Axis {
  double spacing;
  int nodes;
};

Axis cut(double length, double wanted, bool periodic) {
  if (periodic) {
    const int cells = std::max(1, static_cast<int>(std::floor(length / wanted + 1e-9)));
    return {length / cells, cells};
  }
  return {wanted, static_cast<int>(std::ceil(length / wanted)) + 1};
}

}  // namespace

CouplingGrid::CouplingGrid(const Domain& domain, double fluid_spacing)
    : domain_(domain), fluid_spacing_(fluid_spacing) {
  const double longest = domain.box.size().maxCoeff();
  const int count = std::max(1, static_cast<int>(std::floor(std::log2(longest / (2 * fluid_spacing)))) + 1);
  levels_.resize(static_cast<std::size_t>(count));
  for (int l = 0; l < count; ++l) {
    const double wanted = std::ldexp(fluid_spacing, l);
    for (int k = 0; k < 3; ++k) {
      const Axis axis = cut(domain.box.size()[k], wanted, domain.periodic(k));
      level(l).spacing[k] = axis.spacing;
      level(l).nodes[k] = axis.nodes;
    }
  }
}

void CouplingGrid::make(int l) {
  CouplingLevel& level = this->level(l);
  const auto n = static_cast<std::size_t>(level.nodes.cast<long>().prod());
  level.solids.assign(n, 0);
  level.mass.assign(n, 0);
  level.momentum.assign(n, Vec3::Zero());
  level.density.assign(n, 0);
  level.viscosity.assign(n, 0);
  level.acceleration.assign(n, Vec3::Zero());
  level.displaced.assign(n, 0);
  level.impulse.assign(n, Vec3::Zero());
  level.drag_sum.assign(n, 0);
  level.drag_rock_momentum.assign(n, Vec3::Zero());
}

int CouplingGrid::level_for(double width) {
  int l = 0;
  while (l + 1 < level_count() && std::ldexp(2 * fluid_spacing_, l) < width * (1 - 1e-9)) ++l;
  if (!in_use(l)) make(l);
  return l;
}

LevelWeights CouplingGrid::weights(int l, const Vec3& x) const {
  const CouplingLevel& level = this->level(l);
  int low[3], high[3];
  double share[3];  // of the high node
  for (int k = 0; k < 3; ++k) {
    const double place = (x[k] - domain_.box.lo[k]) / level.spacing[k];
    const int n = level.nodes[k];
    if (domain_.periodic(k)) {
      const double floor = std::floor(place);
      low[k] = ((static_cast<int>(floor) % n) + n) % n;
      high[k] = (low[k] + 1) % n;
      share[k] = place - floor;
    } else {
      low[k] = std::clamp(static_cast<int>(std::floor(place)), 0, std::max(0, n - 2));
      high[k] = std::min(low[k] + 1, n - 1);
      share[k] = std::clamp(place - low[k], 0.0, 1.0);
    }
  }
  LevelWeights out;
  for (int c = 0; c < 8; ++c) {
    int index[3];
    double weight = 1;
    for (int k = 0; k < 3; ++k) {
      const bool upper = (c >> k) & 1;
      index[k] = upper ? high[k] : low[k];
      weight *= upper ? share[k] : 1 - share[k];
    }
    const auto i = static_cast<std::size_t>(c);
    out.node[i] = index[0] + level.nodes.x() * (index[1] + level.nodes.y() * index[2]);
    out.weight[i] = weight;
  }
  return out;
}

void CouplingGrid::clear_solids() {
  parallel_for(
      levels_.size(),
      [&](std::size_t l) { std::fill(levels_[l].solids.begin(), levels_[l].solids.end(), 0.0); }, 1);
}

void CouplingGrid::clear_fluid() {
  parallel_for(
      levels_.size(),
      [&](std::size_t l) {
        CouplingLevel& level = levels_[l];
        for (auto* field : {&level.mass, &level.density, &level.viscosity, &level.displaced, &level.drag_sum})
          std::fill(field->begin(), field->end(), 0.0);
        for (auto* field : {&level.momentum, &level.impulse, &level.drag_rock_momentum})
          std::fill(field->begin(), field->end(), Vec3(0, 0, 0));
      },
      1);
}

// Levels are independent of one another: one thread a level, nodes in their fixed order.
void CouplingGrid::gather(const FluidNodes& nodes) {
  parallel_for(
      levels_.size(),
      [&](std::size_t l) {
        CouplingLevel& level = levels_[l];
        if (level.mass.empty()) return;
        for (std::size_t i = 0; i < nodes.count(); ++i) {
          const LevelWeights w = weights(static_cast<int>(l), nodes.x[i]);
          for (std::size_t c = 0; c < 8; ++c) {
            const auto n = static_cast<std::size_t>(w.node[c]);
            const double m = w.weight[c] * nodes.mass[i];
            level.mass[n] += m;
            level.momentum[n] += m * nodes.v[i];
            level.density[n] += m * nodes.density[i];
            level.viscosity[n] += m * nodes.viscosity[i];
          }
        }
      },
      1);
}

void CouplingGrid::gather_acceleration(const FluidNodes& nodes, const std::vector<Vec3>& acceleration) {
  parallel_for(
      levels_.size(),
      [&](std::size_t l) {
        CouplingLevel& level = levels_[l];
        if (level.mass.empty()) return;
        std::fill(level.acceleration.begin(), level.acceleration.end(), Vec3(0, 0, 0));
        for (std::size_t i = 0; i < nodes.count(); ++i) {
          const LevelWeights w = weights(static_cast<int>(l), nodes.x[i]);
          for (std::size_t c = 0; c < 8; ++c)
            level.acceleration[static_cast<std::size_t>(w.node[c])] +=
                w.weight[c] * nodes.mass[i] * acceleration[i];
        }
      },
      1);
}

void CouplingGrid::scatter(const FluidNodes& nodes, std::vector<Vec3>& impulse,
                           std::vector<double>& displaced) const {
  impulse.assign(nodes.count(), Vec3::Zero());
  displaced.assign(nodes.count(), 0.0);
  parallel_for(nodes.count(), [&](std::size_t i) {
    for (int l = 0; l < level_count(); ++l) {
      if (!in_use(l)) continue;
      const CouplingLevel& level = this->level(l);
      const LevelWeights w = weights(l, nodes.x[i]);
      for (std::size_t c = 0; c < 8; ++c) {
        const auto n = static_cast<std::size_t>(w.node[c]);
        if (level.mass[n] <= 0) continue;
        const double share = w.weight[c] * nodes.mass[i] / level.mass[n];
        impulse[i] += share * level.impulse[n];
        displaced[i] += share * level.displaced[n];
      }
    }
  });
}

std::size_t CouplingGrid::memory_bytes() const {
  std::size_t bytes = 0;
  for (const CouplingLevel& level : levels_)
    bytes += level.mass.capacity() * (6 * sizeof(double) + 4 * sizeof(Vec3));
  return bytes;
}

}  // namespace sluice
