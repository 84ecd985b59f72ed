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
  coarsest_ = count - 1;
  finest_ = level_for(narrowest);
  coarsest_ = level_for(widest);
  for (int l = finest_; l <= coarsest_; ++l) make(l);
  colour_slabs();
  for (int l = finest_; l < coarsest_; ++l)
    for (std::size_t n = 0; n < level(l).fluid.size(); ++n)
      level(l).up.push_back(weights(l + 1, place_of(l, static_cast<int>(n))));
  for (int l = finest_ + 1; l <= coarsest_; ++l) list_down(l);
  of_level_.resize(levels_.size());
}

void CouplingGrid::make(int l) {
  CouplingLevel& level = this->level(l);
  const auto n = static_cast<std::size_t>(level.nodes.cast<long>().prod());
  level.per_spacing = level.spacing.cwiseInverse();
  level.fluid.assign(n, {});
  level.rock.assign(n, {});
  level.acceleration.assign(n, {});
  level.packed.assign(n, 0.0);
  level.asked.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const int node = static_cast<int>(i);
    const int index[3] = {node % level.nodes.x(), (node / level.nodes.x()) % level.nodes.y(),
                          node / (level.nodes.x() * level.nodes.y())};
    double volume = level.cell_volume();
    for (int k = 0; k < 3; ++k)
      if (!domain_.periodic(k) && (index[k] == 0 || index[k] == level.nodes[k] - 1)) volume *= 0.5;
    level.fluid[i].lanes[fluid_lane::per_volume] = 1 / volume;
  }
}

int CouplingGrid::slabs_of(int l) const {
  const CouplingLevel& level = this->level(l);
  return domain_.periodic(level.slab_axis) ? level.nodes[level.slab_axis] : level.nodes[level.slab_axis] - 1;
}

// Even slabs, odd slabs, and the last of an odd number round a periodic axis, which touches both.
void CouplingGrid::colour_slabs() {
  colours_.resize(3);
  int next = 0;
  for (int l = finest_; l <= coarsest_; ++l) {
    CouplingLevel& level = this->level(l);
    level.nodes.maxCoeff(&level.slab_axis);
    level.first_slab = next;
    const int slabs = slabs_of(l);
    for (int s = 0; s < slabs; ++s) {
      const bool closes = domain_.periodic(level.slab_axis) && slabs % 2 == 1 && s == slabs - 1;
      colours_[closes ? 2 : static_cast<std::size_t>(s % 2)].push_back(next++);
    }
  }
  wet_.resize(static_cast<std::size_t>(next));
  rocky_.resize(static_cast<std::size_t>(next));
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

// Along each axis between the mean of the four nodes on one side and of those on the other; nothing where one
// side is dry.
Vec3 CouplingLevel::water_spin(const LevelWeights& place) const {
  Mat3 gradient = Mat3::Zero();  // column k: along axis k
  for (int k = 0; k < 3; ++k) {
    NodeLanes side[2]{};
    double weight[2]{};
    for (std::size_t c = 0; c < 8; ++c) {
      const std::size_t s = c >> k & 1;
      side[s] += place.weight[c] * rock_at(place.node[c]);
      weight[s] += place.weight[c];
    }
    if (!(weight[0] > 0 && weight[1] > 0)) continue;
    const NodeLanes rise = (side[1] / weight[1] - side[0] / weight[0]) * per_spacing[k];
    for (int i = 0; i < 3; ++i) gradient(i, k) = rise[rock_lane::velocity + i];
  }
  return 0.5 * Vec3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                    gradient(1, 0) - gradient(0, 1));
}

LevelPlace CouplingGrid::place(int l, const Vec3& x) const {
  const CouplingLevel& level = this->level(l);
  const std::array<int, 3> stride{1, level.nodes.x(), level.nodes.x() * level.nodes.y()};
  LevelPlace out;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double place = (x[k] - domain_.box.lo[k]) * level.per_spacing[k];
    const double floor = std::floor(place);
    const int n = level.nodes[k];
    int low = static_cast<int>(floor), high;
    if (domain_.periodic(k)) {
      while (low < 0) low += n;
      while (low >= n) low -= n;
      high = low + 1 == n ? 0 : low + 1;
      out.upper[axis] = place - floor;
    } else {
      low = std::clamp(low, 0, n - 2);
      high = low + 1;
      out.upper[axis] = std::clamp(place - low, 0.0, 1.0);
    }
    out.low += stride[axis] * low;
    out.next[axis] = stride[axis] * (high - low);
    if (k == level.slab_axis) out.slab = level.first_slab + low;
  }
  return out;
}

LevelWeights LevelPlace::weights() const {
  LevelWeights out;
  out.slab = slab;
  const double first[3] = {1 - upper[0], 1 - upper[1], 1 - upper[2]};
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < 2; ++j) {
      const int row = low + (j == 0 ? 0 : next[1]) + (k == 0 ? 0 : next[2]);
      const double of_row = (j == 0 ? first[1] : upper[1]) * (k == 0 ? first[2] : upper[2]);
      const std::size_t c = 4 * k + 2 * j;
      out.node[c] = row;
      out.node[c + 1] = row + next[0];
      out.weight[c] = first[0] * of_row;
      out.weight[c + 1] = upper[0] * of_row;
    }
  return out;
}

/// Turns `up` of the next finer level round.
void CouplingGrid::list_down(int l) {
  CouplingLevel& level = this->level(l);
  const std::vector<LevelWeights>& up = this->level(l - 1).up;
  const auto each = [&](const auto& body) {
    for (std::size_t n = 0; n < up.size(); ++n)
      for (std::size_t c = 0; c < 8; ++c)
        if (up[n].weight[c] > 0) body(static_cast<std::size_t>(up[n].node[c]), static_cast<int>(n));
  };
  level.down_begin.assign(level.fluid.size() + 1, 0);
  each([&](std::size_t to, int) { ++level.down_begin[to + 1]; });
  for (std::size_t n = 0; n < level.fluid.size(); ++n) level.down_begin[n + 1] += level.down_begin[n];
  level.down.resize(static_cast<std::size_t>(level.down_begin.back()));
  std::vector<int> next(level.down_begin.begin(), level.down_begin.end() - 1);
  each([&](std::size_t to, int from) { level.down[static_cast<std::size_t>(next[to]++)] = from; });
}

void CouplingGrid::clear_solids() {
  for (int l = finest_; l <= coarsest_; ++l) {
    CouplingLevel& level = this->level(l);
    parallel_for(
        static_cast<std::size_t>(slabs_of(l)),
        [&](std::size_t s) {
          std::vector<int>& nodes = rocky_[static_cast<std::size_t>(level.first_slab) + s];
          for (const int n : nodes) level.fluid_at(n)[fluid_lane::solids] = 0;
          nodes.clear();
        },
        1);
  }
}

void CouplingGrid::add_solids(int l, const LevelWeights& place, double volume) {
  CouplingLevel& level = this->level(l);
  for (std::size_t c = 0; c < 8; ++c) {
    if (place.weight[c] <= 0) continue;
    double solids = level.fluid_at(place.node[c])[fluid_lane::solids];
    if (solids == 0) rocky_[static_cast<std::size_t>(place.slab)].push_back(place.node[c]);
    solids += place.weight[c] * volume;
    level.fluid_at(place.node[c])[fluid_lane::solids] = solids;
  }
}

void CouplingGrid::clear_fluid() {
  for (int l = finest_; l <= coarsest_; ++l) {
    CouplingLevel& level = this->level(l);
    parallel_for(
        static_cast<std::size_t>(slabs_of(l)),
        [&](std::size_t s) {
          std::vector<int>& nodes = wet_[static_cast<std::size_t>(level.first_slab) + s];
          for (const int n : nodes) {
            NodeLanes& sums = level.fluid_at(n);
            NodeLanes kept{};
            kept[fluid_lane::solids] = sums[fluid_lane::solids];
            kept[fluid_lane::per_volume] = sums[fluid_lane::per_volume];
            sums = kept;
            level.rock_at(n) = NodeLanes{};
            level.acceleration[static_cast<std::size_t>(n)] = {};
          }
          nodes.clear();
        },
        1);
  }
}

void CouplingGrid::list_wet(int l) {
  CouplingLevel& level = this->level(l);
  level.wet.clear();
  for (int s = 0; s < slabs_of(l); ++s) {
    const std::vector<int>& nodes = wet_[static_cast<std::size_t>(level.first_slab + s)];
    level.wet.insert(level.wet.end(), nodes.begin(), nodes.end());
  }
}

/// Nodes that rocks were added to, and those of finer levels through which fluid comes to them.
void CouplingGrid::find_asked() {
  const auto ask = [&](CouplingLevel& level, int node) {
    std::uint8_t& asked = level.asked[static_cast<std::size_t>(node)];
    if (!asked) level.all_asked.push_back(node);
    asked = 1;
  };
  for (int l = coarsest_; l >= finest_; --l) {
    CouplingLevel& level = this->level(l);
    for (const int n : level.all_asked) level.asked[static_cast<std::size_t>(n)] = 0;
    level.all_asked.clear();
    for (int s = 0; s < slabs_of(l); ++s)
      for (const int n : rocky_[static_cast<std::size_t>(level.first_slab + s)]) ask(level, n);
    if (l == coarsest_) continue;
    const CouplingLevel& coarser = this->level(l + 1);
    for (const int n : coarser.all_asked)
      for (int d = coarser.down_begin[static_cast<std::size_t>(n)];
           d < coarser.down_begin[static_cast<std::size_t>(n) + 1]; ++d)
        ask(level, coarser.down[static_cast<std::size_t>(d)]);
  }
}

void CouplingGrid::place_fluid(const FluidNodes& nodes) {
  find_asked();
  const CouplingLevel& finest = level(finest_);
  place_of_fluid_.resize(nodes.count());
  parallel_for(nodes.count(), [&](std::size_t i) {
    LevelPlace& place = place_of_fluid_[i];
    place.slab = -1;
    if (!(nodes.mass[i] > 0)) return;
    place = this->place(finest_, nodes.x[i]);
    const LevelWeights at = place.weights();
    bool asked = false;
    for (std::size_t c = 0; c < 8; ++c)
      asked = asked || (at.weight[c] > 0 && finest.asked[static_cast<std::size_t>(at.node[c])]);
    if (!asked) place.slab = -1;
  });
  of_fluid_.sort(nodes.count(), slab_count(), [&](std::size_t i) { return place_of_fluid_[i].slab; });
}

void CouplingGrid::gather(const FluidNodes& nodes) {
  clear_fluid();
  const auto add = [&](CouplingLevel& level, std::size_t slab, const LevelWeights& place, NodeLanes sums) {
    for (std::size_t c = 0; c < 8; ++c) {
      if (place.weight[c] <= 0) continue;
      NodeLanes& to = level.fluid_at(place.node[c]);
      if (to[fluid_lane::mass] == 0) wet_[slab].push_back(place.node[c]);
      to += place.weight[c] * sums;
    }
  };

  CouplingLevel& finest = level(finest_);
  place_fluid(nodes);
  each_slab(of_fluid_, [&](std::size_t slab, std::span<const std::uint32_t> items) {
    for (const std::uint32_t i : items) {
      const Vec3& v = nodes.v[i];
      const NodeLanes of_one{1, v.x(), v.y(), v.z(), nodes.density[i], nodes.viscosity[i], 0, 0};
      add(finest, slab, place_of_fluid_[i].weights(), nodes.mass[i] * of_one);
    }
  });
  list_wet(finest_);

  for (int l = finest_; l < coarsest_; ++l) {
    const CouplingLevel& fine = level(l);
    SlabOrder& order = of_level_[static_cast<std::size_t>(l)];
    order.sort(fine.wet.size(), slab_count(),
               [&](std::size_t i) { return fine.up[static_cast<std::size_t>(fine.wet[i])].slab; });
    each_slab(order, [&](std::size_t slab, std::span<const std::uint32_t> items) {
      for (const std::uint32_t i : items) {
        NodeLanes sums = fine.fluid_at(fine.wet[i]);
        sums[fluid_lane::solids] = sums[fluid_lane::per_volume] = 0;
        add(level(l + 1), slab, fine.up[static_cast<std::size_t>(fine.wet[i])], sums);
      }
    });
    list_wet(l + 1);
  }
}

void CouplingGrid::solids_fraction(const FluidNodes& nodes, std::vector<double>& fraction) {
  const auto from = [](const CouplingLevel& level, const LevelWeights& place) {
    double sum = 0;
    for (std::size_t c = 0; c < 8; ++c)
      sum += place.weight[c] * level.packed[static_cast<std::size_t>(place.node[c])];
    return sum;
  };
  for (int l = coarsest_; l >= finest_; --l) {
    CouplingLevel& level = this->level(l);
    parallel_for(level.wet.size(), [&](std::size_t i) {
      const auto node = static_cast<std::size_t>(level.wet[i]);
      const NodeLanes& sums = level.fluid_at(level.wet[i]);
      level.packed[node] = sums[fluid_lane::solids] * sums[fluid_lane::per_volume];
      if (l < coarsest_) level.packed[node] += from(this->level(l + 1), level.up[node]);
    });
  }
  fraction.resize(nodes.count());
  const CouplingLevel& finest = level(finest_);
  parallel_for(nodes.count(), [&](std::size_t i) {
    const LevelPlace& place = place_of_fluid_[i];
    fraction[i] = place.slab < 0 ? 0.0 : from(finest, place.weights());
  });
}

void CouplingGrid::gather_acceleration(const FluidNodes& nodes, const std::vector<Vec3>& acceleration) {
  const auto add = [&](CouplingLevel& level, const LevelWeights& place, auto sums) {
    for (std::size_t c = 0; c < 8; ++c)
      if (place.weight[c] > 0)
        level.acceleration[static_cast<std::size_t>(place.node[c])].lanes += place.weight[c] * sums;
  };
  using Lanes = decltype(CouplingLevel::Acceleration::lanes);
  each_slab(of_fluid_, [&](std::size_t, std::span<const std::uint32_t> items) {
    for (const std::uint32_t i : items) {
      const Vec3 sum = nodes.mass[i] * acceleration[i];
      add(level(finest_), place_of_fluid_[i].weights(), Lanes{sum.x(), sum.y(), sum.z(), 0});
    }
  });
  for (int l = finest_; l < coarsest_; ++l) {
    const CouplingLevel& fine = level(l);
    each_slab(of_level_[static_cast<std::size_t>(l)], [&](std::size_t, std::span<const std::uint32_t> items) {
      for (const std::uint32_t i : items) {
        const auto node = static_cast<std::size_t>(fine.wet[i]);
        add(level(l + 1), fine.up[node], fine.acceleration[node].lanes);
      }
    });
  }
  for (int l = finest_; l <= coarsest_; ++l) {
    CouplingLevel& level = this->level(l);
    parallel_for(level.wet.size(), [&](std::size_t i) {
      const int node = level.wet[i];
      level.acceleration[static_cast<std::size_t>(node)].lanes /= level.fluid_at(node)[fluid_lane::mass];
    });
  }
}

void CouplingGrid::scatter(const FluidNodes& nodes, FromRocks& out) {
  // Coarse to fine, then to the fluid's nodes, each in proportion to mass.
  const auto from = [](const CouplingLevel& level, const LevelWeights& place) {
    NodeLanes per_mass{};
    for (std::size_t c = 0; c < 8; ++c) per_mass += place.weight[c] * level.rock_at(place.node[c]);
    return per_mass;
  };
  for (int l = coarsest_; l >= finest_; --l) {
    CouplingLevel& level = this->level(l);
    parallel_for(level.wet.size(), [&](std::size_t i) {
      const int node = level.wet[i];
      const NodeLanes& fluid = level.fluid_at(node);
      NodeLanes& per_mass = level.rock_at(node);
      const NodeLanes solved = per_mass;
      per_mass /= fluid[fluid_lane::mass];
      for (int k = 0; k < 3; ++k)  // what drag changed: u' - u
        per_mass[rock_lane::velocity + k] =
            solved[rock_lane::velocity + k] - fluid[fluid_lane::momentum + k] / fluid[fluid_lane::mass];
      if (l < coarsest_) per_mass += from(this->level(l + 1), level.up[static_cast<std::size_t>(node)]);
    });
  }
  out.impulse.resize(nodes.count());
  out.change_by_drag.resize(nodes.count());
  out.displaced.resize(nodes.count());
  const CouplingLevel& finest = level(finest_);
  parallel_for(nodes.count(), [&](std::size_t i) {
    const LevelPlace& place = place_of_fluid_[i];
    out.impulse[i] = out.change_by_drag[i] = Vec3::Zero();
    out.displaced[i] = 0;
    if (place.slab < 0) return;
    const NodeLanes per_mass = from(finest, place.weights());
    constexpr int p = rock_lane::impulse, v = rock_lane::velocity;
    out.impulse[i] = nodes.mass[i] * Vec3(per_mass[p], per_mass[p + 1], per_mass[p + 2]);
    out.change_by_drag[i] = {per_mass[v], per_mass[v + 1], per_mass[v + 2]};
    out.displaced[i] = nodes.mass[i] * per_mass[rock_lane::displaced];
  });
}

std::size_t CouplingGrid::memory_bytes() const {
  std::size_t bytes = of_fluid_.memory_bytes() + place_of_fluid_.capacity() * sizeof(LevelPlace);
  for (const SlabOrder& order : of_level_) bytes += order.memory_bytes();
  for (const CouplingLevel& level : levels_)
    bytes += level.fluid.capacity() *
                 (2 * sizeof(CouplingLevel::Sums) + sizeof(CouplingLevel::Acceleration) + sizeof(double)) +
             level.up.capacity() * sizeof(LevelWeights) + level.asked.capacity() +
             (level.wet.capacity() + level.down.capacity() + level.down_begin.capacity() +
              level.all_asked.capacity()) *
                 sizeof(int);
  for (const std::vector<std::vector<int>>* lists : {&wet_, &rocky_})
    for (const std::vector<int>& list : *lists) bytes += list.capacity() * sizeof(int);
  return bytes;
}

}  // namespace sluice
