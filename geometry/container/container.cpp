/// Writes the container: container.obj [mm]: an open-top tank of zero-thickness sheets and a baffle that
/// stands across it at half its length.

#include <iostream>

#include "geometry/import_mesh.h"
#include "geometry/make_shapes.h"
#include "geometry/merge_vertices.h"

namespace sluice {
namespace {

constexpr double mm = 1e-3;

TriMesh make_container() {
  const double length = 600 * mm, width = 400 * mm, height = 500 * mm, baffle = 250 * mm;
  TriMesh mesh;
  // Floor and end walls are one bent sheet; the long sides meet it.
  mesh.append(make_sheet("tank", {{0, height}, {0, 0}, {length, 0}, {length, height}}, {0, width}));
  for (double y : {0.0, width})
    mesh.append(make_rectangle(
        "tank", {Vec3(0, y, 0), Vec3(length, y, 0), Vec3(length, y, height), Vec3(0, y, height)}));
  mesh.append(make_sheet("baffle", {{0.5 * length, 0}, {0.5 * length, baffle}}, {0, width}));
  return mesh;
}

}  // namespace
}  // namespace sluice

int main(int argc, char** argv) {
  using namespace sluice;
  if (argc != 2) {
    std::cerr << "usage: container_geometry FOLDER\n";
    return 2;
  }
  try {
    TriMesh mesh = make_container();
    merge_equal_vertices(mesh);
    write_obj(std::string(argv[1]) + "/container.obj", mesh, mm,
              "Open-top tank 600 x 400 x 500 with a baffle, millimetres, z up; written by "
              "geometry/container/container.cpp");
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
