#include "mpm/wall_stencils.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace sluice {
namespace {

constexpr double box_slack = 2e-3;  // boxes are grown by more than the node offset

/// Triangle against a cube, by separating axes (Akenine-Moeller 2001). Touching counts.
bool meets_cube(const WallTriangle& t, const Vec3& centre, double half) {
  const std::array<Vec3, 3> v{t.corner[0] - centre, t.corner[1] - centre, t.corner[2] - centre};
  for (int k = 0; k < 3; ++k) {
    if (std::min({v[0][k], v[1][k], v[2][k]}) > half || std::max({v[0][k], v[1][k], v[2][k]}) < -half)
      return false;
  }
  auto apart = [&](const Vec3& axis) {
    const double p0 = axis.dot(v[0]), p1 = axis.dot(v[1]), p2 = axis.dot(v[2]);
    const double r = half * axis.cwiseAbs().sum();
    return std::min({p0, p1, p2}) > r || std::max({p0, p1, p2}) < -r;
  };
  const std::array<Vec3, 3> side{v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  if (apart(side[0].cross(side[1]))) return false;
  for (const Vec3& e : side)
    if (apart({0, -e[2], e[1]}) || apart({e[2], 0, -e[0]}) || apart({-e[1], e[0], 0})) return false;
  return true;
}

/// Segment against a cube, by slabs. Touching counts.
bool segment_meets_cube(const Vec3& a, const Vec3& b, const Vec3& centre, double half) {
  double from = 0, to = 1;
  for (int k = 0; k < 3; ++k) {
    const double start = a[k] - centre[k], step = b[k] - a[k];
    if (std::abs(step) < 1e-12) {
      if (std::abs(start) > half) return false;
      continue;
    }
    const double t0 = (-half - start) / step, t1 = (half - start) / step;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return from <= to + 1e-9;
}

/// A convex polygon of up to 9 corners: each side of a cube adds one at most to a triangle's three.
struct Polygon {
  std::array<Vec3, 9> corner;
  std::size_t count = 0;
  void add(const Vec3& x) {
    if (count < corner.size()) corner[count++] = x;
  }
  const Vec3* begin() const { return corner.data(); }
  const Vec3* end() const { return corner.data() + count; }
};

/// Corners of the part of a triangle inside a cube (Sutherland-Hodgman).
Polygon clipped(const WallTriangle& t, const Vec3& centre, double half) {
  Polygon polygon, next;
  for (const Vec3& corner : t.corner) polygon.add(corner);
  for (int side = 0; side < 6 && polygon.count > 0; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 ? -1 : 1;
    auto outside = [&](const Vec3& x) { return sign * (x[axis] - centre[axis]) - half; };
    next.count = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const Vec3 &a = polygon.corner[i], &b = polygon.corner[i + 1 == polygon.count ? 0 : i + 1];
      const double out_a = outside(a), out_b = outside(b);
      if (out_a <= 0) next.add(a);
      if ((out_a < 0 && out_b > 0) || (out_a > 0 && out_b < 0))
        next.add(a + out_a / (out_a - out_b) * (b - a));
    }
    polygon = next;
  }
  return polygon;
}

/// Bounds a patch's section with a cube by half planes, appended to `edges`, if it is convex.
///
/// It is when each boundary edge that meets the cube has all of the section on its inner side: no boundary
/// then enters the intersection of the half planes, which is connected, so that it is all patch.
PatchSection section_of(const WallPatches& walls, std::span<const std::int32_t> triangles, const Vec3& centre,
                        double half, std::vector<Vec3>& edges) {
  PatchSection section{static_cast<std::int32_t>(triangles.size()), static_cast<std::int32_t>(edges.size()),
                       0};
  if (triangles.empty()) return {};
  for (std::int32_t index : triangles) {
    const WallTriangle& t = walls.triangles[static_cast<std::size_t>(index)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(t.boundary >> k & 1) || !segment_meets_cube(t.corner[k], t.corner[(k + 1) % 3], centre, half))
        continue;
      const bool known = std::any_of(edges.begin() + section.edges, edges.end(), [&](const Vec3& e) {
        return (e - t.edge[k]).cwiseAbs().maxCoeff() < 1e-9;  // the same straight edge, in pieces
      });
      if (!known) edges.push_back(t.edge[k]);
    }
  }
  section.edge_count = static_cast<std::int32_t>(edges.size()) - section.edges;
  if (section.edge_count == 0) return section;

  const WallPatch& patch =
      walls.patches[static_cast<std::size_t>(walls.triangles[static_cast<std::size_t>(triangles[0])].patch)];
  for (std::int32_t index : triangles) {
    for (const Vec3& x : clipped(walls.triangles[static_cast<std::size_t>(index)], centre, half)) {
      for (auto e = edges.begin() + section.edges; e != edges.end(); ++e) {
        if ((*e)[0] * x[patch.u] + (*e)[1] * x[patch.v] + (*e)[2] >= -walls.tolerance) continue;
        edges.resize(static_cast<std::size_t>(section.edges));
        section.edge_count = -1;
        return section;
      }
    }
  }
  return section;
}

/// Calls visit(base) for each base from lo to hi, among those marked, whose near box meets the triangle.
template <class Visit>
void near_bases(const WallTriangle& t, const WallPatch& patch, const Vec3i& lo, const Vec3i& hi,
                const std::optional<MarkedBases>& only, const Visit& visit) {
  constexpr double half = 2 + box_slack;
  Vec3i from, to;
  for (int k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax({t.corner[0][k], t.corner[1][k], t.corner[2][k]});
    from[k] = static_cast<int>(std::max<double>(lo[k], std::ceil(least - half - 1)));
    to[k] = static_cast<int>(std::min<double>(hi[k], std::floor(most + half - 1)));
    if (from[k] > to[k]) return;
  }
  // Columns along the axis nearest to the normal; the plane limits each column
  const int u = patch.u, v = patch.v, w = 3 - u - v;
  const Vec3& n = patch.normal;
  const double spread = (std::abs(n[u]) + std::abs(n[v]) + std::abs(n[w])) * half / std::abs(n[w]);
  Vec3i base;
  for (base[u] = from[u]; base[u] <= to[u]; ++base[u]) {
    for (base[v] = from[v]; base[v] <= to[v]; ++base[v]) {
      const double middle = (patch.offset - n[u] * (base[u] + 1) - n[v] * (base[v] + 1)) / n[w] - 1;
      const int first = std::max(from[w], static_cast<int>(std::floor(middle - spread)));
      const int last = std::min(to[w], static_cast<int>(std::ceil(middle + spread)));
      for (base[w] = first; base[w] <= last; ++base[w])
        if ((!only || only->at(base)) && meets_cube(t, (base.cast<double>().array() + 1).matrix(), half))
          visit(base);
    }
  }
}

/// Calls visit(base) for each base from lo to hi with a point that a body can be within sight of.
template <class Visit>
void bases_beside(const RoundBody& body, const Vec3i& lo, const Vec3i& hi, const Visit& visit) {
  // Of the middle of the point's cell: by the reach of planes and the cell's half diagonal.
  constexpr double outside = 2.6, inside = 2;
  Vec3i from, to, base;
  for (int k = 0; k < 3; ++k) {
    from[k] = std::max(lo[k], static_cast<int>(std::floor(body.pose.at[k] - body.reach - outside)) - 1);
    to[k] = std::min(hi[k], static_cast<int>(std::ceil(body.pose.at[k] + body.reach + outside)) - 1);
  }
  for (base[2] = from[2]; base[2] <= to[2]; ++base[2])
    for (base[1] = from[1]; base[1] <= to[1]; ++base[1])
      for (base[0] = from[0]; base[0] <= to[0]; ++base[0]) {
        const Vec3 middle = (base.cast<double>().array() + 1).matrix();
        if ((middle - body.pose.at).norm() > body.reach + outside) continue;
        const double distance = body.about(middle);
        if (distance < outside && distance > -inside) visit(base);
      }
}

}  // namespace

WallStencils::WallStencils(const WallPatches& walls, const Vec3i& lo, const Vec3i& hi) : lo_(lo) {
  if ((walls.triangles.empty() && walls.bodies.empty()) || (lo.array() > hi.array()).any()) return;
  for (int k = 0; k < 3; ++k)
    blocks_[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>((hi[k] - lo[k]) / 4 + 1);
  block_.assign(static_cast<std::size_t>(blocks_[0]) * blocks_[1] * blocks_[2], -1);

  // Pairs of record and triangle, triangles ascending
  std::vector<std::int32_t> record_of_pair, triangle_of_pair;
  for (std::size_t t = 0; t < walls.triangles.size(); ++t) {
    const WallTriangle& triangle = walls.triangles[t];
    near_bases(triangle, walls.patches[static_cast<std::size_t>(triangle.patch)], lo, hi, walls.only,
               [&](const Vec3i& base) {
                 record_of_pair.push_back(find_or_add(base));
                 triangle_of_pair.push_back(static_cast<std::int32_t>(t));
               });
  }
  std::vector<std::int32_t> record_of_body, body_of_pair;
  for (std::size_t b = 0; b < walls.bodies.size(); ++b)
    bases_beside(walls.bodies[b], lo, hi, [&](const Vec3i& base) {
      record_of_body.push_back(find_or_add(base));
      body_of_pair.push_back(static_cast<std::int32_t>(b));
    });
  order_records(record_of_pair, record_of_body);

  // Bodies by record
  for (const std::int32_t r : record_of_body) ++records[static_cast<std::size_t>(r)].body_count;
  std::int32_t first_body = 0;
  for (StencilRecord& r : records) {
    r.bodies = first_body;
    first_body += r.body_count;
    r.body_count = 0;
  }
  bodies.resize(body_of_pair.size());
  for (std::size_t i = 0; i < body_of_pair.size(); ++i) {
    StencilRecord& r = records[static_cast<std::size_t>(record_of_body[i])];
    bodies[static_cast<std::size_t>(r.bodies + r.body_count++)] = body_of_pair[i];
  }

  // Triangles by record
  std::vector<std::int32_t> start(records.size() + 1, 0);
  for (std::int32_t r : record_of_pair) ++start[static_cast<std::size_t>(r) + 1];
  for (std::size_t r = 0; r < records.size(); ++r) start[r + 1] += start[r];
  triangles.resize(triangle_of_pair.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < record_of_pair.size(); ++i)
    triangles[static_cast<std::size_t>(next[static_cast<std::size_t>(record_of_pair[i])]++)] =
        triangle_of_pair[i];

  // Patches by record
  for (std::size_t r = 0; r < records.size(); ++r) {
    records[r].patches = static_cast<std::int32_t>(patches.size());
    int last = -1;
    for (std::int32_t i = start[r]; i < start[r + 1]; ++i) {
      const int patch =
          walls.triangles[static_cast<std::size_t>(triangles[static_cast<std::size_t>(i)])].patch;
      if (patch != last) {
        patches.push_back({.patch = patch, .triangles = i});
        ++records[r].near;
        last = patch;
      }
      ++patches.back().near.triangles;
    }
  }
  classify_all(walls);
}

int WallStencils::find_or_add(const Vec3i& base) {
  const Vec3i d = base - lo_;
  const std::size_t b =
      (static_cast<std::size_t>(d[0] >> 2) * blocks_[1] + static_cast<std::size_t>(d[1] >> 2)) * blocks_[2] +
      static_cast<std::size_t>(d[2] >> 2);
  if (block_[b] < 0) {
    block_[b] = static_cast<std::int32_t>(cell_.size());
    cell_.resize(cell_.size() + 64, -1);
  }
  std::int32_t& cell =
      cell_[static_cast<std::size_t>(block_[b] + ((d[0] & 3) << 4 | (d[1] & 3) << 2 | (d[2] & 3)))];
  if (cell < 0) {
    cell = static_cast<std::int32_t>(records.size());
    records.push_back({.base = base});
  }
  return cell;
}

/// Puts records in the order of blocks, so that neighbours in space are neighbours in memory.
void WallStencils::order_records(std::vector<std::int32_t>& record_of_pair,
                                 std::vector<std::int32_t>& record_of_body) {
  std::vector<StencilRecord> ordered;
  ordered.reserve(records.size());
  std::vector<std::int32_t> now(records.size());
  for (std::int32_t block : block_) {
    if (block < 0) continue;
    for (std::size_t c = static_cast<std::size_t>(block); c < static_cast<std::size_t>(block) + 64; ++c) {
      if (cell_[c] < 0) continue;
      const auto old = static_cast<std::size_t>(cell_[c]);
      now[old] = cell_[c] = static_cast<std::int32_t>(ordered.size());
      ordered.push_back(records[old]);
    }
  }
  records = std::move(ordered);
  for (std::vector<std::int32_t>* of : {&record_of_pair, &record_of_body})
    for (std::int32_t& r : *of) r = now[static_cast<std::size_t>(r)];
}

void WallStencils::classify_all(const WallPatches& walls) {
  constexpr std::size_t chunk = 256;
  std::vector<std::vector<Vec3>> found((records.size() + chunk - 1) / chunk);
  parallel_chunks(records.size(), chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) classify(walls, records[r], found[c]);
  });
  for (std::size_t c = 0; c < found.size(); ++c) {
    const auto before = static_cast<std::int32_t>(edges.size());
    edges.insert(edges.end(), found[c].begin(), found[c].end());
    for (std::size_t r = c * chunk; r < std::min(records.size(), (c + 1) * chunk); ++r) {
      for (std::int32_t i = records[r].patches; i < records[r].patches + records[r].near; ++i) {
        patches[static_cast<std::size_t>(i)].near.edges += before;
        patches[static_cast<std::size_t>(i)].cut.edges += before;
      }
    }
  }
  records.shrink_to_fit();  // they stay as they are
  patches.shrink_to_fit();
  triangles.shrink_to_fit();
  edges.shrink_to_fit();
  cell_.shrink_to_fit();
}

void WallStencils::classify(const WallPatches& walls, StencilRecord& r, std::vector<Vec3>& found_edges) {
  const Vec3 centre = (r.base.cast<double>().array() + 1).matrix();
  constexpr double near_half = 2 + box_slack, cut_half = 1 + box_slack;
  const auto first = patches.begin() + r.patches, last = first + r.near;
  for (auto p = first; p != last; ++p) {
    const WallPatch& plane = walls.patches[static_cast<std::size_t>(p->patch)];
    for (int node = 0; node < 27; ++node) {
      const Vec3 x = (r.base + Vec3i(node % 3, node / 3 % 3, node / 9)).cast<double>() + node_offset;
      if (plane.normal.dot(x) - plane.offset >= 0) p->above |= 1u << node;
    }
    const std::span<std::int32_t> all(triangles.data() + p->triangles,
                                      static_cast<std::size_t>(p->near.triangles));
    p->goes_on = std::any_of(all.begin(), all.end(), [&](std::int32_t t) {
      const WallTriangle& triangle = walls.triangles[static_cast<std::size_t>(t)];
      return (triangle.boundary & triangle.smooth) != 0;
    });
    const auto split = std::stable_partition(all.begin(), all.end(), [&](std::int32_t t) {
      return meets_cube(walls.triangles[static_cast<std::size_t>(t)], centre, cut_half);
    });
    const std::span<const std::int32_t> cutting(all.begin(), split);
    p->near = section_of(walls, all, centre, near_half, found_edges);
    p->cut = section_of(walls, cutting, centre, cut_half, found_edges);
    p->cuts = !cutting.empty() && p->above != 0 && p->above != all_nodes;
  }
  std::stable_sort(first, last, [](const StencilPatch& a, const StencilPatch& b) {
    return 2 * a.cuts + a.cut.covered() > 2 * b.cuts + b.cut.covered();
  });
  r.cutting = static_cast<std::int32_t>(
      std::count_if(first, last, [](const StencilPatch& p) { return p.cuts != 0; }));
}

std::size_t WallStencils::memory_bytes() const {
  return records.capacity() * sizeof(StencilRecord) + patches.capacity() * sizeof(StencilPatch) +
         edges.capacity() * sizeof(Vec3) +
         (bodies.capacity() + triangles.capacity() + block_.capacity() + cell_.capacity()) *
             sizeof(std::int32_t);
}

}  // namespace sluice
