#include "mpm/wall_field.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "mpm/wall_nodes.h"
#include "mpm/wall_patches.h"
#include "mpm/wall_sight.h"
#include "mpm/wall_stencils.h"

namespace sluice {
namespace {

constexpr int halo = 3;              // stencils beyond the domain's faces
constexpr int most_node_planes = 8;  // no more directions differ by 41 degrees within sight of a node

/// Bases to record: near the domain, and near walls.
std::array<Vec3i, 2> recorded_bases(const WallPatches& walls, const Domain& domain, const Vec3& origin,
                                    double h, const std::array<Vec3i, 2>& nodes) {
  Box box{(domain.box.lo - origin) / h, (domain.box.hi - origin) / h};
  Box near_walls;
  for (const WallTriangle& t : walls.triangles)
    for (const Vec3& c : t.corner) near_walls.include(c);
  Vec3i lo = Vec3i::Zero(), hi = Vec3i::Constant(-1);
  if ((near_walls.empty() && walls.bodies.empty()) || box.empty()) return {lo, hi};
  near_walls = near_walls.grown(4);
  for (const RoundBody& body : walls.bodies) {
    Box beside;
    beside.include(body.pose.at);
    beside = beside.grown(body.reach + 4);
    near_walls.include(beside.lo);
    near_walls.include(beside.hi);
  }
  for (int k = 0; k < 3; ++k) {
    lo[k] = static_cast<int>(std::floor(std::max(box.lo[k] - halo - 1, near_walls.lo[k])));
    hi[k] = static_cast<int>(std::ceil(std::min(box.hi[k] + halo, near_walls.hi[k])));
    if (walls.only) {
      lo[k] = std::max(lo[k], walls.only->lowest()[k]);
      hi[k] = std::min(hi[k], walls.only->highest()[k]);
    }
    lo[k] = std::max(lo[k], nodes[0][k] - 2);  // of a point beside the lowest node
    hi[k] = std::min(hi[k], nodes[1][k] + 1);
  }
  return {lo, hi};
}

Vec3i base_of(const Vec3& u) {
  return {static_cast<int>(std::floor(u[0] - 0.5)), static_cast<int>(std::floor(u[1] - 0.5)),
          static_cast<int>(std::floor(u[2] - 0.5))};
}

constexpr auto node_places = [] {
  std::array<std::array<double, Targets::count>, 3> x{};
  for (int n = 0; n < 27; ++n) {
    x[0][static_cast<std::size_t>(n)] = n % 3;
    x[1][static_cast<std::size_t>(n)] = n / 3 % 3;
    x[2][static_cast<std::size_t>(n)] = n / 9;
  }
  return x;
}();

}  // namespace

struct WallField::Implementation {
  static constexpr double not_known = -1;
  struct NodeRecord {
    std::int32_t planes = 0;  ///< first of its planes
    std::int32_t count = 0;
    double open = not_known;
  };

  Implementation(const Walls& walls, const WallPoses& all_poses, const Domain& domain,
                 const Vec3& grid_origin, double spacing, WhichWalls which, const std::array<Vec3i, 2>& nodes)
      : poses(all_poses),
        origin(grid_origin),
        h(spacing),
        per_h(1 / spacing),
        patches(make_wall_patches(walls, all_poses, domain, grid_origin, spacing, which)),
        bases(recorded_bases(patches, domain, grid_origin, spacing, nodes)),
        stencils(patches, bases[0], bases[1]) {
    set_up_nodes();
  }

  void set_up_nodes();
  /// Found when it is first asked for: most nodes near walls never see water.
  double open_fraction(std::size_t record) {
    double& open = nodes[record].open;
    if (open == not_known) open = open_fraction_of(sight, stencils.records[record]);
    return open;
  }
  /// First crossing among the patches of a record; a and b lie in its near box.
  std::optional<WallHit> first_crossing(const StencilRecord& record, const Vec3& a, const Vec3& b,
                                        int body) const;

  const WallPoses& poses;
  std::unique_ptr<const WallPoses> at_rest;  ///< where nobody else has them
  Vec3 origin;
  double h, per_h;
  WallPatches patches;
  std::array<Vec3i, 2> bases;
  WallStencils stencils;
  Sight sight{patches, stencils};
  std::vector<NodeRecord> nodes;  ///< of the node base + 1 of each stencil record
  std::vector<WallPlane> planes;
};

void WallField::Implementation::set_up_nodes() {
  constexpr std::size_t chunk = 256;
  const std::size_t count = stencils.records.size();
  nodes.resize(count);
  std::vector<std::vector<WallPlane>> found((count + chunk - 1) / chunk);
  parallel_chunks(count, chunk, [&](std::size_t c, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const StencilRecord& record = stencils.records[r];
      const Vec3 node = (record.base.cast<double>().array() + 1).matrix();
      std::array<WallPlane, most_node_planes> active;
      nodes[r].count =
          active_planes(sight, record, node, node + node_offset, active.data(), most_node_planes);
      for (int i = 0; i < nodes[r].count; ++i) {
        found[c].push_back(active[static_cast<std::size_t>(i)]);
        found[c].back().distance *= h;
      }
    }
  });
  for (const auto& part : found) planes.insert(planes.end(), part.begin(), part.end());
  planes.shrink_to_fit();
  std::int32_t first = 0;
  for (NodeRecord& n : nodes) {
    n.planes = first;
    first += n.count;
  }
}

std::optional<WallHit> WallField::Implementation::first_crossing(const StencilRecord& record, const Vec3& a,
                                                                 const Vec3& b, int body) const {
  double first = 2;
  int patch = -1;
  for (const StencilPatch& p : stencils.patches_of(record)) {
    if (body != any_body && poses.body_of(sight.plane(p).wall) != body) continue;
    const std::optional<double> s = sight.crossing(p, a, b);
    if (s && *s < first) {
      first = *s;
      patch = p.patch;
    }
  }
  if (patch < 0) return std::nullopt;
  const WallPatch& plane = patches.patches[static_cast<std::size_t>(patch)];
  WallHit hit;
  hit.s = first;
  hit.point = a + first * (b - a);
  hit.normal = is_above(height_over(plane, a)) ? plane.normal : Vec3(-plane.normal);
  hit.wall = plane.wall;
  hit.patch = patch;
  return hit;
}

WallField::WallField(const Walls& walls, const WallPoses& poses, const Domain& domain, const Vec3& origin,
                     double h, WhichWalls which, const std::array<Vec3i, 2>& nodes)
    : implementation_(std::make_unique<Implementation>(walls, poses, domain, origin, h, which, nodes)) {}
WallField::WallField(const Walls& walls, const Domain& domain, const Vec3& origin, double h) {
  auto at_rest = std::make_unique<const WallPoses>(walls);
  implementation_ = std::make_unique<Implementation>(walls, *at_rest, domain, origin, h, WhichWalls::all,
                                                     all_nodes_of_domain);
  implementation_->at_rest = std::move(at_rest);
}
WallField::~WallField() = default;

int WallField::stencil(const Vec3i& base) const {
  return implementation_->stencils.find(base);
}

void WallField::visibility(int stencil, const Vec3i& base, const Vec3& x, Visibility& out) const {
  const Implementation& field = *implementation_;
  const StencilRecord& record = field.stencils.records[static_cast<std::size_t>(stencil)];
  out.hidden = 0;
  if (record.cutting == 0 && record.body_count == 0) return;
  const Vec3 at = (x - field.origin) * field.per_h;
  const StencilPatch* patches = field.stencils.patches.data() + record.patches;

  // One patch that covers the stencil: the side decides
  if (record.cutting == 1 && patches->cut.covered() && record.body_count == 0) {
    const bool above = is_above(height_over(field.sight.plane(*patches), at));
    out.hidden = above ? all_nodes & ~patches->above : patches->above;
    if (out.hidden) out.patch.fill(patches->patch);
    return;
  }

  Targets targets;
  bool placed = false;
  const auto place = [&] {
    if (placed) return;
    placed = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double lowest = base[static_cast<int>(k)] + node_offset[static_cast<int>(k)];
      for (std::size_t j = 0; j < Targets::count; ++j) targets.x[k][j] = lowest + node_places[k][j];
    }
  };
  alignas(64) double s[Targets::count];
  std::array<double, Targets::count> first;
  for (std::int32_t i = 0; i < record.cutting; ++i) {
    const StencilPatch& p = patches[i];
    const bool above = is_above(height_over(field.sight.plane(p), at));
    const std::uint32_t beyond = above ? all_nodes & ~p.above : p.above;
    if (!beyond) continue;
    place();
    const std::uint32_t cut = hidden_targets(field.sight, p, Reach::cut_box, at, targets, beyond, s);
    for (std::uint32_t left = cut; left; left &= left - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(left));
      if ((out.hidden >> j & 1) && first[j] <= s[j]) continue;
      first[j] = s[j];
      out.patch[j] = p.patch;
    }
    out.hidden |= cut;
  }
  for (const std::int32_t body : field.stencils.bodies_of(record)) {
    const BodyFace face = field.sight.face(body, at);
    if (face.height > 2 * std::sqrt(3.0)) continue;
    place();
    const std::uint32_t cut = hidden_by(face, at, targets) & all_nodes;
    for (std::uint32_t left = cut; left; left &= left - 1) {
      const auto j = static_cast<std::size_t>(std::countr_zero(left));
      const Vec3 node(targets.x[0][j], targets.x[1][j], targets.x[2][j]);
      const double fall = face.height - (node - face.foot).dot(face.normal);
      const double where = fall > 0 ? std::clamp(face.height / fall, 0.0, 1.0) : 1.0;
      if ((out.hidden >> j & 1) && first[j] <= where) continue;
      first[j] = where;
      out.patch[j] = field.sight.patch_of_body(body);
    }
    out.hidden |= cut;
  }
}

int WallField::planes_of_point(int stencil, const Vec3& x, WallPlane* out, int max) const {
  const Implementation& field = *implementation_;
  const StencilRecord& record = field.stencils.records[static_cast<std::size_t>(stencil)];
  const Vec3 at = (x - field.origin) * field.per_h;
  const int count = active_planes(field.sight, record, at, at, out, max);
  for (int i = 0; i < count; ++i) out[i].distance *= field.h;
  return count;
}

bool WallField::beyond_edge(int stencil, const Vec3& x) const {
  const Implementation& field = *implementation_;
  const StencilRecord& record = field.stencils.records[static_cast<std::size_t>(stencil)];
  const Vec3 at = (x - field.origin) * field.per_h;
  const auto patches = field.stencils.patches_of(record);
  return std::any_of(patches.begin(), patches.end(), [&](const StencilPatch& p) {
    return !p.near.covered() && std::abs(height_over(field.sight.plane(p), at)) < plane_reach;
  });
}

std::span<const WallPlane> WallField::planes_of_node(const Vec3i& node) const {
  const int record = stencil(node - Vec3i::Ones());
  return record < 0 ? std::span<const WallPlane>{} : planes_at(record);
}

std::span<const WallPlane> WallField::planes_at(int record) const {
  const auto& n = implementation_->nodes[static_cast<std::size_t>(record)];
  return {implementation_->planes.data() + n.planes, static_cast<std::size_t>(n.count)};
}

int WallField::bodies_near(int stencil, int* out, int max) const {
  const Implementation& field = *implementation_;
  int count = 0;
  const StencilRecord& record = field.stencils.records[static_cast<std::size_t>(stencil)];
  const auto note = [&](int wall) {
    const int body = field.poses.body_of(wall);
    if (count < max && std::find(out, out + count, body) == out + count) out[count++] = body;
  };
  for (const StencilPatch& p : field.stencils.patches_of(record)) note(field.sight.plane(p).wall);
  for (const std::int32_t body : field.stencils.bodies_of(record))
    note(field.patches.bodies[static_cast<std::size_t>(body)].wall);
  return count;
}

double WallField::open_fraction(const Vec3i& node) const {
  const int record = stencil(node - Vec3i::Ones());
  return record < 0 ? 1.0 : implementation_->open_fraction(static_cast<std::size_t>(record));
}

double WallField::open_fraction_at(int stencil) const {
  return implementation_->open_fraction(static_cast<std::size_t>(stencil));
}

std::optional<WallHit> WallField::first_hit(int stencil, const Vec3& a, const Vec3& b, int body) const {
  const Implementation& field = *implementation_;
  if (field.stencils.records.empty()) return std::nullopt;
  const Vec3 from = (a - field.origin) * field.per_h, to = (b - field.origin) * field.per_h;

  // All within the near box of one record: its patches are all there is
  std::optional<WallHit> hit;
  const Vec3 step = to - from;
  if (stencil >= 0) {
    const StencilRecord& record = field.stencils.records[static_cast<std::size_t>(stencil)];
    const Vec3 centre = (record.base.cast<double>().array() + 1).matrix();
    if ((from - centre).cwiseAbs().maxCoeff() <= 2 && (to - centre).cwiseAbs().maxCoeff() <= 2) {
      hit = field.first_crossing(record, from, to, body);
      if (hit) hit->point = field.origin + field.h * hit->point;
      return hit;
    }
  }

  // Otherwise piece by piece, each within the near box of the stencil at its start; only the part of the
  // path near recorded stencils counts
  if (!from.allFinite() || !to.allFinite()) return std::nullopt;
  double begin = 0, end = 1;
  for (int k = 0; k < 3; ++k) {
    const double lo = field.bases[0][k] - 1.0, hi = field.bases[1][k] + 3.0;
    if (step[k] == 0) {
      if (from[k] < lo || from[k] > hi) return std::nullopt;
      continue;
    }
    const double s0 = (lo - from[k]) / step[k], s1 = (hi - from[k]) / step[k];
    begin = std::max(begin, std::min(s0, s1));
    end = std::min(end, std::max(s0, s1));
  }
  if (!(begin < end)) return std::nullopt;
  const double length = step.cwiseAbs().maxCoeff() * (end - begin);
  const int pieces = static_cast<int>(std::ceil(length / 1.25)) + 1;
  Vec3 start = from + begin * step;
  for (int i = 0; i < pieces; ++i) {
    const double s_begin = begin + (end - begin) * i / pieces;
    const double s_end = begin + (end - begin) * (i + 1) / pieces;
    const Vec3 stop = i + 1 == pieces && end == 1 ? to : Vec3(from + s_end * step);
    const int piece_stencil = field.stencils.find(base_of(start));
    if (piece_stencil >= 0)
      hit = field.first_crossing(field.stencils.records[static_cast<std::size_t>(piece_stencil)], start, stop,
                                 body);
    if (hit) {
      hit->s = s_begin + hit->s * (s_end - s_begin);
      hit->point = field.origin + field.h * hit->point;
      return hit;
    }
    start = stop;
  }
  return std::nullopt;
}

const Vec3& WallField::patch_normal(int patch) const {
  return implementation_->patches.patches[static_cast<std::size_t>(patch)].normal;
}
int WallField::patch_wall(int patch) const {
  return implementation_->sight.wall_of(patch);
}
int WallField::patch_count() const {
  return static_cast<int>(implementation_->patches.patches.size());
}

std::size_t WallField::memory_bytes() const {
  const Implementation& field = *implementation_;
  return field.patches.triangles.capacity() * sizeof(WallTriangle) +
         field.patches.patches.capacity() * sizeof(WallPatch) + field.stencils.memory_bytes() +
         field.nodes.capacity() * sizeof(Implementation::NodeRecord) +
         field.planes.capacity() * sizeof(WallPlane);
}

}  // namespace sluice
