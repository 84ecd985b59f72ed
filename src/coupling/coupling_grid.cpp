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

CouplingGrid::CouplingGrid(const Domain& domain, double fluid_spacing, double narrowest, double widest)
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
  coarsest_ = level_count() - 1;
  finest_ = level_for(narrowest);
  coarsest_ = level_for(widest);
  for (int l = finest_; l <= coarsest_; ++l) make(l);
  for (int l = finest_; l < coarsest_; ++l)
    for (std::size_t n = 0; n < level(l).mass.size(); ++n)
      level(l).up.push_back(weights(l + 1, place_of(l, static_cast<int>(n))));
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

int CouplingGrid::level_for(double width) const {
  int l = finest_;
  while (l < coarsest_ && std::ldexp(2 * fluid_spacing_, l) < width * (1 - 1e-9)) ++l;
  return l;
}

Vec3 CouplingGrid::place_of(int l, int node) const {
  const CouplingLevel& level = this->level(l);
  const Vec3 index(node % level.nodes.x(), (node / level.nodes.x()) % level.nodes.y(),
                   node / (level.nodes.x() * level.nodes.y()));
  return domain_.box.lo + index.cwiseProduct(level.spacing);
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
  for (CouplingLevel& level : levels_) std::fill(level.solids.begin(), level.solids.end(), 0.0);
}

void CouplingGrid::gather(const FluidNodes& nodes) {
  for (CouplingLevel& level : levels_) {
    for (const int node : level.wet) {
      const auto n = static_cast<std::size_t>(node);
      level.mass[n] = level.density[n] = level.viscosity[n] = level.displaced[n] = level.drag_sum[n] = 0;
      level.momentum[n] = level.acceleration[n] = level.impulse[n] = level.drag_rock_momentum[n] =
          Vec3::Zero();
    }
    level.wet.clear();
  }
  of_fluid_.resize(nodes.count());
  parallel_for(nodes.count(), [&](std::size_t i) { of_fluid_[i] = weights(finest_, nodes.x[i]); });

  // Sums in one order, whatever the threads: nodes are few beside points.
  CouplingLevel& finest = level(finest_);
  for (std::size_t i = 0; i < nodes.count(); ++i)
    for (std::size_t c = 0; c < 8; ++c) {
      const double m = of_fluid_[i].weight[c] * nodes.mass[i];
      if (m <= 0) continue;
      const auto n = static_cast<std::size_t>(of_fluid_[i].node[c]);
      if (finest.mass[n] == 0) finest.wet.push_back(of_fluid_[i].node[c]);
      finest.mass[n] += m;
      finest.momentum[n] += m * nodes.v[i];
      finest.density[n] += m * nodes.density[i];
      finest.viscosity[n] += m * nodes.viscosity[i];
    }
  for (int l = finest_; l < coarsest_; ++l) {
    const CouplingLevel& fine = level(l);
    CouplingLevel& coarse = level(l + 1);
    for (const int node : fine.wet) {
      const auto f = static_cast<std::size_t>(node);
      for (std::size_t c = 0; c < 8; ++c) {
        const double w = fine.up[f].weight[c];
        if (w <= 0) continue;
        const auto n = static_cast<std::size_t>(fine.up[f].node[c]);
        if (coarse.mass[n] == 0) coarse.wet.push_back(fine.up[f].node[c]);
        coarse.mass[n] += w * fine.mass[f];
        coarse.momentum[n] += w * fine.momentum[f];
        coarse.density[n] += w * fine.density[f];
        coarse.viscosity[n] += w * fine.viscosity[f];
      }
    }
  }
}

void CouplingGrid::gather_acceleration(const FluidNodes& nodes, const std::vector<Vec3>& acceleration) {
  CouplingLevel& finest = level(finest_);
  for (std::size_t i = 0; i < nodes.count(); ++i)
    for (std::size_t c = 0; c < 8; ++c)
      finest.acceleration[static_cast<std::size_t>(of_fluid_[i].node[c])] +=
          of_fluid_[i].weight[c] * nodes.mass[i] * acceleration[i];
  for (int l = finest_; l < coarsest_; ++l) {
    const CouplingLevel& fine = level(l);
    for (const int node : fine.wet) {
      const auto f = static_cast<std::size_t>(node);
      for (std::size_t c = 0; c < 8; ++c)
        level(l + 1).acceleration[static_cast<std::size_t>(fine.up[f].node[c])] +=
            fine.up[f].weight[c] * fine.acceleration[f];
    }
  }
}

void CouplingGrid::scatter(const FluidNodes& nodes, std::vector<Vec3>& impulse,
                           std::vector<double>& displaced) {
  // Coarse to fine, then to the fluid's nodes, each in proportion to mass.
  for (int l = coarsest_ - 1; l >= finest_; --l) {
    CouplingLevel& fine = level(l);
    const CouplingLevel& coarse = level(l + 1);
    for (const int node : fine.wet) {
      const auto f = static_cast<std::size_t>(node);
      for (std::size_t c = 0; c < 8; ++c) {
        const auto n = static_cast<std::size_t>(fine.up[f].node[c]);
        if (coarse.mass[n] <= 0) continue;
        const double share = fine.up[f].weight[c] * fine.mass[f] / coarse.mass[n];
        fine.impulse[f] += share * coarse.impulse[n];
        fine.displaced[f] += share * coarse.displaced[n];
      }
    }
  }
  impulse.assign(nodes.count(), Vec3::Zero());
  displaced.assign(nodes.count(), 0.0);
  const CouplingLevel& finest = level(finest_);
  parallel_for(nodes.count(), [&](std::size_t i) {
    for (std::size_t c = 0; c < 8; ++c) {
      const auto n = static_cast<std::size_t>(of_fluid_[i].node[c]);
      if (finest.mass[n] <= 0) continue;
      const double share = of_fluid_[i].weight[c] * nodes.mass[i] / finest.mass[n];
      impulse[i] += share * finest.impulse[n];
      displaced[i] += share * finest.displaced[n];
    }
  });
}

std::size_t CouplingGrid::memory_bytes() const {
  std::size_t bytes = of_fluid_.capacity() * sizeof(LevelWeights);
  for (const CouplingLevel& level : levels_)
    bytes += level.mass.capacity() * (6 * sizeof(double) + 4 * sizeof(Vec3)) +
             level.up.capacity() * sizeof(LevelWeights);
  return bytes;
}

}  // namespace sluice
