/// Damaged CAD files: each gives an InputError that names the file, the reason and a remedy.

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "geometry/cad_files.h"
#include "geometry/import_mesh.h"
#include "geometry/scratch_folder.h"
#include "geometry/shapes.h"

namespace sluice {
namespace {

/// Reads the file, expecting one problem in it that has these words, at this line (0: the whole file).
void expect_problem(const std::filesystem::path& file, const std::string& words, int line = 0) {
  try {
    import_mesh(file, 1);
    FAIL() << file << " was read";
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 1u);
    const InputProblem& p = e.problems()[0];
    EXPECT_EQ(p.where.file, file.string());
    EXPECT_EQ(p.where.line, line) << p.text();
    EXPECT_FALSE(p.reason.empty());
    EXPECT_FALSE(p.suggestion.empty());
    EXPECT_NE(p.text().find(words), std::string::npos) << p.text();
  }
}

TEST(BadFile, MissingEmptyAndUnknown) {
  const ScratchFolder folder;
  expect_problem(folder.path() / "none.stl", "is missing");
  expect_problem(folder.path(), "is not a file");
  for (const char* name : {"e.stl", "e.obj", "e.ply", "e.gltf", "e.glb"})
    expect_problem(folder.write(name, ""), "is empty");
  expect_problem(folder.write("part.step", "ISO-10303-21;"), "unknown extension '.step'");
  expect_problem(folder.write("part", "solid"), "unknown extension ''");
}

TEST(BadFile, BinaryStlOfAnyOtherLengthThanItsFacetsTake) {
  const ScratchFolder folder;
  const std::string whole = binary_stl(make_test_sphere(1));
  for (std::size_t length :
       {std::size_t{20}, std::size_t{83}, std::size_t{84}, whole.size() - 50, whole.size() - 1})
    expect_problem(folder.write("cut.stl", whole.substr(0, length)), "bytes");
  expect_problem(folder.write("cut.stl", whole.substr(0, whole.size() - 1)), "it is truncated");
  expect_problem(folder.write("long.stl", whole + "x"), "its 32 facets take 1684");
  std::string huge = whole;
  huge.replace(80, 4, "\xff\xff\xff\xff");
  expect_problem(folder.write("huge.stl", huge), "4294967295 facets");
  expect_problem(folder.write("none.stl", binary_stl(TriMesh{})), "has no triangles");
}

TEST(BadFile, NumbersThatAreNotFinite) {
  const ScratchFolder folder;
  TriMesh mesh = make_test_sphere(0);
  mesh.vertices[1].y() = std::nan("");
  expect_problem(folder.write("nan.stl", binary_stl(mesh)), "not finite");
  mesh.vertices[1].y() = std::numeric_limits<double>::infinity();
  expect_problem(folder.write("inf.stl", binary_stl(mesh)), "not finite");
  expect_problem(folder.write("nan.stl", "solid a\n" + text_stl_facet("0 nan 0") + "endsolid a\n"),
                 "'nan' is not a finite number", 6);
  expect_problem(folder.write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 -nan 0\nf 1 2 3\n"), "vertex 3", 3);
  expect_problem(folder.write("inf.obj", "v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n"), "vertex 2", 2);
  expect_problem(folder.write("word.obj", "v 0 0 zero\n"), "'zero'", 1);
  std::string ply = ply_tetrahedron(PlyKind::text);
  ply.replace(ply.find("1.000000"), 8, "nan");
  expect_problem(folder.write("nan.ply", ply), "nan", 13);
}

TEST(BadFile, TextStlThatEndsEarlyOrLosesItsGrammar) {
  const ScratchFolder folder;
  const std::string facet = text_stl_facet();
  expect_problem(folder.write("open.stl", "solid a\n" + facet), "no 'endsolid'", 8);
  expect_problem(folder.write("half.stl", "solid a\n" + facet.substr(0, 60)), "'vertex'", 5);
  expect_problem(folder.write("two.stl",
                              "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                              "endloop\nendfacet\nendsolid a\n"),
                 "'vertex' is expected", 6);
  expect_problem(folder.write("rubbish.stl", "solid a\nrubbish\nendsolid a\n"), "'rubbish'", 2);
  expect_problem(folder.write("no.stl", "solid a\nendsolid a\n"), "has no triangles");
}

TEST(BadFile, ObjFacetsThatNameNoVertex) {
  const ScratchFolder folder;
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* face :
       {"f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1 2 x", "f 1 2 99999999999999999999", "f //1 2 3"})
    expect_problem(folder.write("range.obj", three + face + "\n"), "there are 3 vertices so far", 4);
  expect_problem(folder.write("two.obj", three + "f 1 2\n"), "2 corners", 4);
  expect_problem(folder.write("line.obj", three + "v 2 0 0\nv 3 0 0\nf 1 2 4 5\n"), "cannot be cut", 6);
  expect_problem(folder.write("short.obj", "v 0 0\n"), "2 coordinates", 1);
  expect_problem(folder.write("points.obj", three + "p 1\nl 1 2\n"), "has no triangles");
  expect_problem(folder.write("free.obj", three + "cstype bspline\n"), "free-form", 4);
  expect_problem(folder.write("binary.obj", std::string("\0\x01\x02", 3)), "has no triangles");
}

TEST(BadFile, PlyWithFewerDataThanItsHeaderStates) {
  const ScratchFolder folder;
  for (PlyKind kind : {PlyKind::text, PlyKind::little, PlyKind::big}) {
    const std::string whole = ply_tetrahedron(kind);
    const std::size_t start = whole.find("end_header") + 11;
    for (std::size_t length = start; length + 2 < whole.size(); ++length)
      EXPECT_THROW(import_mesh(folder.write("cut.ply", whole.substr(0, length)), 1), InputError) << length;
    expect_problem(folder.write("many.ply", ply_tetrahedron(kind, 2000000000, 4)),
                   "2000000000 of element 'vertex'");
    expect_problem(folder.write("faces.ply", ply_tetrahedron(kind, 4, 2000000000)),
                   "2000000000 of element 'face'");
  }
}

TEST(BadFile, PlyHeaderCutAtAnyByte) {
  const ScratchFolder folder;
  const std::string whole = ply_tetrahedron(PlyKind::little);
  for (std::size_t length = 1; length < whole.find("end_header"); ++length)
    EXPECT_THROW(import_mesh(folder.write("cut.ply", whole.substr(0, length)), 1), InputError) << length;
}

TEST(BadFile, PlyWithAnyByteChangedIsReadOrRefused) {
  const ScratchFolder folder;
  Random random(5);
  int refused = 0;
  for (PlyKind kind : {PlyKind::text, PlyKind::little, PlyKind::big})
    for (int trial = 0; trial < 300; ++trial) {
      std::string bytes = ply_tetrahedron(kind);
      for (int k = 0; k < 3; ++k)
        bytes[random.next() % bytes.size()] = static_cast<char>(random.next() & 255);
      try {
        const TriMesh mesh = import_mesh(folder.write("changed.ply", bytes), 1);
        for (const auto& t : mesh.triangles)
          for (int v : t) ASSERT_LT(static_cast<std::size_t>(v), mesh.vertices.size());
      } catch (const InputError&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, 300);
}

TEST(BadFile, PlyIndexOutOfRangeAndForeignTypes) {
  const ScratchFolder folder;
  std::string text = ply_tetrahedron(PlyKind::text);
  text.replace(text.find("3 0 2 1"), 7, "3 0 2 9");
  expect_problem(folder.write("range.ply", text), "there are 4 vertices", 16);
  std::string lengths = ply_tetrahedron(PlyKind::text);
  lengths.replace(lengths.find("3 0 2 1"), 7, "2 0 2 1");
  expect_problem(folder.write("two.ply", lengths), "2 corners", 16);
  std::string shorts = ply_tetrahedron(PlyKind::text);
  shorts.replace(shorts.find("uchar int"), 9, "uchar short");
  expect_problem(folder.write("short.ply", shorts), "32-bit indices");
  expect_problem(folder.write("other.ply", "obj\n"), "does not start with 'ply'", 1);
  expect_problem(folder.write("points.ply",
                              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                              "property float y\nproperty float z\nend_header\n0 0 0\n"),
                 "vertex_indices");
}

TEST(BadFile, GltfThatIsCutOrNotJson) {
  const ScratchFolder folder;
  const std::string whole = gltf_two_nodes();
  for (std::size_t length = 1; length < whole.size(); length += 37)
    EXPECT_THROW(import_mesh(folder.write("cut.gltf", whole.substr(0, length)), 1), InputError) << length;
  expect_problem(folder.write("short.glb", "glTF"), "its header states 0");
  expect_problem(folder.write("other.glb", "something else"), "does not start with 'glTF'");
  std::string outside = whole;
  outside.replace(outside.find("\"byteLength\":36"), 15, "\"byteLength\":99");
  EXPECT_THROW(import_mesh(folder.write("outside.gltf", outside), 1), InputError);
}

}  // namespace
}  // namespace sluice
