// A mesh wall is the plane that it triangulates, over any triangulation of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dem/dem_scenes.h"

namespace sluice {
namespace {

using namespace test;

constexpr double size = 0.02;

/// How a rock meets the plane z = 0.
struct Meeting {
  const char* name;
  RockShape shape;
  double friction;
  NewRock rock;
  double seconds;
};

NewRock falling(const Vec3& v, const Vec3& w, double height) {
  NewRock rock{.x = {0.013, -0.007, height}, .v = v, .w = w, .size = size};
  rock.q = Quat(0.7, 0.3, -0.5, 0.2).normalized();
  return rock;
}

std::vector<Meeting> meetings() {
  const RockShape block = make_superquadric(1.4, 0.8, 4), cube = make_superquadric(1, 1, 8);
  return {{"sphere rebounds", make_sphere(), 0.4, falling({0.5, 0.2, -2}, {30, -20, 10}, 0.0102), 0.004},
          {"sphere slides", make_sphere(), 0.2, falling({1, 0.3, 0}, Vec3::Zero(), 0.00999), 0.05},
          {"sphere rolls", make_sphere(), 0.6, falling({0.5, 0.1, 0}, {-10, 50, 0}, 0.00999), 0.1},
          {"block rebounds", block, 0.4, falling({0.5, 0.2, -2}, {30, -20, 10}, 0.016), 0.004},
          {"cube rebounds", cube, 0.4, falling({0.5, 0.2, -2}, {30, -20, 10}, 0.018), 0.004}};
}

struct End {
  Vec3 x, v, w;
  std::size_t most_contacts = 0, steps_in_contact = 0;
};

/// The meeting with the whole scene turned; the end is turned back.
End end_of(const Meeting& meeting, const Wall& wall, const Quat& turned) {
  DemScene scene = scene_of({0.5, meeting.friction, 0}, size, {meeting.shape});
  scene.gravity = turned * Vec3(0, 0, -9.81);
  const Walls walls = walls_of(wall);
  DemSystem dem({}, scene, walls);
  NewRock rock = meeting.rock;
  rock.x = turned * rock.x;
  rock.v = turned * rock.v;
  rock.w = turned * rock.w;
  rock.q = turned * rock.q;
  dem.add(rock);
  End end;
  const double dt = dem.step_size();
  const int steps = static_cast<int>(meeting.seconds / dt);
  for (int k = 0; k < steps; ++k) {
    dem.step(k * dt, dt);
    end.most_contacts = std::max(end.most_contacts, dem.contact_count());
    end.steps_in_contact += dem.contact_count() > 0 ? 1 : 0;
  }
  const Quat back = turned.conjugate();
  end.x = back * dem.rocks().x[0];
  end.v = back * dem.rocks().v[0];
  end.w = back * dem.rocks().w[0];
  return end;
}

void expect_alike(const End& a, const End& b, double tolerance, const std::string& what) {
  EXPECT_LT((a.x - b.x).norm(), tolerance * size) << what;
  EXPECT_LT((a.v - b.v).norm(), tolerance * b.v.norm() + tolerance) << what;
  EXPECT_LT((a.w - b.w).norm(), tolerance * b.w.norm() + tolerance * b.v.norm() / size) << what;
  EXPECT_EQ(a.most_contacts, 1u) << what;
  EXPECT_EQ(a.steps_in_contact, b.steps_in_contact) << what;
}

const Quat tilt = Quat(0.9, 0.2, -0.3, 0.25).normalized();

TEST(MeshWall, IsThePlaneOverAnyTriangulation) {
  for (const Meeting& meeting : meetings())
    for (const Quat& turned : {Quat(Quat::Identity()), tilt}) {
      const End plane = end_of(meeting, plane_wall(1, 1, turned), turned);
      EXPECT_GT(plane.steps_in_contact, 20u) << meeting.name;
      for (const int squares : {7, 40, 150})
        expect_alike(end_of(meeting, plane_wall(1, squares, turned), turned), plane, 1e-9,
                     fmt::format("{}, {} squares", meeting.name, squares));
    }
}

TEST(MeshWall, IsThePlaneToTheRoundingOfAFloatStl) {
  // Corners within 0.1 m are rounded by up to 3.7e-9 m: 1.9e-7 of the rock.
  constexpr double half_width = 0.1;
  for (const Meeting& meeting : meetings()) {
    const End plane = end_of(meeting, plane_wall(half_width, 1, tilt), tilt);
    for (const int squares : {7, 20}) {
      Wall wall = plane_wall(half_width, squares, tilt);
      for (Vec3& x : wall.mesh.vertices) x = x.cast<float>().cast<double>();
      const End mesh = end_of(meeting, wall, tilt);
      EXPECT_LT((mesh.x - plane.x).norm(), 1e-6 * size) << meeting.name << ", " << squares << " squares";
      EXPECT_EQ(mesh.most_contacts, 1u) << meeting.name;
    }
  }
}

}  // namespace
}  // namespace sluice
