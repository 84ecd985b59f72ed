/// Writes the feed box: feedbox.obj [mm, one object a part] and outlets.csv [mm].
///
/// Side view, x to the right, z up; everything is drawn across the inner width of 2.4 m.
///
///        belt ======o   hood                 rock falls in four stages of less than a metre:
///              |     `\ . |      <- headers      belt -> ledge_1 -> ledge_2 -> ledge_3 -> chute -> lip,
///         back |      ./ledge_1                 then 0.4 m on to the deck
///              |\.       |front
///              | ledge_2 |
///              |       ./ledge_3
///              |\.
///          chute  `\.  lip
///                      ------- deck

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
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

/// The design, in millimetres and degrees. Chosen by us: the published feed box gives no dimensions.
struct FeedBox {
  double inner_width = 2400;
  double back = -300, front = 1050, top = 4500;
  // Conveyor: carrying surface ends at the head pulley's crown at x = 0.
  double belt_width = 1200, belt_start = -1500, belt_height = 4000;
  double pulley_radius = 300, pulley_wrap = 60, skirt_spacing = 1120, skirt_height = 350;
  // Cascade, from the lip upwards: every passage is at least `opening` wide (three times the top size).
  double opening = 750, lip_x = 600, lip_above_deck = 400, chute_slope = 38;
  double ledge_reach = 600, ledge_slope = 40, ledge_thickness = 100, plate_thickness = 12;
  double deck_start = 450, deck_end = 1650, deck_slope = 12, front_bottom = 1000;
  // Water.
  int pipes = 10, nozzles_a_row = 22;
  double bore = 90, nozzle_diameter = 40, nozzle_bore = 12;

  double chute_height(double x) const {
    return lip_above_deck + (lip_x - x) * std::tan(radians(chute_slope));
  }
  double deck_height(double x) const { return (lip_x - x) * std::tan(radians(deck_slope)); }
  double front_tip() const { return front - ledge_reach; }
  double back_tip() const { return back + ledge_reach; }
  /// Heights of the ledges' tips, such that `opening` is left square to the surface below.
  double tip_3() const { return chute_height(front_tip()) + opening / std::cos(radians(chute_slope)); }
  double stage() const {
    const double angle = radians(ledge_slope);
    return (opening - (front_tip() - back_tip()) * std::sin(angle)) / std::cos(angle);
  }
  double tip_2() const { return tip_3() + stage(); }
  double tip_1() const { return tip_2() + stage(); }
};

struct Outlet {
  std::string name, variant;
  Vec3 at, direction;
  double bore;
};

Eigen::Vector2d point(double x, double z) {
  return {x * mm, z * mm};
}
Vec3 point(double x, double y, double z) {
  return Vec3(x, y, z) * mm;
}

enum class Rooted { at_back, at_front };

/// A ledge that rises from its tip to the plate it is fixed to; its end is cut square.
TriMesh ledge(const FeedBox& box, const std::string& name, Rooted rooted, double tip_height, Width width) {
  const double side = rooted == Rooted::at_front ? 1 : -1;
  const double tip = rooted == Rooted::at_front ? box.front_tip() : box.back_tip();
  const double root = rooted == Rooted::at_front ? box.front : box.back;
  const double angle = radians(box.ledge_slope), t = box.ledge_thickness;
  const double root_height = tip_height + box.ledge_reach * std::tan(angle);
  Profile outline = {point(tip, tip_height),
                     point(tip + side * t * std::sin(angle), tip_height - t * std::cos(angle)),
                     point(root, root_height - t / std::cos(angle)), point(root, root_height)};
  if (rooted == Rooted::at_back) std::reverse(outline.begin(), outline.end());
  return make_prism(name, outline, width);
}

void add_conveyor(const FeedBox& box, TriMesh& mesh) {
  Profile belt = {point(box.belt_start, box.belt_height)};
  constexpr int steps = 8;
  for (int k = 0; k <= steps; ++k) {
    const double angle = radians(box.pulley_wrap) * k / steps;
    belt.push_back(point(box.pulley_radius * std::sin(angle),
                         box.belt_height - box.pulley_radius * (1 - std::cos(angle))));
  }
  const double half = 0.5 * box.belt_width * mm;
  mesh.append(make_sheet("belt", belt, {-half, half}));
  const double low = box.belt_height + 10, high = box.belt_height + box.skirt_height;
  for (double y : {-0.5 * box.skirt_spacing, 0.5 * box.skirt_spacing})
    mesh.append(make_rectangle("skirts", {point(box.belt_start, y, low), point(50, y, low),
                                          point(50, y, high), point(box.belt_start, y, high)}));
}

void add_hood(const FeedBox& box, TriMesh& mesh) {
  const double wide = 0.5 * box.inner_width, narrow = 0.5 * box.belt_width;
  const double burden = box.belt_height + box.skirt_height, plate_top = box.belt_height - 20;
  // Top, then the rear wall around the belt's opening; all corners meet corners.
  const auto rear = [&](double y0, double y1, double z0, double z1) {
    mesh.append(make_rectangle("inlet_hood", {point(box.back, y0, z0), point(box.back, y0, z1),
                                              point(box.back, y1, z1), point(box.back, y1, z0)}));
  };
  const double rows[] = {-wide, -narrow, narrow, wide};
  for (int k = 0; k < 3; ++k) {
    mesh.append(make_rectangle(
        "inlet_hood", {point(box.back, rows[k], box.top), point(box.front, rows[k], box.top),
                       point(box.front, rows[k + 1], box.top), point(box.back, rows[k + 1], box.top)}));
    rear(rows[k], rows[k + 1], burden, box.top);
    if (k != 1) rear(rows[k], rows[k + 1], plate_top, burden);
  }
}

void add_box(const FeedBox& box, TriMesh& mesh) {
  const double half = 0.5 * box.inner_width;
  const Width width{-half * mm, half * mm};
  const double plate = box.plate_thickness, bottom = box.front_bottom, outside = box.front + plate;
  mesh.append(make_sheet(
      "back_plate", {point(box.back, box.chute_height(box.back) - 50), point(box.back, box.belt_height - 20)},
      width));
  mesh.append(make_prism(
      "front_plate",
      {point(box.front, bottom), point(outside, bottom), point(outside, box.top), point(box.front, box.top)},
      width));
  const double deck_z = box.deck_height(box.deck_end);
  for (const auto& [name, y] : {std::pair{"side_right", -half}, std::pair{"side_left", half}}) {
    mesh.append(make_polygon(name, {point(box.back, y, bottom), point(outside, y, bottom),
                                    point(outside, y, box.top), point(box.back, y, box.top)}));
    mesh.append(make_polygon(
        name, {point(box.back, y, bottom), point(box.deck_start, y, 0), point(box.deck_end, y, deck_z - 30),
               point(box.deck_end, y, deck_z + 750), point(outside, y, bottom)}));
  }
  mesh.append(ledge(box, "ledge_1", Rooted::at_front, box.tip_1(), width));
  mesh.append(ledge(box, "ledge_2", Rooted::at_back, box.tip_2(), width));
  mesh.append(ledge(box, "ledge_3", Rooted::at_front, box.tip_3(), width));

  const double drop = plate / std::cos(radians(box.chute_slope));
  mesh.append(make_prism(
      "chute",
      {point(box.back, box.chute_height(box.back)), point(box.back, box.chute_height(box.back) - drop),
       point(box.lip_x, box.lip_above_deck - drop), point(box.lip_x, box.lip_above_deck)},
      width));
  mesh.append(make_sheet("deck",
                         {point(box.deck_start, box.deck_height(box.deck_start)),
                          point(box.deck_end, box.deck_height(box.deck_end))},
                         width));
}

/// One header across the box with outlets through a plate.
struct Header {
  std::string part, name;
  Vec3 at;                               ///< axis at y = 0 [mm]
  Vec3 direction;                        ///< of the outlets
  double radius, length, outlet_radius;  ///< length from the axis to an outlet's end [mm]
  int outlets, sides;
  TubeEnds ends;
  double bore;
};

void add_header(const FeedBox& box, const Header& h, TriMesh& mesh, std::vector<Outlet>& outlets) {
  const Vec3 across(0, 0.5 * box.inner_width, 0), direction = h.direction.normalized();
  mesh.append(
      make_tube(h.part, {(h.at - across) * mm, (h.at + across) * mm, h.radius * mm, 16, TubeEnds::capped}));
  const double pitch = box.inner_width / h.outlets;
  for (int k = 0; k < h.outlets; ++k) {
    const Vec3 foot = h.at + Vec3(0, (k + 0.5) * pitch - 0.5 * box.inner_width, 0);
    const Vec3 end = foot + h.length * direction;
    constexpr double clearance = 5;  // the weld: header and stub do not cut each other
    mesh.append(make_tube(h.part, {(foot + (h.radius + clearance) * direction) * mm, end * mm,
                                   h.outlet_radius * mm, h.sides, h.ends}));
    outlets.push_back({fmt::format("{}_{:02}", h.name, k + 1), h.part, end, direction, h.bore});
  }
}

std::vector<Outlet> add_water(const FeedBox& box, TriMesh& mesh) {
  std::vector<Outlet> outlets;
  const Vec3 front_axis(box.front + 140, 0, box.belt_height + 350), down_back(-0.5, 0, -std::sqrt(0.75));
  const Vec3 back_axis(box.back - 120, 0, 3300), down_front(0.6, 0, -0.8);
  add_header(box,
             {"header_pipes", "pipe", front_axis, down_back, 110, 400, 0.5 * box.bore, box.pipes, 16,
              TubeEnds::open, box.bore},
             mesh, outlets);
  const double radius = 0.5 * box.nozzle_diameter;
  add_header(box,
             {"header_nozzles", "front_nozzle", front_axis, down_back, 60, 360, radius, box.nozzles_a_row, 8,
              TubeEnds::capped, box.nozzle_bore},
             mesh, outlets);
  add_header(box,
             {"header_nozzles", "back_nozzle", back_axis, down_front, 60, 260, radius, box.nozzles_a_row, 8,
              TubeEnds::capped, box.nozzle_bore},
             mesh, outlets);
  return outlets;
}

void write_outlets(const std::string& file, const std::vector<Outlet>& outlets) {
  std::ofstream out(file, std::ios::binary);
  out << "name,part,x_mm,y_mm,z_mm,direction_x,direction_y,direction_z,bore_mm\n";
  for (const Outlet& o : outlets)
    out << fmt::format("{},{},{:.3f},{:.3f},{:.3f},{:.9g},{:.9g},{:.9g},{:g}\n", o.name, o.variant, o.at.x(),
                       o.at.y(), o.at.z(), o.direction.x(), o.direction.y(), o.direction.z(), o.bore);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

}  // namespace
}  // namespace sluice

int main(int argc, char** argv) {
  using namespace sluice;
  if (argc != 2) {
    std::cerr << "usage: feedbox_geometry FOLDER\n";
    return 2;
  }
  try {
    const FeedBox box;
    TriMesh mesh;
    add_conveyor(box, mesh);
    add_hood(box, mesh);
    add_box(box, mesh);
    const std::vector<Outlet> outlets = add_water(box, mesh);
    merge_equal_vertices(mesh);
    const std::string folder = argv[1];
    write_obj(folder + "/feedbox.obj", mesh, mm,
              "Feed box of our own design, millimetres, z up; written by geometry/feedbox/feedbox.cpp");
    write_outlets(folder + "/outlets.csv", outlets);
    std::cout << fmt::format(
        "tips (x, z) [mm]: ledge_1 {:.0f} {:.1f}, ledge_2 {:.0f} {:.1f}, ledge_3 {:.0f} {:.1f}\n",
        box.front_tip(), box.tip_1(), box.back_tip(), box.tip_2(), box.front_tip(), box.tip_3());
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
