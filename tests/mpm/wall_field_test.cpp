#include "mpm/wall_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/random.h"
#include "mpm/wall_scenes.h"
#include "mpm/wall_search.h"

namespace sluice {
namespace {

using namespace wall_scenes;

struct Count {
  int hidden = 0, seen = 0, unclear = 0;
};

/// Compares visibility() with the search over all triangles for random points of a scene.
Count compare_with_search(const Scene& scene, int points, std::uint64_t seed) {
  const WallField field(scene.walls, scene.domain, origin, spacing);
  Random random(seed);
  Count count;
  for (int i = 0; i < points; ++i) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = random.uniform(scene.look.lo[k], scene.look.hi[k]);
    const Vec3i base = base_of(x);
    const int stencil = field.stencil(base);
    Visibility v;
    if (stencil >= 0) field.visibility(stencil, base, x, v);
    for (int n = 0; n < 27; ++n) {
      const Vec3i node = base + Vec3i(n % 3, n / 3 % 3, n / 9);
      const Crossed want = crosses(scene.walls.mesh(), x, place_of(node) + spacing * node_offset);
      const bool hidden = v.hidden >> n & 1;
      if (want == Crossed::unclear) {
        ++count.unclear;
        continue;
      }
      (hidden ? count.hidden : count.seen) += 1;
      if (hidden != (want == Crossed::yes)) {
        ADD_FAILURE() << "point " << x.transpose() << " node " << node.transpose() << " hidden " << hidden;
        return count;
      }
      if (hidden) {
        EXPECT_GE(v.patch[static_cast<std::size_t>(n)], 0);
      }
    }
  }
  return count;
}

TEST(Visibility, AgreesWithASearchOverAllTriangles) {
  for (const auto& [name, make] : all_scenes()) {
    SCOPED_TRACE(name);
    const Count count = compare_with_search(make(), 4000, 11);
    EXPECT_GT(count.hidden, 1000);
    EXPECT_GT(count.seen, 1000);
    EXPECT_LT(count.unclear, 2000);
  }
}

TEST(Visibility, NamesThePatchThatHidesFirst) {
  const Scene scene = thin_plate();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3 above = scene.look.centre() + Vec3(0, 0, 0.4 * spacing);
  const Vec3i base = base_of(above);
  Visibility v;
  field.visibility(field.stencil(base), base, above, v);
  ASSERT_NE(v.hidden, 0u);
  for (std::size_t n = 0; n < 27; ++n) {
    if (!(v.hidden >> n & 1)) continue;
    const auto hit = field.first_hit(-1, above, place_of(base + Vec3i(n % 3, n / 3 % 3, n / 9)));
    ASSERT_TRUE(hit);
    EXPECT_EQ(v.patch[n], hit->patch);
  }
}

TEST(Visibility, GivesANodeOnAWallToOneSideOnly) {
  // A wall that follows the grid: every node is seen from above or from below, none from both
  const Scene scene = sheet_on_nodes();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3 middle = place_of({0, 0, 0});
  for (double off : {1e-4, 0.2, 0.49}) {
    const Vec3 above = middle + Vec3(0.1, 0.2, off) * spacing,
               below = middle + Vec3(0.1, 0.2, -off) * spacing;
    const Vec3i base = base_of(above);
    ASSERT_EQ(base, base_of(below));
    Visibility from_above, from_below;
    field.visibility(field.stencil(base), base, above, from_above);
    field.visibility(field.stencil(base), base, below, from_below);
    EXPECT_EQ(from_above.hidden ^ from_below.hidden, (1u << 27) - 1);
    EXPECT_EQ(from_above.hidden, (1u << 9) - 1);  // the lowest of three layers
  }
}

TEST(Visibility, HasNoRecordWhereNoWallIsNear) {
  const Scene scene = sheet_on_nodes();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  EXPECT_EQ(field.stencil({0, 0, 5}), -1);
  EXPECT_EQ(field.stencil({0, 0, -8}), -1);
  EXPECT_EQ(field.stencil({1000000, 0, 0}), -1);
  EXPECT_GE(field.stencil({0, 0, -1}), 0);
  EXPECT_EQ(field.planes_of_node({0, 0, 6}).size(), 0u);
  EXPECT_EQ(field.open_fraction({0, 0, 6}), 1.0);
}

TEST(Visibility, IgnoresWallsForRocksOnly) {
  Wall wall;
  wall.mesh = make_rectangle("deck", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  wall.blocks = BlocksPhase::rocks_only;
  Domain domain;
  domain.box = {Vec3(0, 0, -1), Vec3(1, 1, 1)};
  const Walls walls({wall});
  const WallField field(walls, domain, Vec3::Zero(), 0.1);
  EXPECT_EQ(field.patch_count(), 0);
  EXPECT_EQ(field.stencil({4, 4, -1}), -1);
  EXPECT_FALSE(field.first_hit(-1, {0.5, 0.5, 0.1}, {0.5, 0.5, -0.1}));
}

TEST(Patches, MergeCoplanarTrianglesWithSinglePrecisionNoise) {
  Random random(3);
  Wall wall;
  const int n = 12;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      std::array<Vec3, 4> c{Vec3(i, j, 0), Vec3(i + 1, j, 0), Vec3(i + 1, j + 1, 0), Vec3(i, j + 1, 0)};
      for (Vec3& x : c) {  // as an STL would hold it: shared corners repeated, single precision
        x = Quat(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized())) * (x / n * 2.0) + Vec3(0.7, 0.2, 0.1);
        x = x.cast<float>().cast<double>();
      }
      wall.mesh.append(make_rectangle("sheet", c));
    }
  }
  Domain domain;
  domain.box = wall.mesh.bounds().grown(0.2);
  const Walls walls({wall});
  EXPECT_EQ(WallField(walls, domain, origin, 0.04).patch_count(), 1);
}

TEST(Patches, StayApartForDifferentWalls) {
  std::vector<Wall> walls(2);
  walls[0].mesh = make_rectangle("left", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
  walls[1].mesh = make_rectangle("right", {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(1, 1, 0)});
  Domain domain;
  domain.box = {Vec3(0, 0, -1), Vec3(2, 1, 1)};
  const Walls both(std::move(walls));
  const WallField field(both, domain, origin, 0.1);
  ASSERT_EQ(field.patch_count(), 2);
  EXPECT_NE(field.patch_wall(0), field.patch_wall(1));
}

TEST(NodePlanes, AreThreeInACornerOfABox) {
  const Scene scene = corner_box();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3i corner(0, 0, 0);
  const auto planes = field.planes_of_node(corner);
  ASSERT_EQ(planes.size(), 3u);
  const Vec3 inside = place_of(corner) - scene.corner;
  Vec3 sum = Vec3::Zero();
  for (const WallPlane& p : planes) {
    sum += p.normal;
    EXPECT_NEAR(p.distance, std::abs(p.normal.dot(inside)), 1e-12);
  }
  EXPECT_NEAR((sum + Vec3::Ones()).norm(), 0, 1e-12);
}

TEST(NodePlanes, EndAtALip) {
  const Scene scene = lip();  // sheet x < corner x, at its height; free beyond
  const WallField field(scene.walls, scene.domain, origin, spacing);
  int before = 0;
  for (int i = -6; i <= 6; ++i) {
    for (int k = -1; k <= 2; ++k) {
      const Vec3i node = base_of(scene.corner) + Vec3i(i, 0, k);
      const Vec3 x = place_of(node);
      const auto planes = field.planes_of_node(node);
      const bool over_sheet = x[0] + 1e-3 * spacing < scene.corner[0];
      const bool near = std::abs(x[2] + node_offset[2] * spacing - scene.corner[2]) < 1.5 * spacing;
      EXPECT_EQ(planes.size(), over_sheet && near ? 1u : 0u) << x.transpose();
      before += static_cast<int>(planes.size());
    }
  }
  EXPECT_GT(before, 5);
}

TEST(NodePlanes, EndAtTheSquareEdgeOfASolid) {
  // Beyond the rim of a plate neither its faces nor, above and below the rim, the rim itself
  const Scene scene = plate_rim();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  for (int i = 1; i <= 3; ++i) {
    for (int k = -1; k <= 2; ++k) {
      const Vec3i node = base_of(scene.corner + Vec3::Constant(0.5 * spacing)) + Vec3i(i, 0, k);
      ASSERT_GT(place_of(node)[0], scene.corner[0]);
      ASSERT_GT(std::abs(place_of(node)[2] - scene.corner[2]), 0.06 * spacing);
      EXPECT_EQ(field.planes_of_node(node).size(), 0u) << place_of(node).transpose();
    }
  }
}

TEST(NodePlanes, PointAwayFromTheOwnSideOfAThinPlate) {
  const Scene scene = thin_plate();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3i node = base_of(scene.look.centre()) + Vec3i::Ones();
  for (int k = -1; k <= 1; ++k) {
    const Vec3i at = node + Vec3i(0, 0, k);
    const double up = place_of(at)[2] - scene.look.centre()[2];
    if (std::abs(up) > 1.4 * spacing || std::abs(up) < 0.06 * spacing) continue;
    const auto planes = field.planes_of_node(at);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(planes[0].normal[2], up > 0 ? -1 : 1, 1e-12);
    EXPECT_NEAR(planes[0].distance, std::abs(up) - 0.05 * spacing, 1e-9);
  }
}

TEST(NodePlanes, MergeFacetsOfACurvedFloor) {
  const Scene scene = curved_floor();
  const WallField field(scene.walls, scene.domain, origin, spacing);
  Random random(8);
  int with_plane = 0;
  for (int i = 0; i < 2000; ++i) {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = random.uniform(scene.look.lo[k], scene.look.hi[k]);
    const auto nearest = scene.walls.query().nearest(x, 1.3 * spacing);
    const int stencil = field.stencil(base_of(x));
    if (!nearest || stencil < 0) continue;
    std::array<WallPlane, 8> planes;
    const int count = field.planes_of_point(stencil, x, planes.data(), 8);
    ASSERT_EQ(count, 1) << x.transpose();
    const Vec3 towards = (nearest->point - x).normalized();
    EXPECT_GT(planes[0].normal.dot(towards), 0.97);
    EXPECT_NEAR(planes[0].distance, nearest->distance, 0.03 * spacing);
    ++with_plane;
  }
  EXPECT_GT(with_plane, 300);
}

TEST(PointPlanes, StopAtAWallBetween) {
  const Scene scene = two_sheets();  // parallel, one cell apart
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3 x = scene.corner + Vec3(0, 0, 0.3 * spacing);  // above both
  std::array<WallPlane, 4> planes;
  const int count = field.planes_of_point(field.stencil(base_of(x)), x, planes.data(), 4);
  ASSERT_EQ(count, 1);
  EXPECT_NEAR(planes[0].distance, 0.3 * spacing, 1e-9);
  const Vec3 between = scene.corner - Vec3(0, 0, 0.3 * spacing);
  ASSERT_EQ(field.planes_of_point(field.stencil(base_of(between)), between, planes.data(), 4), 2);
  EXPECT_NEAR(planes[0].distance, 0.3 * spacing, 1e-9);
  EXPECT_NEAR(planes[1].distance, 0.7 * spacing, 1e-9);
  EXPECT_NEAR(planes[0].normal.dot(planes[1].normal), -1, 1e-9);
  EXPECT_EQ(field.planes_of_point(field.stencil(base_of(between)), between, planes.data(), 1), 1);
}

/// Share of a quadratic B-spline on the near side of a plane across an axis, at distance d [h].
double share_before(double d) {
  if (d >= 1.5) return 1;
  const double beyond = d < 0.5 ? 0.5 - 0.75 * d + d * d * d / 3 : std::pow(1.5 - d, 3) / 6;
  return 1 - beyond;
}

TEST(OpenFraction, FollowsTheSplineBesideAPlane) {
  for (double shift : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9}) {
    Scene scene = sheet_at(shift);  // shift h below node layer 1
    const WallField field(scene.walls, scene.domain, origin, spacing);
    for (int k = 1; k <= 3; ++k) {
      const double d = k - 1 + shift;
      EXPECT_NEAR(field.open_fraction({0, 0, k}), share_before(d), 0.003) << shift << ' ' << k;
    }
    for (int k = 0; k >= -2 && shift > 0.01; --k)
      EXPECT_NEAR(field.open_fraction({0, 0, k}), share_before(1 - k - shift), 0.003) << shift << ' ' << k;
  }
}

TEST(OpenFraction, IsAQuarterAndAnEighthInCorners) {
  const Scene scene = corner_box();  // its corner lies on a node
  const WallField field(scene.walls, scene.domain, origin, spacing);
  const Vec3i corner(0, 0, 0);
  EXPECT_NEAR(field.open_fraction(corner), 0.125, 0.006);
  EXPECT_NEAR(field.open_fraction(corner + Vec3i(4, 0, 0)), 0.25, 0.006);
  EXPECT_NEAR(field.open_fraction(corner + Vec3i(4, 4, 0)), 0.5, 0.006);
  EXPECT_EQ(field.open_fraction(corner + Vec3i(4, 4, 4)), 1.0);
}

TEST(OpenFraction, IsHalfOnATiltedPlaneAndSumsOverBothSides) {
  for (double degrees : {17.0, 45.0}) {
    const Scene scene = tilted_sheet(degrees);
    const WallField field(scene.walls, scene.domain, origin, spacing);
    const Vec3 n = Vec3(-std::sin(degrees * M_PI / 180), 0, std::cos(degrees * M_PI / 180));
    Random random(4);
    for (int i = 0; i < 300; ++i) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = random.uniform(scene.look.lo[k], scene.look.hi[k]);
      const Vec3i node = base_of(x);
      const double d = n.dot(place_of(node) - scene.corner) / spacing;
      const double f = field.open_fraction(node);
      EXPECT_GE(f, 0.49);
      // A tilted kernel is a little wider: compare loosely, and exactly far away
      if (std::abs(d) < 0.02) {
        EXPECT_NEAR(f, 0.5, 0.03);
      }
      if (std::abs(d) > 2.2) {
        EXPECT_EQ(f, 1.0);
      }
      if (std::abs(d) > 0.3 && std::abs(d) < 1.2) {
        EXPECT_NEAR(f, share_before(std::abs(d)), 0.03);
      }
    }
  }
}

TEST(PeriodicFaces, ShowTheImagesOfWalls) {
  // A sheet across the whole period has no edge at the periodic faces, and one that ends there goes on
  Wall wall;
  wall.mesh = make_rectangle("floor", {Vec3(0, 0, 0.1), Vec3(1, 0, 0.1), Vec3(1, 1, 0.1), Vec3(0, 1, 0.1)});
  Domain domain;
  domain.box = {Vec3(0, 0, 0), Vec3(1, 1, 1)};
  for (int k = 0; k < 2; ++k) domain.low[k] = domain.high[k] = Face::periodic;
  const Walls walls({wall});
  const WallField field(walls, domain, Vec3::Zero(), 0.1);
  EXPECT_EQ(field.patch_count(), 1);
  const Vec3 x(0.99, 0.01, 0.13);
  const auto hit = field.first_hit(-1, x, {1.08, -0.05, 0.07});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->wall, 0);
  EXPECT_EQ(field.planes_of_node({11, -1, 2}).size(), 1u);
  EXPECT_EQ(field.open_fraction({10, 0, 2}), field.open_fraction({5, 5, 2}));
}

TEST(WallFieldSetUp, DoesNotDependOnTheNumberOfThreads) {
  const Scene scene = corner_box();
  const int threads = thread_count();
  auto all = [&] {
    const WallField field(scene.walls, scene.domain, origin, spacing);
    std::vector<double> values;
    for (int i = -12; i < 12; ++i)
      for (int j = -12; j < 12; ++j)
        for (int k = -12; k < 12; ++k) {
          values.push_back(field.open_fraction({i, j, k}));
          values.push_back(field.stencil({i, j, k}));
          for (const WallPlane& p : field.planes_of_node({i, j, k})) values.push_back(p.distance + p.patch);
        }
    return values;
  };
  set_thread_count(1);
  const auto one = all();
  set_thread_count(3);
  const auto three = all();
  set_thread_count(threads);
  EXPECT_EQ(one, three);
}

TEST(WallFieldSetUp, TakesASceneWithoutWalls) {
  const Walls walls;
  Domain domain;
  domain.box = {Vec3::Zero(), Vec3::Ones()};
  const WallField field(walls, domain, Vec3::Zero(), 0.1);
  EXPECT_EQ(field.stencil({0, 0, 0}), -1);
  EXPECT_EQ(field.open_fraction({0, 0, 0}), 1.0);
  EXPECT_FALSE(field.first_hit(-1, Vec3::Zero(), Vec3::Ones()));
}

}  // namespace
}  // namespace sluice
