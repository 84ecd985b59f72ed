// Paths of points against walls: WallField::first_hit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "mpm/wall_field.h"
#include "mpm/wall_scenes.h"
#include "mpm/wall_search.h"

namespace sluice {
namespace {

using namespace wall_scenes;

TEST(WallPath, NeverMissesAWall) {
  for (const auto& [name, make] : all_scenes()) {
    SCOPED_TRACE(name);
    const Scene scene = make();
    const WallField field(scene.walls, scene.domain, origin, spacing);
    const TriMesh& mesh = scene.walls.mesh();
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 6000; ++i) {
      // Through a corner, an edge or the inside of a random triangle
      Vec3 through;
      int attempt = 0;
      do {
        const auto& t = mesh.triangles[random.next() % mesh.triangles.size()];
        Vec3 weights(random.uniform(), random.uniform(), random.uniform());
        if (i % 3 >= 1) weights[0] = 0;
        if (i % 9 == 2) weights[1] = 0;
        weights /= weights.sum();
        through.setZero();
        for (int k = 0; k < 3; ++k)
          through += weights[k] * mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
      } while (!scene.look.contains(through) && ++attempt < 500);
      const Vec3 way = random.on_sphere();
      const Vec3 a = through - random.uniform(0.01, 0.9) * spacing * way;
      const Vec3 b = through + random.uniform(0.01, i % 2 ? 0.9 : 6.0) * spacing * way;
      if (!scene.look.contains(a) || !scene.look.contains(b)) continue;
      const auto hit = field.first_hit(field.stencil(base_of(a)), a, b);
      const auto again = field.first_hit(-1, a, b);
      const Crossed want = crosses(mesh, a, b);
      if (i % 3 == 0 ? want == Crossed::yes : scene.seams_are_shared(through)) {
        ++hits;
        ASSERT_TRUE(hit) << "from " << a.transpose() << " to " << b.transpose();
        ASSERT_TRUE(again);
        EXPECT_NEAR(hit->s, again->s, 1e-9);
        EXPECT_LE((hit->point - (a + hit->s * (b - a))).norm(), 1e-9);
        EXPECT_LE(hit->normal.dot(b - a), 1e-12);
      } else if (want == Crossed::no) {
        EXPECT_FALSE(hit && again) << "from " << a.transpose() << " to " << b.transpose();
      }
    }
    EXPECT_GT(hits, 300);
  }
}

TEST(WallPath, MeetsTheNearestOfTwoWalls) {
  const Scene scene = thin_plate();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3 middle = scene.look.centre();
  const auto down =
      field.first_hit(-1, middle + Vec3(0, 0, 0.5 * spacing), middle - Vec3(0, 0, 0.5 * spacing));
  const auto up = field.first_hit(-1, middle - Vec3(0, 0, 0.5 * spacing), middle + Vec3(0, 0, 0.5 * spacing));
  ASSERT_TRUE(down && up);
  EXPECT_NEAR(down->normal[2], 1, 1e-12);
  EXPECT_NEAR(up->normal[2], -1, 1e-12);
  EXPECT_NE(down->patch, up->patch);
  EXPECT_NEAR(down->point[2] - up->point[2], 0.1 * spacing, 1e-12);
}

TEST(WallPath, FollowsAPathAcrossManyCells) {
  const Scene scene = sheet_on_nodes();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3 middle = place_of({0, 0, 0}) + Vec3(0.3, 0.1, 0) * spacing;
  const auto hit = field.first_hit(-1, middle + Vec3(0, 0, 100), middle - Vec3(0, 0, 50));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->s, 100.0 / 150.0, 1e-12);
  EXPECT_FALSE(field.first_hit(-1, middle + Vec3(0, 0, 100), middle + Vec3(0, 0, 1)));
  EXPECT_FALSE(field.first_hit(-1, middle + Vec3(0, 0, 1), Vec3::Constant(std::nan(""))));
}

/// One step of a point as the water takes it: stopped just off each wall it meets, three times at most.
Vec3 step_within_walls(const WallField& field, const Vec3& from, Vec3 v) {
  Vec3 to = from + v;
  for (int i = 0; i < 3; ++i) {
    const auto hit = field.first_hit(field.stencil(base_of(from)), from, to);
    if (!hit) return to;
    v -= std::min(0.0, v.dot(hit->normal)) * hit->normal;
    to = hit->point + 1e-4 * spacing * hit->normal + (1 - hit->s) * v;
  }
  return field.first_hit(-1, from, to) ? from : to;
}

TEST(WallPath, KeepsPointsInsideAClosedVesselForGood) {
  // A sphere of facets, turned and rounded to single precision with every triangle's corners its own, as an
  // STL has it; far from the origin. The inscribed polyhedron's planes decide who is outside.
  const double radius = 6.3 * spacing;
  const Vec3 centre(3.1, -2.2, 1.7);
  Wall wall;
  wall.mesh.part_names = {"vessel"};
  const int around = 24, up = 12;
  auto at = [&](int i, int j) {
    const double a = 2 * M_PI * (i % around) / around, b = M_PI * j / up;
    const Vec3 x(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
    const Vec3 turned = Eigen::AngleAxisd(0.4, Vec3(1, 1, 2).normalized()) * x;
    return Vec3((centre + radius * turned).cast<float>().cast<double>());
  };
  auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const int first = static_cast<int>(wall.mesh.vertices.size());
    wall.mesh.vertices.insert(wall.mesh.vertices.end(), {a, b, c});
    wall.mesh.triangles.push_back({first, first + 1, first + 2});
    wall.mesh.part.push_back(0);
  };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < up; ++j) {
      if (j > 0) add(at(i, j), at(i, j + 1), at(i + 1, j));
      if (j + 1 < up) add(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  }
  Domain domain;
  domain.box = wall.mesh.bounds().grown(spacing);
  const Walls walls({wall});
  const WallField field(walls, domain, origin, spacing);
  const TriMesh& mesh = walls.mesh();
  Random random(12);
  int stopped = 0;
  for (int p = 0; p < 200; ++p) {
    Vec3 x = centre, v = 0.3 * spacing * random.on_sphere();
    for (int step = 0; step < 300; ++step) {
      v = (0.95 * v + 0.05 * spacing * random.on_sphere() + Vec3(0, 0, -0.02 * spacing)).eval();
      if (v.norm() > 0.9 * spacing) v *= 0.9 * spacing / v.norm();
      const Vec3 next = step_within_walls(field, x, v);
      stopped += (next - x - v).norm() > 1e-12;
      x = next;
    }
    double depth = 1e300;  // below every facet's plane: the vessel is convex
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3& corner = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][0])];
      const Vec3 n = mesh.normal(static_cast<int>(t));
      depth = std::min(depth, (n.dot(centre - corner) > 0 ? n : Vec3(-n)).dot(x - corner));
    }
    ASSERT_GT(depth, 0) << "point " << p;
  }
  EXPECT_GT(stopped, 10000);
}

}  // namespace
}  // namespace sluice
