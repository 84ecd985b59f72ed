#include "geometry/audit_mesh.h"

#include <gtest/gtest.h>

#include "geometry/shapes.h"

namespace sluice {
namespace {

TEST(AuditMesh, FindsNothingWrongWithAClosedBox) {
  const PartAudit audit = audit_mesh(make_box("tank", {Vec3(0, 0, 0), Vec3(1, 2, 3)})).at(0);
  EXPECT_EQ(audit.part, "tank");
  EXPECT_EQ(audit.triangles, 12u);
  EXPECT_EQ(audit.vertices, 8u);
  EXPECT_TRUE(audit.closed);
  EXPECT_TRUE(audit.consistent);
  EXPECT_EQ(audit.boundary_loops + audit.boundary_edges + audit.non_manifold_edges + audit.degenerate +
                audit.duplicates + audit.self_intersections,
            0u);
  EXPECT_EQ(audit.components, 1u);
  EXPECT_DOUBLE_EQ(audit.area, 22);
  EXPECT_NEAR(audit.volume, 6, 1e-14);
  EXPECT_EQ(audit.bounds.hi, Vec3(1, 2, 3));
}

TEST(AuditMesh, TellsAHoleFromASheet) {
  TriMesh box = make_box("tank", {Vec3::Zero(), Vec3::Ones()});
  box.triangles.resize(10);  // without its lid
  box.part.resize(10);
  const PartAudit audit = audit_mesh(box).at(0);
  EXPECT_FALSE(audit.closed);
  EXPECT_TRUE(audit.consistent);
  EXPECT_EQ(audit.boundary_edges, 4u);
  EXPECT_EQ(audit.boundary_loops, 1u);
  EXPECT_EQ(audit.volume, 0);
}

TEST(AuditMesh, CountsEachFaultApart) {
  TriMesh mesh = make_box("b", {Vec3::Zero(), Vec3::Ones()});
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);  // turned over
  mesh.triangles.push_back(mesh.triangles[5]);            // twice
  mesh.triangles.push_back({0, 1, 1});                    // no area
  mesh.part.assign(mesh.triangles.size(), 0);
  const PartAudit audit = audit_mesh(mesh).at(0);
  EXPECT_FALSE(audit.consistent);
  EXPECT_EQ(audit.duplicates, 1u);
  EXPECT_EQ(audit.degenerate, 1u);
  EXPECT_GE(audit.non_manifold_edges, 3u);
}

TEST(AuditMesh, FindsFacetsThatCutEachOtherAndThoseThatOnlyTouch) {
  TriMesh cross = make_rectangle("x", {Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 1), Vec3(-1, 0, 1)});
  cross.append(make_rectangle("x", {Vec3(0.1, -1, -1), Vec3(0.1, 1, -1), Vec3(0.1, 1, 1), Vec3(0.1, -1, 1)}));
  const PartAudit audit = audit_mesh(cross).at(0);
  EXPECT_GE(audit.self_intersections, 2u);
  EXPECT_EQ(audit.components, 2u);
  EXPECT_EQ(audit.boundary_loops, 2u);
  // A tent's two slopes share their ridge; folded flat on to each other they overlap.
  TriMesh tent = make_rectangle("t", {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  tent.append(make_rectangle("t", {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, -1, 0), Vec3(0, -1, 0)}));
  EXPECT_EQ(audit_mesh(tent).at(0).self_intersections, 0u);
  tent.vertices[6] = Vec3(1, 2, -1);
  tent.vertices[7] = Vec3(0, 2, -1);
  EXPECT_GE(audit_mesh(tent).at(0).self_intersections, 1u);
}

TEST(AuditMesh, KeepsPartsApart) {
  TriMesh mesh = make_box("closed", {Vec3::Zero(), Vec3::Ones()});
  mesh.append(make_rectangle("sheet", {Vec3(0, 0, 0.5), Vec3(1, 0, 0.5), Vec3(1, 1, 0.5), Vec3(0, 1, 0.5)}));
  const auto audits = audit_mesh(mesh);
  ASSERT_EQ(audits.size(), 2u);
  EXPECT_TRUE(audits[0].closed);
  EXPECT_EQ(audits[0].self_intersections, 0u);
  EXPECT_FALSE(audits[1].closed);
}

TEST(RepairMesh, MakesASoupOfMixedFacetsOneClosedOutwardBox) {
  const TriMesh box = make_box("b", {Vec3::Zero(), Vec3(1, 2, 3)});
  TriMesh soup;
  soup.part_names = {"b"};
  for (std::size_t t = 0; t < 12; ++t) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = static_cast<int>(soup.vertices.size());
      soup.vertices.push_back(box.vertices[static_cast<std::size_t>(box.triangles[t][k])]);
    }
    if (t % 3 != 0) std::swap(corners[0], corners[1]);  // most of them inwards
    soup.triangles.push_back(corners);
  }
  soup.triangles.push_back({0, 1, 2});
  soup.triangles.push_back({0, 0, 2});
  soup.part.assign(14, 0);
  const RepairReport report = repair_mesh(soup);
  EXPECT_EQ(report.merged_vertices, 28u);
  EXPECT_EQ(report.removed_degenerate, 1u);
  EXPECT_EQ(report.removed_duplicates, 1u);
  EXPECT_EQ(report.flipped, 8u);
  const PartAudit audit = audit_mesh(soup).at(0);
  EXPECT_TRUE(audit.closed);
  EXPECT_TRUE(audit.consistent);
  EXPECT_NEAR(audit.volume, 6, 1e-14);
}

TEST(RepairMesh, LeavesAGoodMeshAsItIs) {
  TriMesh mesh = make_box("b", {Vec3::Zero(), Vec3::Ones()});
  const TriMesh before = mesh;
  const RepairReport report = repair_mesh(mesh);
  EXPECT_EQ(report.merged_vertices + report.removed_degenerate + report.removed_duplicates + report.flipped,
            0u);
  EXPECT_EQ(mesh.triangles.size(), before.triangles.size());
  EXPECT_DOUBLE_EQ(volume_of(mesh), 1);
}

}  // namespace
}  // namespace sluice
