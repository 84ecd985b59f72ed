#include "mpm/wall_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <unordered_map>

namespace sluice {
namespace {

constexpr double image_reach = 4;  // cells beyond the domain that stencils near its faces can see

/// Triangles before they belong to a patch.
struct Soup {
  std::vector<std::array<Vec3, 3>> corners;  // grid units
  std::vector<int> wall;
  std::vector<std::array<int, 3>> welded;  // indices of welded vertices
};

struct EdgeUse {
  std::uint64_t key;
  int triangle;
  int edge;
  bool operator<(const EdgeUse& o) const {
    return key != o.key ? key < o.key : triangle != o.triangle ? triangle < o.triangle : edge < o.edge;
  }
};

/// Shifts that bring periodic images next to the domain, the zero shift first [grid units].
std::vector<Vec3> image_shifts(const Domain& domain, double h) {
  std::vector<Vec3> shifts{Vec3::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain.periodic(axis)) continue;
    const double length = (domain.box.hi[axis] - domain.box.lo[axis]) / h;
    const std::size_t before = shifts.size();
    for (double sign : {-1.0, 1.0}) {
      for (std::size_t i = 0; i < before; ++i) {
        shifts.push_back(shifts[i]);
        shifts.back()[axis] += sign * length;
      }
    }
  }
  return shifts;
}

/// Triangles of walls as grid corners, next to the domain.
class Collector {
 public:
  Collector(const Walls& walls, const WallPoses& poses, const Domain& domain, const Vec3& origin, double h)
      : walls_(walls), poses_(poses), origin_(origin), h_(h), shifts_(image_shifts(domain, h)) {
    reach_ = Box{(domain.box.lo - origin) / h, (domain.box.hi - origin) / h}.grown(image_reach);
  }

  /// Walls of the scene for which wanted(wall) is true.
  template <class Wanted>
  void add_scene(const Wanted& wanted, const std::optional<MarkedBases>& only) {
    const TriMesh& mesh = walls_.mesh();
    for (const Vec3& shift : shifts_)
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const int wall = walls_.wall_of(static_cast<int>(t));
        if (walls_.all()[static_cast<std::size_t>(wall)].blocks == BlocksPhase::rocks_only || !wanted(wall))
          continue;
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
          corner[k] =
              grid(poses_.to_space(wall, mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])])) +
              shift;
        add(corner, wall, only);
      }
  }

  std::vector<RoundBody> bodies() const {
    std::vector<RoundBody> all = poses_.round();
    for (RoundBody& body : all) {
      body.semi_axes /= h_;
      body.reach /= h_;
      body.pose.at = grid(body.pose.at);
    }
    return all;
  }

  Soup soup;
  std::vector<Box> boxes;  ///< of its triangles

 private:
  Vec3 grid(const Vec3& x) const { return (x - origin_) / h_; }
  void add(const std::array<Vec3, 3>& corner, int wall, const std::optional<MarkedBases>& only) {
    Box box;
    for (const Vec3& x : corner) box.include(x);
    if (!box.overlaps(reach_) || (only && !only->meets(box))) return;
    soup.corners.push_back(corner);
    soup.wall.push_back(wall);
    boxes.push_back(box);
  }

  const Walls& walls_;
  const WallPoses& poses_;
  Vec3 origin_;
  double h_;
  std::vector<Vec3> shifts_;
  Box reach_;
};

/// Gives corners closer than `tolerance` one index, whatever part or image they come from.
void weld(Soup& soup, double tolerance) {
  const double cell = 64 * tolerance;
  std::unordered_map<std::uint64_t, std::vector<std::pair<Vec3, int>>> cells;
  auto key_of = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    auto mix = [](std::uint64_t z) {
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      return z ^ (z >> 27);
    };
    return mix(mix(mix(static_cast<std::uint64_t>(i)) + static_cast<std::uint64_t>(j)) +
               static_cast<std::uint64_t>(k));
  };
  auto cell_of = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell)); };
  int count = 0;
  auto index_of = [&](const Vec3& x) {
    for (std::int64_t i = cell_of(x[0] - tolerance); i <= cell_of(x[0] + tolerance); ++i) {
      for (std::int64_t j = cell_of(x[1] - tolerance); j <= cell_of(x[1] + tolerance); ++j) {
        for (std::int64_t k = cell_of(x[2] - tolerance); k <= cell_of(x[2] + tolerance); ++k) {
          const auto found = cells.find(key_of(i, j, k));
          if (found == cells.end()) continue;
          for (const auto& [y, index] : found->second)
            if ((x - y).squaredNorm() <= tolerance * tolerance) return index;
        }
      }
    }
    cells[key_of(cell_of(x[0]), cell_of(x[1]), cell_of(x[2]))].emplace_back(x, count);
    return count++;
  };
  soup.welded.resize(soup.corners.size());
  for (std::size_t t = 0; t < soup.corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) soup.welded[t][k] = index_of(soup.corners[t][k]);
}

std::vector<EdgeUse> edges_of(const Soup& soup) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * soup.welded.size());
  for (std::size_t t = 0; t < soup.welded.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::uint64_t>(soup.welded[t][k]);
      const auto b = static_cast<std::uint64_t>(soup.welded[t][(k + 1) % 3]);
      if (a == b) continue;
      uses.push_back({std::min(a, b) << 32 | std::max(a, b), static_cast<int>(t), static_cast<int>(k)});
    }
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

double longest_edge(const std::array<Vec3, 3>& c) {
  return std::sqrt(
      std::max({(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()}));
}

/// Index range [begin, end) of the uses of each edge, one entry a use.
std::vector<std::pair<std::size_t, std::size_t>> groups_of(const std::vector<EdgeUse>& uses) {
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin;
    while (end < uses.size() && uses[end].key == uses[begin].key) ++end;
    groups.emplace_back(begin, end);
    begin = end;
  }
  return groups;
}

/// Grows patches from the largest triangles, whose normals noise disturbs least. Returns the patch of each
/// triangle; -1 for triangles without area.
std::vector<int> grow_patches(const Soup& soup, const std::vector<EdgeUse>& uses, WallPatches& out) {
  const std::size_t n = soup.corners.size();
  std::vector<Vec3> cross(n);
  std::vector<double> height(n);
  std::vector<int> order;
  for (std::size_t t = 0; t < n; ++t) {
    const auto& c = soup.corners[t];
    cross[t] = (c[1] - c[0]).cross(c[2] - c[0]);
    const double longest = longest_edge(c);
    height[t] = longest > 0 ? cross[t].norm() / longest : 0.0;
    if (height[t] > 1e-10 * longest && height[t] > 1e-9) order.push_back(static_cast<int>(t));
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return cross[static_cast<std::size_t>(a)].squaredNorm() >
           cross[static_cast<std::size_t>(b)].squaredNorm();
  });

  // Neighbours over edges, per triangle
  std::vector<std::array<std::pair<std::size_t, std::size_t>, 3>> beside(n);
  for (const auto& [begin, end] : groups_of(uses))
    for (std::size_t i = begin; i < end; ++i)
      beside[static_cast<std::size_t>(uses[i].triangle)][static_cast<std::size_t>(uses[i].edge)] = {begin,
                                                                                                    end};

  std::vector<int> patch_of(n, -1);
  std::vector<int> front;
  for (int seed : order) {
    const auto s = static_cast<std::size_t>(seed);
    if (patch_of[s] >= 0) continue;
    WallPatch patch;
    patch.normal = cross[s].normalized();
    patch.offset = patch.normal.dot(soup.corners[s][0]);
    patch.deviation = 1e-12;
    patch.wall = soup.wall[s];
    int dropped = 0;
    patch.normal.cwiseAbs().maxCoeff(&dropped);
    patch.u = (dropped + 1) % 3;
    patch.v = (dropped + 2) % 3;
    const int index = static_cast<int>(out.patches.size());
    patch_of[s] = index;
    front.assign(1, seed);
    while (!front.empty()) {
      const auto t = static_cast<std::size_t>(front.back());
      front.pop_back();
      for (const auto& [begin, end] : beside[t]) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto other = static_cast<std::size_t>(uses[i].triangle);
          if (patch_of[other] >= 0 || soup.wall[other] != patch.wall || height[other] <= 1e-9) continue;
          double off = 0;
          for (const Vec3& c : soup.corners[other])
            off = std::max(off, std::abs(patch.normal.dot(c) - patch.offset));
          const bool aligned = std::abs(cross[other].normalized().dot(patch.normal)) > 0.9;
          if (off > out.tolerance || (!aligned && height[other] > 10 * out.tolerance)) continue;
          patch.deviation = std::max(patch.deviation, off);
          patch_of[other] = index;
          front.push_back(static_cast<int>(other));
        }
      }
    }
    out.patches.push_back(patch);
  }
  return patch_of;
}

/// In-plane unit vector across edge k of a triangle, towards its third corner.
Vec3 inward(const std::array<Vec3, 3>& c, std::size_t k) {
  const Vec3 along = (c[(k + 1) % 3] - c[k]).normalized();
  const Vec3 to_third = c[(k + 2) % 3] - c[k];
  return (to_third - along * along.dot(to_third)).normalized();
}

/// Fills `boundary` and `smooth` from the triangles that share an edge.
void mark_edges(const Soup& soup, const std::vector<EdgeUse>& uses, std::vector<WallTriangle>& triangles) {
  for (const auto& [begin, end] : groups_of(uses)) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto t = static_cast<std::size_t>(uses[i].triangle);
      const auto bit = static_cast<std::uint8_t>(1u << uses[i].edge);
      if (triangles[t].patch < 0) continue;
      const Vec3 mine = inward(soup.corners[t], static_cast<std::size_t>(uses[i].edge));
      for (std::size_t j = begin; j < end; ++j) {
        const auto o = static_cast<std::size_t>(uses[j].triangle);
        if (o == t || triangles[o].patch < 0) continue;
        const double straight = -mine.dot(inward(soup.corners[o], static_cast<std::size_t>(uses[j].edge)));
        if (triangles[o].patch == triangles[t].patch) {
          if (straight > 0.5) triangles[t].boundary &= static_cast<std::uint8_t>(~bit);
        } else if (straight > smooth_cosine) {
          triangles[t].smooth |= bit;
        }
      }
    }
  }
}

/// Edge functions of a triangle in the two kept coordinates of its patch.
void set_edges(WallTriangle& triangle, const WallPatch& patch) {
  const int w = 3 - patch.u - patch.v;
  std::array<Vec3, 3> flat;
  for (std::size_t k = 0; k < 3; ++k)
    flat[k] = triangle.corner[k] - (patch.normal.dot(triangle.corner[k]) - patch.offset) * patch.normal;
  const double turn = patch.normal.dot((flat[1] - flat[0]).cross(flat[2] - flat[0])) < 0 ? -1.0 : 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = (flat[(k + 1) % 3] - flat[k]).normalized();
    const Vec3 m = turn * patch.normal.cross(along);
    const double slope = m[w] / patch.normal[w];
    triangle.edge[k] = {m[patch.u] - slope * patch.normal[patch.u],
                        m[patch.v] - slope * patch.normal[patch.v], slope * patch.offset - m.dot(flat[k])};
  }
}

}  // namespace

MarkedBases::MarkedBases(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  lo_ = Vec3i::Constant(1 << 28);
  hi_ = -lo_;
  for (const Box& box : boxes) {
    const auto [lo, hi] = blocks_near(box);
    lo_ = lo_.cwiseMin(lo);
    hi_ = hi_.cwiseMax(hi);
  }
  marks_.assign(static_cast<std::size_t>((hi_ - lo_ + Vec3i::Ones()).cast<long>().prod()), 0);
  for (const Box& box : boxes) {
    const auto [lo, hi] = blocks_near(box);
    for (int k = lo[2]; k <= hi[2]; ++k)
      for (int j = lo[1]; j <= hi[1]; ++j)
        for (int i = lo[0]; i <= hi[0]; ++i) marks_[slot({i, j, k})] = 1;
  }
}

std::array<Vec3i, 2> MarkedBases::blocks_near(const Box& box) {
  constexpr double slack = 0.01;  // more than boxes are grown by where triangles are put into stencils
  Vec3i lo, hi;
  for (int k = 0; k < 3; ++k) {
    lo[k] = static_cast<int>(std::floor(box.lo[k] - 3 - slack));
    hi[k] = static_cast<int>(std::ceil(box.hi[k] + 1 + slack));
  }
  return {block(lo), block(hi)};
}

bool MarkedBases::meets(const Box& box) const {
  auto [lo, hi] = blocks_near(box);
  lo = lo.cwiseMax(lo_);
  hi = hi.cwiseMin(hi_);
  for (int k = lo[2]; k <= hi[2]; ++k)
    for (int j = lo[1]; j <= hi[1]; ++j)
      for (int i = lo[0]; i <= hi[0]; ++i)
        if (marks_[slot({i, j, k})]) return true;
  return false;
}

WallPatches make_wall_patches(const Walls& walls, const WallPoses& poses, const Domain& domain,
                              const Vec3& origin, double h, WhichWalls which) {
  WallPatches out;
  Collector collector(walls, poses, domain, origin, h);
  const auto stands = [&](int wall) { return poses.body_of(wall) < 0; };
  if (which == WhichWalls::near_moving) {
    collector.add_scene([&](int wall) { return !stands(wall); }, std::nullopt);
    out.bodies = collector.bodies();
    std::vector<Box> moving = collector.boxes;
    for (const RoundBody& body : out.bodies) {
      moving.emplace_back();
      moving.back().include(body.pose.at);
      moving.back() = moving.back().grown(body.reach);
    }
    out.only.emplace(moving);
  }
  collector.add_scene([&](int wall) { return which == WhichWalls::all || stands(wall); }, out.only);
  Soup& soup = collector.soup;
  if (soup.corners.empty()) return out;
  Box bounds;
  for (const auto& c : soup.corners)
    for (const Vec3& x : c) bounds.include(x);
  // Eight roundings of a single-precision STL of that size; below the 1e-4 h at which points are kept off
  out.tolerance = std::clamp(5e-7 * bounds.size().maxCoeff(), 1e-6, 5e-5);
  weld(soup, out.tolerance);
  const std::vector<EdgeUse> uses = edges_of(soup);
  const std::vector<int> patch_of = grow_patches(soup, uses, out);

  std::vector<WallTriangle> triangles(soup.corners.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t].corner = soup.corners[t];
    triangles[t].patch = patch_of[t];
    if (patch_of[t] >= 0) set_edges(triangles[t], out.patches[static_cast<std::size_t>(patch_of[t])]);
  }
  mark_edges(soup, uses, triangles);
  std::erase_if(triangles, [](const WallTriangle& t) { return t.patch < 0; });
  std::stable_sort(triangles.begin(), triangles.end(),
                   [](const WallTriangle& a, const WallTriangle& b) { return a.patch < b.patch; });
  out.triangles = std::move(triangles);
  return out;
}

}  // namespace sluice
