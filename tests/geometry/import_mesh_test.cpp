#include "geometry/import_mesh.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "geometry/cad_files.h"
#include "geometry/scratch_folder.h"
#include "geometry/shapes.h"

namespace sluice {
namespace {

using Names = std::vector<std::string>;

TEST(ImportMesh, ReadsBinaryStlAndJoinsItsVertices) {
  const ScratchFolder folder;
  const TriMesh box = make_box("b", {Vec3(0, 0, 0), Vec3(1000, 500, 250)});
  for (const char* header : {"made by a test", "solid that is binary all the same"}) {
    const TriMesh read = import_mesh(folder.write("tank.stl", binary_stl(box, header)), 1e-3);
    EXPECT_EQ(read.triangles.size(), 12u);
    EXPECT_EQ(read.vertices.size(), 8u);
    EXPECT_EQ(read.part_names, Names{"tank"});
    EXPECT_NEAR(volume_of(read), 0.125, 1e-15);
  }
}

TEST(ImportMesh, ReadsEverySolidOfATextStlWithItsWholeName) {
  const ScratchFolder folder;
  const TriMesh read = import_mesh(
      folder.write("two.STL", "solid back plate, 12 mm\n" + text_stl_facet() +
                                  "endsolid back plate, 12 mm\nsolid\r\n" + text_stl_facet("0 2 0") +
                                  text_stl_facet("-1e-1 +2.5E0 3") + "endsolid\n"),
      1);
  EXPECT_EQ(read.part_names, (Names{"back plate, 12 mm", "two"}));
  EXPECT_EQ(read.part, (std::vector<int>{0, 1, 1}));
  EXPECT_NEAR((read.vertices[static_cast<std::size_t>(read.triangles[2][2])] - Vec3(-0.1, 2.5, 3)).norm(), 0,
              1e-7);
}

TEST(ImportMesh, ReadsObjPartsWithBlanksPolygonsAndRelativeIndices) {
  const ScratchFolder folder;
  const TriMesh read =
      import_mesh(folder.write("parts.obj",
                               "# a comment\nmtllib none.mtl\no ledge no 1\nv 0 0 0\nv 1 0 0 # x\n"
                               "v 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nusemtl steel\ng skin\n"
                               "f 1/1/1 2/1/1 3/1/1 4/1/1\no empty\no ledge 2\nv 0 0 1.23456789012\n"
                               "usemtl rubber\nf -1//1 1//1 \\\n2//1\no ledge no 1\nf 4 3 5\n"),
                  1);
  EXPECT_EQ(read.part_names, (Names{"ledge no 1", "ledge 2"}));
  EXPECT_EQ(read.part, (std::vector<int>{0, 0, 1, 0}));
  EXPECT_EQ(read.vertices[static_cast<std::size_t>(read.triangles[2][0])], Vec3(0, 0, 1.23456789012));
}

TEST(ImportMesh, CutsAConcavePolygonWithoutCoveringItsNotch) {
  const ScratchFolder folder;
  // An L: 2 x 2 less the upper right unit square.
  const TriMesh read = import_mesh(
      folder.write("l.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"), 1);
  ASSERT_EQ(read.triangles.size(), 4u);
  double area = 0;
  for (int t = 0; t < 4; ++t) {
    area += read.area(t);
    EXPECT_EQ(read.normal(t), Vec3(0, 0, 1));
  }
  EXPECT_DOUBLE_EQ(area, 3);
  EXPECT_EQ(read.part_names, Names{"l"});
}

TEST(ImportMesh, ObjGroupsAreThePartsWhereThereAreNoObjects) {
  const ScratchFolder folder;
  const TriMesh read = import_mesh(
      folder.write("g.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng left side\nf 1 2 3\ng right\nf 3 2 1\n"), 1);
  EXPECT_EQ(read.part_names, (Names{"left side", "right"}));
}

TEST(ImportMesh, ReadsPlyInAllThreeFormats) {
  const ScratchFolder folder;
  for (PlyKind kind : {PlyKind::text, PlyKind::little, PlyKind::big}) {
    const TriMesh read = import_mesh(folder.write("tetra.ply", ply_tetrahedron(kind)), 0.1);
    EXPECT_EQ(read.triangles.size(), 4u);
    EXPECT_EQ(read.vertices.size(), 4u);
    EXPECT_NEAR(volume_of(read), 1e-3 / 6, 1e-18);
    EXPECT_EQ(read.part_names, Names{"tetra"});
  }
}

TEST(ImportMesh, PlacesGltfNodesByAllTheirTransforms) {
  const ScratchFolder folder;
  const TriMesh read = import_mesh(folder.write("scene.gltf", gltf_two_nodes()), 1);
  ASSERT_EQ(read.part_names, (Names{"plate", "lid"}));
  const TriMesh plate = extract_part(read, "plate"), lid = extract_part(read, "lid");
  EXPECT_EQ(plate.bounds().lo, Vec3(20, 0, 0));
  EXPECT_EQ(plate.bounds().hi, Vec3(22, 2, 0));
  EXPECT_EQ(lid.bounds().hi, Vec3(1, 1, 0));
}

TEST(ImportMesh, WhatWriteObjWroteComesBack) {
  const ScratchFolder folder;
  TriMesh mesh = make_test_sphere(2);
  mesh.append(make_box("a box", {Vec3(1.0 / 3, 2, 3), Vec3(2, 3, 4)}));
  write_obj(folder.path() / "out.obj", mesh, 1e-3, "two parts\nin millimetres");
  const TriMesh read = import_mesh(folder.path() / "out.obj", 1e-3);
  ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
  EXPECT_EQ(read.part_names, mesh.part_names);
  EXPECT_EQ(read.part, mesh.part);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_NEAR((read.vertices[static_cast<std::size_t>(read.triangles[t][k])] -
                   mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])])
                      .norm(),
                  0, 1e-9);  // ten digits were written
}

TEST(WriteObj, SaysWhenItCannotWrite) {
  EXPECT_THROW(write_obj("/proc/no/such/folder.obj", make_test_sphere(0), 1, ""), EnvironmentError);
}

TEST(ExtractPart, KeepsOnlyItsOwnTrianglesAndVertices) {
  TriMesh mesh = make_test_sphere(1);
  mesh.append(make_box("tank", {Vec3::Zero(), Vec3::Ones()}));
  const TriMesh tank = extract_part(mesh, "tank");
  EXPECT_EQ(tank.triangles.size(), 12u);
  EXPECT_EQ(tank.vertices.size(), 8u);
  EXPECT_EQ(tank.part_names, Names{"tank"});
  EXPECT_DOUBLE_EQ(volume_of(tank), 1);
}

TEST(ExtractPart, NamesTheNearestPartForAMistypedOne) {
  TriMesh mesh = make_box("ledge_1", {Vec3::Zero(), Vec3::Ones()});
  mesh.append(make_box("chute", {Vec3::Zero(), Vec3::Ones()}));
  try {
    extract_part(mesh, "legde_1");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(
        e.what(),
        "'legde_1' is not a part of the mesh (its parts are ledge_1, chute) did you mean 'ledge_1'?");
  }
}

}  // namespace
}  // namespace sluice
