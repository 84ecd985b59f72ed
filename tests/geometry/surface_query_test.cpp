#include "geometry/surface_query.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "geometry/segment_triangle.h"
#include "geometry/shapes.h"

namespace sluice {
namespace {

const Vec3& corner(const TriMesh& mesh, std::size_t t, std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
}

Box random_box(Random& random) {
  Box box;
  for (int k = 0; k < 2; ++k) {
    const double x = random.uniform(-0.2, 1.2), y = random.uniform(-0.2, 1.2), z = random.uniform(-0.2, 1.2);
    box.include(Vec3(x, y, z));
  }
  return box;
}

TEST(SurfaceQuery, BoxFindsExactlyTheTrianglesWhoseBoxMeetsIt) {
  const TriMesh mesh = make_test_soup(2000, 0.1, 1);
  const SurfaceQuery query(mesh);
  Random random(2);
  std::vector<int> found{-7};
  for (int trial = 0; trial < 300; ++trial) {
    const Box box = random_box(random);
    query.triangles_in(box, found);
    std::vector<int> expected;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Box own;
      for (std::size_t k = 0; k < 3; ++k) own.include(corner(mesh, t, k));
      if (own.overlaps(box)) expected.push_back(static_cast<int>(t));
    }
    ASSERT_EQ(found, expected);
  }
}

TEST(SurfaceQuery, BoxThatOnlyTouchesStillFindsTheTriangle) {
  const TriMesh mesh =
      make_rectangle("r", {Vec3(0, 0, 0.1), Vec3(1, 0, 0.1), Vec3(1, 1, 0.1), Vec3(0, 1, 0.1)});
  const SurfaceQuery query(mesh);
  std::vector<int> found;
  query.triangles_in({Vec3(0.2, 0.2, 0.1), Vec3(0.2, 0.2, 0.1)}, found);
  EXPECT_EQ(found, (std::vector<int>{0, 1}));
  query.triangles_in({Vec3(0.2, 0.2, std::nextafter(0.1, 1.0)), Vec3(0.2, 0.2, 2)}, found);
  EXPECT_TRUE(found.empty());
}

TEST(SurfaceQuery, NearestEqualsTheSearchOverAll) {
  const TriMesh mesh = make_test_soup(1000, 0.05, 3);
  const SurfaceQuery query(mesh);
  Random random(4);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 x = random_box(random).lo;
    const double reach = random.uniform(0.0, 0.2);
    NearestPoint expected;
    expected.distance = reach;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 p = closest_on_triangle(x, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2));
      if ((p - x).norm() < expected.distance) expected = {static_cast<int>(t), p, (p - x).norm()};
    }
    const auto found = query.nearest(x, reach);
    ASSERT_EQ(found.has_value(), expected.triangle >= 0);
    if (!found) continue;
    ASSERT_EQ(found->triangle, expected.triangle);
    ASSERT_EQ(found->distance, expected.distance);
  }
}

TEST(SurfaceQuery, FirstHitEqualsTheSearchOverAll) {
  const TriMesh mesh = make_test_soup(1500, 0.2, 5);
  const SurfaceQuery query(mesh);
  Random random(6);
  int hits = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Box ends = random_box(random);
    const Vec3 a = ends.lo, b = a + std::pow(10.0, random.uniform(-7, 0.3)) * random.on_sphere();
    SegmentHit expected;
    expected.s = 2;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto s = segment_meets_triangle(a, b, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2));
      if (s && *s < expected.s) expected = {static_cast<int>(t), *s, a};
    }
    const auto found = query.first_hit(a, b);
    ASSERT_EQ(found.has_value(), expected.triangle >= 0) << trial;
    if (!found) continue;
    ++hits;
    ASSERT_EQ(found->triangle, expected.triangle);
    ASSERT_EQ(found->s, expected.s);
  }
  EXPECT_GT(hits, 30);
}

TEST(SurfaceQuery, NoSegmentSlipsThroughEdgesOrVertices) {
  const TriMesh mesh = make_test_sphere(3);
  const SurfaceQuery query(mesh);
  Random random(8);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &p = corner(mesh, t, k), &q = corner(mesh, t, (k + 1) % 3);
      const Vec3 from = 0.3 * random.uniform() * random.on_sphere();
      for (const Vec3& at : {p, Vec3(p + random.uniform() * (q - p)), Vec3(0.5 * (p + q))}) {
        const auto hit = query.first_hit(from, from + 1.5 * (at - from));
        ASSERT_TRUE(hit);
        ASSERT_NEAR((hit->point - at).norm(), 0, 1e-12);
        // As short as a particle's step, across the surface.
        const Vec3 d = 1e-6 * at.normalized();
        ASSERT_TRUE(query.first_hit(at - d, at + d));
      }
    }
}

TEST(SurfaceQuery, SegmentThatEndsOnTheSurfaceTouchesIt) {
  const TriMesh mesh = make_rectangle("r", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  const SurfaceQuery query(mesh);
  const auto end = query.first_hit(Vec3(0.5, 0.25, 1), Vec3(0.5, 0.25, 0));
  ASSERT_TRUE(end);
  EXPECT_EQ(end->s, 1);
  EXPECT_TRUE(query.first_hit(Vec3(0.5, 0.25, 0), Vec3(0.5, 0.25, -1)));
  EXPECT_TRUE(query.first_hit(Vec3(0.5, 0.25, 0), Vec3(0.5, 0.25, 0)));
  EXPECT_FALSE(query.first_hit(Vec3(0.5, 0.25, 1), Vec3(0.5, 0.25, 5e-324)));
  EXPECT_FALSE(query.first_hit(Vec3(1.5, 0.25, 1), Vec3(1.5, 0.25, -1)));
  // On the diagonal both triangles are touched: the lowest answers.
  EXPECT_EQ(query.first_hit(Vec3(0.5, 0.5, 1), Vec3(0.5, 0.5, -1))->triangle, 0);
}

TEST(SurfaceQuery, SegmentInThePlaneHitsWhereItEnters) {
  const TriMesh mesh = make_rectangle("r", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  const SurfaceQuery query(mesh);
  const auto hit = query.first_hit(Vec3(-1, 0.5, 0), Vec3(2, 0.5, 0));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.x(), 0, 1e-15);
  EXPECT_FALSE(query.first_hit(Vec3(-1, 1.5, 0), Vec3(2, 1.5, 0)));
  EXPECT_TRUE(query.first_hit(Vec3(-1, 1, 0), Vec3(1, -1, 0)));  // through the corner only
}

TEST(SurfaceQuery, AnswersFromFarAway) {
  const TriMesh mesh = make_test_sphere(2);
  const SurfaceQuery query(mesh);
  const auto hit = query.first_hit(Vec3(1e7, 0, 0), Vec3(-1e7, 0, 0));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.x(), 1, 1e-8);  // half a rounding of 1e7
  EXPECT_FALSE(query.first_hit(Vec3(1e7, 0, 1.001), Vec3(-1e7, 0, 1.001)));
  EXPECT_NEAR(query.nearest(Vec3(0, 1e5, 0), 2e5)->distance, 1e5 - 1, 1e-6);
}

TEST(SurfaceQuery, InsideAgreesWithTheBallAndTheBox) {
  const TriMesh ball = make_test_sphere(3),
                box = make_box("b", {Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)});
  const SurfaceQuery in_ball(ball), in_box(box);
  Random random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 x = random.uniform(0, 1.5) * random.on_sphere();
    if (x.norm() > 1 || x.norm() < 0.98) {
      ASSERT_EQ(in_ball.inside(x), x.norm() < 1);
    }
    ASSERT_EQ(in_box.inside(x), x.cwiseAbs().maxCoeff() < 0.5);
  }
  EXPECT_EQ(in_box.crossings(Vec3::Zero(), Vec3(1, 1, 1)), 1);    // out through a vertex
  EXPECT_EQ(in_box.crossings(Vec3(-2, 0, 0), Vec3(1, 0, 0)), 2);  // through two diagonals
}

TEST(SurfaceQuery, AnswersAreTheSameFromManyThreads) {
  const TriMesh mesh = make_test_soup(2000, 0.1, 11);
  const SurfaceQuery query(mesh);
  const auto ask = [&](std::size_t i) {
    Random random(13, i);
    const Box box = random_box(random);
    std::vector<int> found;
    query.triangles_in(box, found);
    const auto hit = query.first_hit(box.lo, box.hi);
    return std::pair(found, hit ? hit->triangle : -1);
  };
  std::vector<std::pair<std::vector<int>, int>> together(2000);
  const int before = thread_count();
  set_thread_count(3);
  parallel_for(
      together.size(), [&](std::size_t i) { together[i] = ask(i); }, 16);
  set_thread_count(before);
  for (std::size_t i = 0; i < together.size(); ++i) ASSERT_EQ(together[i], ask(i));
}

TEST(SurfaceQuery, EmptyMeshAnswersNothing) {
  const SurfaceQuery query{TriMesh{}};
  std::vector<int> found{1};
  query.triangles_in({Vec3::Zero(), Vec3::Ones()}, found);
  EXPECT_TRUE(found.empty());
  EXPECT_FALSE(query.nearest(Vec3::Zero(), 1));
  EXPECT_FALSE(query.first_hit(Vec3::Zero(), Vec3::Ones()));
  EXPECT_FALSE(query.inside(Vec3::Zero()));
}

TEST(SurfaceQuery, TrianglesWithoutAreaHideNothing) {
  TriMesh mesh = make_rectangle("r", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  mesh.triangles.insert(mesh.triangles.begin(), {{0, 0, 0}, {0, 0, 2}});
  mesh.part.assign(4, 0);
  const SurfaceQuery query(mesh);
  EXPECT_EQ(query.first_hit(Vec3(0.5, 0.25, 1), Vec3(0.5, 0.25, -1))->triangle, 2);
  EXPECT_DOUBLE_EQ(query.nearest(Vec3(0.5, 0.25, 0.125), 1)->distance, 0.125);
}

}  // namespace
}  // namespace sluice
