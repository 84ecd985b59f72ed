// What of the walls a rock need not look at.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/random.h"
#include "dem/dem_scenes.h"
#include "dem/wall_contact.h"

namespace sluice {
namespace {

using namespace test;

/// A floor with a step: faces that meet in a ridge and in a valley, and free edges all around.
Wall stairs() {
  Wall wall;
  wall.name = "stairs";
  wall.material = 1;
  wall.mesh.part_names = {"stairs"};
  const double profile[4][2] = {{-0.1, 0}, {0, 0}, {0.01, 0.04}, {0.1, 0.045}};
  for (const auto& [x, z] : profile)
    for (const double y : {-0.08, 0.08}) wall.mesh.vertices.push_back({x, y, z});
  for (int i = 0; i < 6; i += 2) {
    wall.mesh.triangles.push_back({i, i + 1, i + 2});
    wall.mesh.triangles.push_back({i + 1, i + 3, i + 2});
    wall.mesh.part.insert(wall.mesh.part.end(), {0, 0});
  }
  return wall;
}

struct Rambler {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();

  /// Goes on for a step, into another direction at times.
  void go_on(Random& random, double size) {
    if (random.uniform() < 0.02) {
      v = 2e-3 * size * random.on_sphere() - 1e-3 * size * x / 0.1;
      w = 5e-3 * random.uniform() * random.on_sphere();
    }
    x += v;
    const double angle = w.norm();
    if (angle > 0) q = Quat(Eigen::AngleAxisd(angle, w / angle)) * q;
  }
};

bool same(const WallTouch& a, const WallTouch& b) {
  return a.patch == b.patch && a.feature == b.feature && a.side == b.side && a.overlap == b.overlap &&
         a.normal == b.normal && a.point == b.point && a.start == b.start;
}

struct Shape {
  Vec3 semi_axes;
  double m;
};

TEST(WallParts, LeftOutAreNeverOnesThatARockTouches) {
  const Walls walls = walls_of(stairs());
  const WallSurface surface(walls);
  constexpr double size = 0.03;
  Random random(11);
  std::size_t asked = 0, all = 0, touched = 0, quiet = 0;
  for (const Shape& shape :
       {Shape{{0.015, 0.012, 0.01}, 2}, Shape{{0.02, 0.01, 0.008}, 3.5}, Shape{{0.015, 0.015, 0.015}, 8}}) {
    const double radius = shape.semi_axes.norm(), deepest = 0.25 * shape.semi_axes.minCoeff();
    Rambler rock{.x = {0, 0, 0.06}, .q = random.rotation()};
    WallParts kept;
    kept.triangles.resize(surface.triangles().size());
    std::iota(kept.triangles.begin(), kept.triangles.end(), 0);
    kept.list(surface);
    std::vector<WallTouch> before;
    for (int step = 0; step < 20000; ++step) {
      rock.go_on(random, size);
      const Superquadric body{rock.x, rock.q, shape.semi_axes, shape.m};
      WallScratch looked, fresh;
      kept.follow(rock.x, rock.q, radius, true);
      const bool is_quiet = kept.quiet();
      kept.begin_search(1);
      for (std::size_t part = 0; part < kept.count(); ++part) asked += kept.is_clear(0, part) ? 0 : 1;
      find_superquadric_contacts(surface, kept, 0, body, radius, deepest, before, looked);
      kept.end_search();

      WallParts whole;
      whole.triangles = kept.triangles;
      whole.list(surface);
      whole.follow(rock.x, rock.q, radius, true);
      whole.begin_search(1);
      find_superquadric_contacts(surface, whole, 0, body, radius, deepest, before, fresh);

      ASSERT_EQ(looked.found.size(), fresh.found.size()) << "step " << step;
      for (std::size_t k = 0; k < fresh.found.size(); ++k)
        ASSERT_TRUE(same(looked.found[k], fresh.found[k])) << "step " << step;
      ASSERT_FALSE(is_quiet && !fresh.found.empty());
      all += kept.count();
      touched += fresh.found.empty() ? 0 : 1;
      quiet += is_quiet ? 1 : 0;
      before = fresh.found;
    }
  }
  EXPECT_GT(touched, 2000u);
  EXPECT_GT(quiet, 1000u);
  EXPECT_LT(asked, all / 5);
}

TEST(WallParts, TravelIsAtLeastWhatAnyPointOfTheRockHasMoved) {
  Random random(12);
  constexpr double radius = 0.02;
  for (int trial = 0; trial < 200; ++trial) {
    const double step = std::pow(10.0, random.uniform(-8, 0.3));  // of the radius, or an angle
    const Vec3 body = radius * random.on_sphere();
    Vec3 x = random.on_sphere();
    Quat q = random.rotation();
    WallParts parts;
    parts.follow(x, q, radius, true);
    for (int n = 0; n < 20; ++n) {
      const Vec3 was = x + q * body;
      x += random.uniform() * step * radius * random.on_sphere();
      q = Quat(Eigen::AngleAxisd(random.uniform() * step, random.on_sphere())) * q;
      WallParts near = parts;
      parts.follow(x, q, radius, true);
      // A gap of what this step moved the point, from before the step on: used up by it.
      near.set_least_gap((x + q * body - was).norm(), radius);
      near.follow(x, q, radius, true);
      EXPECT_FALSE(near.quiet());
    }
  }
}

TEST(WallParts, OfASphereCountNoTurning) {
  WallParts parts;
  parts.follow(Vec3::Zero(), Quat::Identity(), 0.01, false);
  parts.set_least_gap(1e-3, 0.01);
  parts.follow(Vec3(5e-4, 0, 0), Quat(0, 0, 1, 0), 0.01, false);
  EXPECT_TRUE(parts.quiet());
  parts.follow(Vec3(0, 0, 1e-3), Quat(0, 0, 1, 0), 0.01, false);
  EXPECT_FALSE(parts.quiet());
}

}  // namespace
}  // namespace sluice
