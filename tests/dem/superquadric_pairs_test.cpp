#include "dem/superquadric_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "dem/rock_shape.h"

namespace sluice {
namespace {

/// Pairs near touch: 2k and 2k+1 are a pair, with gaps to 0.05 and overlaps to 0.1 of the least semi-axis.
struct Scene {
  std::vector<Superquadric> bodies;
  std::vector<BodyPair> pairs;
  std::vector<PairMemory> memory;
  std::vector<ContactGeometry> geometry;
  std::vector<PairOutcome> outcome;

  void refresh() {
    for (BodyPair& pair : pairs) pair.d = bodies[pair.b].x - bodies[pair.a].x;
  }
  std::vector<TurnedShape> turned() const {
    std::vector<TurnedShape> all;
    for (const Superquadric& body : bodies) all.push_back({body.q, body.semi_axes, body.m});
    return all;
  }
  /// Where the pairs touch, in space.
  Vec3 point(std::size_t k) const { return bodies[pairs[k].a].x + geometry[k].point; }
  void solve() { superquadric_pairs(turned(), pairs, memory, geometry, outcome); }
};

Scene make_scene(std::size_t count, std::initializer_list<double> blockiness) {
  Scene scene;
  Random random(11);
  for (std::size_t k = 0; k < count; ++k) {
    const auto body = [&] {
      const double b = random.uniform(0.01, 0.03);
      const auto kind = static_cast<std::ptrdiff_t>(random.next() % blockiness.size());
      return Superquadric{random.on_sphere(), random.rotation(),
                          Vec3(b * random.uniform(1, 2), b, b / random.uniform(1, 2)),
                          blockiness.begin()[kind]};
    };
    const Superquadric a = body();
    Superquadric b = body();
    const double least = std::min(a.semi_axes.minCoeff(), b.semi_axes.minCoeff());
    const Vec3 n = random.on_sphere();
    b.x = a.x + a.q * support_point(a.semi_axes, a.m, a.q.conjugate() * n) -
          b.q * support_point(b.semi_axes, b.m, b.q.conjugate() * -n) -
          least * random.uniform(-0.05, 0.1) * n;
    scene.pairs.push_back({b.x - a.x, static_cast<std::uint32_t>(2 * k),
                           static_cast<std::uint32_t>(2 * k + 1), static_cast<std::uint32_t>(k)});
    scene.bodies.push_back(a);
    scene.bodies.push_back(b);
  }
  scene.memory.resize(count);
  scene.geometry.resize(count);
  scene.outcome.resize(count);
  return scene;
}

void jiggle(Scene& scene, Random& random, double by) {
  for (Superquadric& body : scene.bodies) {
    body.x += by * body.semi_axes.y() * random.on_sphere();
    body.q = (body.q * Quat(Eigen::AngleAxisd(by, random.on_sphere()))).normalized();
  }
  scene.refresh();
}

void expect_same_as_one_by_one(std::initializer_list<double> blockiness) {
  Scene scene = make_scene(1003, blockiness);
  std::vector<PairMemory> alone(scene.pairs.size());
  Random random(12);
  int touching = 0;
  for (int step = 0; step < 12; ++step) {
    scene.solve();
    for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
      ContactGeometry one;
      const PairOutcome outcome =
          superquadric_pair(scene.bodies[2 * k], scene.bodies[2 * k + 1], alone[k], one);
      ASSERT_NE(scene.outcome[k], PairOutcome::unresolved);
      if (outcome == PairOutcome::separated || scene.outcome[k] == PairOutcome::separated) {
        if (outcome != scene.outcome[k]) {
          EXPECT_LT(std::fabs(one.overlap), 1e-12);
        }
        continue;
      }
      ++touching;
      const ContactGeometry& many = scene.geometry[k];
      // Points and normals to the tolerance of the last step, the overlap to its square.
      EXPECT_NEAR(many.overlap, one.overlap, 1e-11);
      EXPECT_LT((many.normal - one.normal).norm(), 1e-6);
      EXPECT_LT((scene.point(k) - one.point).norm(), 1e-7);
    }
    jiggle(scene, random, 3e-4);
  }
  EXPECT_GT(touching, 6000);
}

TEST(SuperquadricPairsAtATime, AgreeWithOneAtATimeForWholeBlockiness) {
  expect_same_as_one_by_one({2, 3, 4, 6, 8});
}

TEST(SuperquadricPairsAtATime, AgreeWithOneAtATimeForAnyBlockiness) {
  expect_same_as_one_by_one({2, 2.5, 3.7, 8});
}

TEST(SuperquadricPairsAtATime, GiveBitsThatDoNotDependOnTheNeighboursInTheList) {
  Scene together = make_scene(300, {2, 4, 8});
  Scene apart = together;
  Random random(5), same(5);
  for (int step = 0; step < 5; ++step) {
    together.solve();
    for (std::size_t k = apart.pairs.size(); k-- > 0;)
      superquadric_pairs(apart.turned(), std::span(&apart.pairs[k], 1), apart.memory,
                         std::span(&apart.geometry[k], 1), std::span(&apart.outcome[k], 1));
    for (std::size_t k = 0; k < apart.pairs.size(); ++k) {
      EXPECT_EQ(together.outcome[k], apart.outcome[k]);
      EXPECT_EQ(together.geometry[k].overlap, apart.geometry[k].overlap);
      EXPECT_EQ(together.geometry[k].normal, apart.geometry[k].normal);
      EXPECT_EQ(together.geometry[k].point, apart.geometry[k].point);
    }
    jiggle(together, random, 1e-3);
    jiggle(apart, same, 1e-3);
  }
}

TEST(SuperquadricPairsAtATime, TakeTheNearestImageFromTheDistanceGiven) {
  Scene scene = make_scene(20, {4});
  scene.solve();
  const Scene near = scene;
  for (std::size_t k = 0; k < scene.pairs.size(); ++k) scene.bodies[2 * k + 1].x += Vec3(7, 0, 0);
  scene.memory.assign(scene.memory.size(), {});
  for (int step = 0; step < 2; ++step) {
    scene.solve();
    for (std::size_t k = 0; k < scene.pairs.size(); ++k) {
      ASSERT_EQ(scene.outcome[k], near.outcome[k]);
      EXPECT_NEAR(scene.geometry[k].overlap, near.geometry[k].overlap, 1e-12);
      EXPECT_LT((scene.geometry[k].point - near.geometry[k].point).norm(), 1e-8);
    }
  }
}

}  // namespace
}  // namespace sluice
