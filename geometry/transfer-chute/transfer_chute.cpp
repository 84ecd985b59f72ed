/// Writes the transfer chute: transfer-chute.obj [mm, one object a part].
///
///      belt =====o  hood      rock is thrown against the hood, falls 2 m in all and leaves the spoon's
///           rear  \     |     bottom opening in +x
///                  \    |
///             spoon `.
///                     `-._

#include <cmath>
#include <iostream>
#include <numbers>

#include "geometry/import_mesh.h"
#include "geometry/make_shapes.h"
#include "geometry/merge_vertices.h"

namespace sluice {
namespace {

constexpr double mm = 1e-3;
double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}
Eigen::Vector2d point(double x, double z) {
  return {x * mm, z * mm};
}
Vec3 point(double x, double y, double z) {
  return Vec3(x, y, z) * mm;
}

/// The design, in millimetres and degrees; ours.
struct TransferChute {
  double width = 1200;
  double belt_width = 1000, belt_start = -1500, belt_height = 2400, pulley_radius = 300;
  double hood_x = 900, hood_top = 2950, hood_bottom = 1150, hood_radius = 450;
  double spoon_x = 480, spoon_top = 1500, spoon_bottom = 400, spoon_first_slope = 75, spoon_last_slope = 40;
  double rear_x = -20;
};

/// Slopes fall evenly from first to last; scaled so that it ends at spoon_bottom.
Profile spoon_profile(const TransferChute& c) {
  constexpr int steps = 10;
  double unit_drop = 0;
  const auto slope = [&](int k) {
    return radians(c.spoon_first_slope + (c.spoon_last_slope - c.spoon_first_slope) * k / (steps - 1));
  };
  for (int k = 0; k < steps; ++k) unit_drop += std::sin(slope(k));
  const double step = (c.spoon_top - c.spoon_bottom) / unit_drop;
  Eigen::Vector2d at(c.spoon_x, c.spoon_top);
  Profile profile = {at * mm};
  for (int k = 0; k < steps; ++k) {
    at += step * Eigen::Vector2d(std::cos(slope(k)), -std::sin(slope(k)));
    profile.push_back(at * mm);
  }
  return profile;
}

TriMesh make_transfer_chute(const TransferChute& c) {
  TriMesh mesh;
  const double half = 0.5 * c.width, half_belt = 0.5 * c.belt_width * mm;
  const Width width{-half * mm, half * mm};
  constexpr int steps = 8;

  Profile belt = {point(c.belt_start, c.belt_height)};
  for (int k = 0; k <= steps; ++k) {
    const double angle = radians(60.0 * k / steps);
    belt.push_back(
        point(c.pulley_radius * std::sin(angle), c.belt_height - c.pulley_radius * (1 - std::cos(angle))));
  }
  mesh.append(make_sheet("belt", belt, {-half_belt, half_belt}));

  Profile hood = {point(c.rear_x, c.hood_top)};
  for (int k = 0; k <= steps; ++k) {
    const double angle = radians(90.0 * k / steps);
    hood.push_back(point(c.hood_x - c.hood_radius * (1 - std::sin(angle)),
                         c.hood_top - c.hood_radius * (1 - std::cos(angle))));
  }
  hood.push_back(point(c.hood_x, c.hood_bottom));
  mesh.append(make_sheet("hood", hood, width));

  mesh.append(make_sheet("rear_plate",
                         {point(c.rear_x, c.belt_height - 20), point(c.rear_x, c.belt_height - 300),
                          point(c.spoon_x, c.spoon_top)},
                         width));
  const Profile spoon = spoon_profile(c);
  mesh.append(make_sheet("spoon", spoon, width));

  const double end = spoon.back().x() / mm;
  for (const auto& [name, y] : {std::pair{"side_right", -half}, std::pair{"side_left", half}}) {
    mesh.append(make_polygon(name, {point(c.rear_x, y, c.spoon_top), point(c.hood_x, y, c.spoon_top),
                                    point(c.hood_x, y, c.hood_top), point(c.rear_x, y, c.hood_top)}));
    mesh.append(make_polygon(name, {point(c.rear_x, y, c.spoon_top), point(end, y, c.spoon_bottom - 20),
                                    point(end, y, c.hood_bottom), point(c.hood_x, y, c.spoon_top)}));
  }
  return mesh;
}

}  // namespace
}  // namespace sluice

int main(int argc, char** argv) {
  using namespace sluice;
  if (argc != 2) {
    std::cerr << "usage: transfer_chute_geometry FOLDER\n";
    return 2;
  }
  try {
    TriMesh mesh = make_transfer_chute({});
    merge_equal_vertices(mesh);
    write_obj(std::string(argv[1]) + "/transfer-chute.obj", mesh, mm,
              "Transfer chute of our own design, millimetres, z up; written by "
              "geometry/transfer-chute/transfer_chute.cpp");
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
