#include "geometry/audit_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "geometry/import_mesh.h"
#include "geometry/merge_vertices.h"

namespace sluice {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<int, 3>;

Point point(const TriMesh& mesh, int v) {
  const Vec3& x = mesh.vertices[static_cast<std::size_t>(v)];
  return {x.x(), x.y(), x.z()};
}

bool is_degenerate(const TriMesh& mesh, const Triangle& t) {
  return CGAL::collinear(point(mesh, t[0]), point(mesh, t[1]), point(mesh, t[2]));
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Groups that grow together.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      int& up = parent_[static_cast<std::size_t>(i)];
      up = parent_[static_cast<std::size_t>(up)];
      i = up;
    }
    return i;
  }
  void join(int i, int j) { parent_[static_cast<std::size_t>(find(i))] = find(j); }

 private:
  std::vector<int> parent_;
};

/// Uses of an undirected edge, in its own direction and against it.
struct EdgeUse {
  int along = 0, against = 0;
};
using Edges = std::map<std::pair<int, int>, EdgeUse>;

Edges edges_of(const TriMesh& mesh) {
  Edges edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      EdgeUse& use = edges[std::minmax(a, b)];
      ++(a < b ? use.along : use.against);
    }
  return edges;
}

void count_edges(const TriMesh& mesh, PartAudit& audit) {
  UnionFind loops(mesh.vertices.size());
  std::set<int> on_boundary;
  audit.consistent = true;
  for (const auto& [edge, use] : edges_of(mesh)) {
    const int uses = use.along + use.against;
    if (use.along > 1 || use.against > 1) audit.consistent = false;
    if (uses > 2) ++audit.non_manifold_edges;
    if (uses != 1) continue;
    ++audit.boundary_edges;
    loops.join(edge.first, edge.second);
    on_boundary.insert({edge.first, edge.second});
  }
  std::set<int> roots;
  for (int v : on_boundary) roots.insert(loops.find(v));
  audit.boundary_loops = roots.size();
  audit.closed = audit.boundary_edges == 0 && audit.triangles > 0;
}

std::size_t count_components(const TriMesh& mesh) {
  UnionFind groups(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    groups.join(t[0], t[1]);
    groups.join(t[1], t[2]);
  }
  std::set<int> roots;
  for (const Triangle& t : mesh.triangles) roots.insert(groups.find(t[0]));
  return roots.size();
}

/// Whether two facets meet anywhere but in the vertices or the edge that they share.
bool cut_each_other(const TriMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto corners = [&](const Triangle& f) {
    return Kernel::Triangle_3(point(mesh, f[0]), point(mesh, f[1]), point(mesh, f[2]));
  };
  std::vector<int> shared, only_s, only_t;
  for (int v : s) (std::find(t.begin(), t.end(), v) != t.end() ? shared : only_s).push_back(v);
  for (int v : t)
    if (std::find(s.begin(), s.end(), v) == s.end()) only_t.push_back(v);
  if (shared.empty()) return CGAL::do_intersect(corners(s), corners(t));
  if (shared.size() == 1)
    return CGAL::do_intersect(corners(s),
                              Kernel::Segment_3(point(mesh, only_t[0]), point(mesh, only_t[1]))) ||
           CGAL::do_intersect(corners(t), Kernel::Segment_3(point(mesh, only_s[0]), point(mesh, only_s[1])));
  if (shared.size() == 3) return false;  // a duplicate, counted as such
  const Point a = point(mesh, shared[0]), b = point(mesh, shared[1]);
  const Point c = point(mesh, only_s[0]), d = point(mesh, only_t[0]);
  return CGAL::coplanar(a, b, c, d) &&
         CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;  // folded over
}

std::size_t count_self_intersections(const TriMesh& mesh) {
  using BoxHandle = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Triangle*>;
  std::vector<BoxHandle> boxes;
  for (const Triangle& t : mesh.triangles)
    if (!is_degenerate(mesh, t))
      boxes.emplace_back(point(mesh, t[0]).bbox() + point(mesh, t[1]).bbox() + point(mesh, t[2]).bbox(), &t);
  std::size_t count = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const BoxHandle& s, const BoxHandle& t) {
    if (cut_each_other(mesh, *s.handle(), *t.handle())) ++count;
  });
  return count;
}

double volume_of(const TriMesh& mesh) {
  const Vec3 origin = mesh.bounds().centre();
  double volume = 0;
  for (const Triangle& t : mesh.triangles) {
    Vec3 x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.vertices[static_cast<std::size_t>(t[k])] - origin;
    volume += x[0].dot(x[1].cross(x[2])) / 6;
  }
  return volume;
}

/// @param mesh  one part, its equal vertices merged
PartAudit audit_part(const std::string& name, const TriMesh& mesh) {
  PartAudit audit;
  audit.part = name;
  audit.triangles = mesh.triangles.size();
  audit.vertices = mesh.vertices.size();
  count_edges(mesh, audit);
  std::set<Triangle> seen;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    audit.degenerate += is_degenerate(mesh, mesh.triangles[t]);
    audit.duplicates += !seen.insert(sorted(mesh.triangles[t])).second;
    audit.area += mesh.area(static_cast<int>(t));
  }
  audit.self_intersections = count_self_intersections(mesh);
  audit.components = count_components(mesh);
  audit.bounds = mesh.bounds();
  if (audit.closed && audit.consistent) audit.volume = volume_of(mesh);
  return audit;
}

struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
};

Soup soup_of(const TriMesh& mesh) {
  Soup soup;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    soup.points.push_back(point(mesh, static_cast<int>(v)));
  for (const Triangle& t : mesh.triangles) soup.polygons.emplace_back(t.begin(), t.end());
  return soup;
}

TriMesh mesh_of(const Soup& soup, const std::string& name) {
  TriMesh mesh;
  mesh.part_names = {name};
  for (const Point& p : soup.points) mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  for (const auto& polygon : soup.polygons)
    mesh.triangles.push_back(
        {static_cast<int>(polygon[0]), static_cast<int>(polygon[1]), static_cast<int>(polygon[2])});
  mesh.part.assign(mesh.triangles.size(), 0);
  return mesh;
}

/// Whether b holds the corners of a in the opposite order.
bool is_flipped(const TriMesh& mesh_a, const Triangle& a, const TriMesh& mesh_b, const Triangle& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (point(mesh_b, b[k]) == point(mesh_a, a[0]))
      return point(mesh_b, b[(k + 1) % 3]) != point(mesh_a, a[1]);
  return false;
}

/// Orients facets alike, closed parts outwards; returns how many were turned.
std::size_t orient(TriMesh& mesh, const std::string& name) {
  Soup soup = soup_of(mesh);
  CGAL::Polygon_mesh_processing::orient_polygon_soup(soup.points, soup.polygons);
  TriMesh oriented = mesh_of(soup, name);
  const PartAudit audit = audit_part(name, oriented);
  if (audit.volume < 0)
    for (Triangle& t : oriented.triangles) std::swap(t[1], t[2]);
  std::size_t flipped = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    flipped += is_flipped(mesh, mesh.triangles[t], oriented, oriented.triangles[t]);
  mesh = std::move(oriented);
  return flipped;
}

/// Keeps the facets that pass; returns how many went.
template <class Keep>
std::size_t keep_if(TriMesh& mesh, const Keep& keep) {
  const auto gone = std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                   [&](const Triangle& t) { return !keep(t); });
  const auto count = static_cast<std::size_t>(mesh.triangles.end() - gone);
  mesh.triangles.erase(gone, mesh.triangles.end());
  mesh.part.resize(mesh.triangles.size());
  return count;
}

}  // namespace

std::vector<PartAudit> audit_mesh(const TriMesh& mesh) {
  std::vector<PartAudit> audits;
  for (const std::string& name : mesh.part_names) {
    TriMesh part = extract_part(mesh, name);
    merge_equal_vertices(part);
    audits.push_back(audit_part(name, part));
  }
  return audits;
}

RepairReport repair_mesh(TriMesh& mesh) {
  RepairReport report;
  TriMesh repaired;
  for (const std::string& name : mesh.part_names) {
    TriMesh part = extract_part(mesh, name);
    report.merged_vertices += merge_equal_vertices(part);
    report.removed_degenerate += keep_if(part, [&](const Triangle& t) { return !is_degenerate(part, t); });
    std::set<Triangle> seen;
    report.removed_duplicates +=
        keep_if(part, [&](const Triangle& t) { return seen.insert(sorted(t)).second; });
    report.flipped += orient(part, name);
    repaired.append(part);
  }
  mesh = std::move(repaired);
  return report;
}

}  // namespace sluice
