/// Writes a screen box: screen-deck.obj [mm]: a deck that declines along x, its side plates and back plate,
/// all zero-thickness sheets. Apertures are not drawn.

#include <cmath>
#include <iostream>
#include <numbers>

#include "geometry/import_mesh.h"
#include "geometry/make_shapes.h"
#include "geometry/merge_vertices.h"

namespace sluice {
namespace {

constexpr double mm = 1e-3;

TriMesh make_screen_deck() {
  const double length = 1200 * mm, half_width = 200 * mm, board = 250 * mm;
  const double fall = length * std::tan(5 * std::numbers::pi / 180);
  TriMesh mesh;
  mesh.append(make_sheet("deck", {{0, fall}, {length, 0}}, {-half_width, half_width}));
  mesh.append(make_sheet("back_plate", {{0, fall}, {0, fall + board}}, {-half_width, half_width}));
  for (const auto& [name, y] : {std::pair{"side_right", -half_width}, {"side_left", half_width}})
    mesh.append(make_polygon(
        name, {Vec3(0, y, fall), Vec3(length, y, 0), Vec3(length, y, board), Vec3(0, y, fall + board)}));
  return mesh;
}

}  // namespace
}  // namespace sluice

int main(int argc, char** argv) {
  using namespace sluice;
  if (argc != 2) {
    std::cerr << "usage: screen_deck_geometry FOLDER\n";
    return 2;
  }
  try {
    TriMesh mesh = make_screen_deck();
    merge_equal_vertices(mesh);
    write_obj(std::string(argv[1]) + "/screen-deck.obj", mesh, mm,
              "Screen box 1200 x 400, deck 5 degrees down, millimetres, z up; written by "
              "geometry/screen-deck/screen_deck.cpp");
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
