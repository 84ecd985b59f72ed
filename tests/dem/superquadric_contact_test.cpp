#include "dem/superquadric_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "dem/rock_shape.h"

namespace sluice {
namespace {

// Common-normal distance of axes (1, .8, .6) turned by q1 at the origin and axes (.7, .5, .9) turned by q2 at
// c; every line of reference-data/derived/superquadric_pair_distance.csv (dual and primal agree to 4e-31).
struct PairRow {
  double m, q1[4], q2[4], c[3], distance, n[3], p1[3], p2[3];
};
constexpr PairRow kPairs[] = {
    {2,
     {1, 0, 0, 0},
     {1, 0.3, 0.2, 0.1},
     {2.8222, 0.5644, 0.8466},
     1.301218373794,
     {0.9026439538469, 0.2878433711987, 0.3199688832379},
     {0.9490221171155, 0.1936850333909, 0.1211072388481},
     {2.123559014855, 0.5682321167694, 0.5374566287596}},
    {2,
     {0.9, 0.1, 0.4, 0.2},
     {1, 1, 0.2, 0.1},
     {-1.2632, 1.0106, 2.5265},
     1.505657646473,
     {-0.2976248147881, 0.303268366186, 0.9052335431772},
     {-0.4742786731909, 0.1089943902682, 0.7669375650585},
     {-0.9223997513567, 0.5656127247496, 2.129909371187}},
    {2,
     {1, 0.5, -0.2, 0.4},
     {0.2, 1, 0.3, -0.5},
     {0.3341, 1.1136, -0.4454},
     -0.01950111160053,
     {0.02312410306037, 0.8881443643044, -0.4589824223345},
     {0.08004866305941, 0.6002378994717, -0.1669362515653},
     {0.07959771734497, 0.582918097106, -0.1579855841247}},
    {3,
     {1, 0, 0, 0},
     {1, 0.3, 0.2, 0.1},
     {2.8222, 0.5644, 0.8466},
     1.124984256706,
     {0.9561193903962, 0.2067722236086, 0.2075595308637},
     {0.9632236396855, 0.3205177971119, 0.2085783777957},
     {2.038842901413, 0.5531332933957, 0.4420795823467}},
    {3,
     {0.9, 0.1, 0.4, 0.2},
     {1, 1, 0.2, 0.1},
     {-1.2632, 1.0106, 2.5265},
     1.259384500926,
     {-0.2738324208534, 0.2835229644862, 0.9190378305046},
     {-0.4274031906757, 0.1590003406317, 0.9227456559225},
     {-0.7722634973496, 0.5160647677622, 2.080167655425}},
    {3,
     {1, 0.5, -0.2, 0.4},
     {0.2, 1, 0.3, -0.5},
     {0.3652, 1.2173, -0.4869},
     -0.02005386428964,
     {0.009579945985268, 0.8186692002951, -0.5741854797216},
     {0.07687504289038, 0.6195092786524, -0.169417622749},
     {0.07668292795369, 0.6030917976116, -0.1579029850615}},
    {4,
     {1, 0, 0, 0},
     {1, 0.3, 0.2, 0.1},
     {2.8222, 0.5644, 0.8466},
     1.035144593874,
     {0.9794151161323, 0.1530271532315, 0.1316385986913},
     {0.9770458608201, 0.3908128461896, 0.2532729248488},
     {1.990882123443, 0.5492180765731, 0.3895379086293}},
    {4,
     {0.9, 0.1, 0.4, 0.2},
     {1, 1, 0.2, 0.1},
     {-1.2632, 1.0106, 2.5265},
     1.115851166908,
     {-0.2544609521756, 0.269599707874, 0.928744109716},
     {-0.4068783838093, 0.183793428546, 1.013636432034},
     {-0.6908189342269, 0.4846265771751, 2.04997663062}},
    {4,
     {1, 0.5, -0.2, 0.4},
     {0.2, 1, 0.3, -0.5},
     {0.3791, 1.2638, -0.5055},
     -0.02022070463426,
     {0.0009456575377679, 0.801831529924, -0.5975494149872},
     {0.0504449217026, 0.5933508177002, -0.2086047124915},
     {0.05042579984084, 0.5771372191672, -0.1965218422667}},
    {8,
     {1, 0, 0, 0},
     {1, 0.3, 0.2, 0.1},
     {2.8222, 0.5644, 0.8466},
     0.9207445578294,
     {0.9970106470545, 0.07489268731183, 0.0189961850695},
     {0.9943644746712, 0.5323321223451, 0.314981548806},
     {1.912356602045, 0.6012891566087, 0.3324721828283}},
    {8,
     {0.9, 0.1, 0.4, 0.2},
     {1, 1, 0.2, 0.1},
     {-1.2632, 1.0106, 2.5265},
     0.8752891014409,
     {-0.1986096634636, 0.2328421484077, 0.9520182432621},
     {-0.3827569464922, 0.2240446527089, 1.165598107701},
     {-0.5565978203627, 0.4278488475663, 1.998889300401}},
    {8,
     {1, 0.5, -0.2, 0.4},
     {0.2, 1, 0.3, -0.5},
     {0.4014, 1.3381, -0.5352},
     -0.02028794815629,
     {-9.635591541738e-09, 0.8000000060674, -0.5999999919101},
     {-0.06132466891865, 0.497094173039, -0.3372077690982},
     {-0.06132466872317, 0.4808638143909, -0.3250350003685}},
};

// Sphere of radius r at c against axes (1, .8, .6) not turned; every line of
// reference-data/derived/superquadric_sphere_distance.csv.
struct SphereRow {
  double m, c[3], r, distance, n[3], p[3];
};
constexpr SphereRow kSpheres[] = {
    {2,
     {1.5, 0.2, 0.1},
     0.25,
     0.2730480525651,
     {0.9787794624669, 0.1710702009289, 0.112808466913},
     {0.988051308266, 0.1105220645522, 0.04099575106831}},
    {2,
     {0.3, 0.2, 0.75},
     0.25,
     -0.0587230547705,
     {0.1664398068891, 0.1636085645911, 0.9723836836739},
     {0.2681639021737, 0.1687054535516, 0.5640054193959}},
    {3,
     {1.5, 0.2, 0.1},
     0.25,
     0.2552739773625,
     {0.997818463433, 0.05744729935723, 0.03252878461724},
     {0.9958282962954, 0.170973374565, 0.08356405161768}},
    {3,
     {0.3, 0.2, 0.75},
     0.25,
     -0.09175187042753,
     {0.05230409307465, 0.04468080912564, 0.9976311478415},
     {0.291722975102, 0.1929293455281, 0.5921267368508}},
    {4,
     {1.5, 0.2, 0.1},
     0.25,
     0.2510738958308,
     {0.9998284536784, 0.0171660096207, 0.006956387619762},
     {0.9990120615529, 0.1913985606835, 0.09651433575446}},
    {4,
     {0.3, 0.2, 0.75},
     0.25,
     -0.09822101295294,
     {0.01594708727626, 0.01151248509902, 0.9998065578372},
     {0.2975795672469, 0.1982526466733, 0.5982503734085}},
    {8,
     {1.5, 0.2, 0.1},
     0.25,
     0.250001980322,
     {0.9999999970796, 7.619332915881e-05, 5.952583945824e-06},
     {0.9999980211382, 0.1999619031845, 0.09999702369624}},
    {8,
     {0.3, 0.2, 0.75},
     0.25,
     -0.09999393607442,
     {0.0001311690433072, 4.576860511689e-05, 0.99999999035},
     {0.2999803238481, 0.1999931344317, 0.599993937522}},
    {16,
     {1.5, 0.2, 0.1},
     0.25,
     0.2500000000146,
     {1, 1.164153167702e-09, 3.54470415105e-12},
     {0.9999999999854, 0.1999999994179, 0.09999999999823}},
    {16,
     {0.3, 0.2, 0.75},
     0.25,
     -0.09999999982984,
     {8.609343680717e-09, 6.984919284442e-10, 1},
     {0.2999999987086, 0.1999999998952, 0.5999999998298}},
};

Vec3 vec(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}
Quat quat(const double (&q)[4]) {
  return Quat(q[0], q[1], q[2], q[3]).normalized();
}
/// n.d - hA(n) - hB(-n): the gap along n.
double gap_along(const Superquadric& a, const Superquadric& b, const Vec3& n) {
  return n.dot(b.x - a.x) - support_height(a.semi_axes, a.m, a.q.conjugate() * n) -
         support_height(b.semi_axes, b.m, b.q.conjugate() * -n);
}

TEST(SuperquadricGap, AgreesWithTheReferencePairs) {
  for (const PairRow& row : kPairs) {
    const Superquadric a{Vec3::Zero(), quat(row.q1), Vec3(1, 0.8, 0.6), row.m};
    const Superquadric b{vec(row.c), quat(row.q2), Vec3(0.7, 0.5, 0.9), row.m};
    PairMemory memory;
    ContactGeometry geometry;
    EXPECT_NE(superquadric_gap(a, b, memory, geometry), PairOutcome::unresolved);
    EXPECT_NEAR(-geometry.overlap, row.distance, 1e-10) << row.m;
    EXPECT_LT((geometry.normal - vec(row.n)).norm(), 1e-10) << row.m;
    const double points = row.m > 8 ? 1e-7 : 1e-9;  // open along flat faces
    EXPECT_LT((geometry.point - 0.5 * (vec(row.p1) + vec(row.p2))).norm(), points) << row.m;
  }
}

TEST(SuperquadricGap, AgreesWithTheReferenceSpheres) {
  for (const SphereRow& row : kSpheres) {
    const Superquadric a{Vec3::Zero(), Quat::Identity(), Vec3(1, 0.8, 0.6), row.m};
    const Superquadric b{vec(row.c), Quat(0.5, 0.1, 0.7, -0.3).normalized(), Vec3::Constant(row.r), 2};
    PairMemory memory;
    ContactGeometry geometry;
    EXPECT_NE(superquadric_gap(a, b, memory, geometry), PairOutcome::unresolved);
    EXPECT_NEAR(-geometry.overlap, row.distance, 1e-10) << row.m;
    EXPECT_LT((geometry.normal - vec(row.n)).norm(), 1e-10) << row.m;
    EXPECT_LT((geometry.point - vec(row.p) + 0.5 * geometry.overlap * vec(row.n)).norm(), 1e-9) << row.m;
  }
}

// Closed forms for |x|^m + |y|^m + |z|^m = 1: reference-data/derived/superquadric_axis_cases.csv.
TEST(SuperquadricGap, TouchesAtTheClosedFormDistancesOnAxesEdgesAndCorners) {
  for (const double m : {2.0, 2.5, 3.0, 4.0, 8.0, 16.0}) {
    const double corner = std::sqrt(3.0) * std::pow(3.0, -1 / m);
    const double edge = std::sqrt(2.0) * std::pow(2.0, -1 / m);
    for (const auto& [direction, reach] :
         {std::pair(Vec3(1, 0, 0), 1.0), std::pair(Vec3(0, 1, 1), edge), std::pair(Vec3(1, 1, 1), corner)}) {
      const Vec3 n = direction.normalized();
      const Superquadric a{Vec3::Zero(), Quat::Identity(), Vec3::Ones(), m};
      const Superquadric b{(2 * reach - 0.01) * n, Quat::Identity(), Vec3::Ones(), m};
      PairMemory memory;
      ContactGeometry geometry;
      EXPECT_NE(superquadric_pair(a, b, memory, geometry), PairOutcome::unresolved);
      EXPECT_NEAR(geometry.overlap, 0.01, 1e-10) << m << ' ' << reach;
      EXPECT_LT((geometry.normal - n).norm(), 1e-9) << m << ' ' << reach;
      EXPECT_LT((geometry.point - (reach - 0.005) * n).norm(), 1e-9) << m << ' ' << reach;
    }
  }
}

TEST(SuperquadricPair, OfSpheresIsTheSphereFormula) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Superquadric a{random.on_sphere(), random.rotation(), Vec3::Constant(0.02), 2};
    const Vec3 n = random.on_sphere();
    const Superquadric b{a.x + 0.0495 * n, random.rotation(), Vec3::Constant(0.03), 2};
    PairMemory memory;
    ContactGeometry geometry;
    ASSERT_EQ(superquadric_pair(a, b, memory, geometry), PairOutcome::converged);
    EXPECT_NEAR(geometry.overlap, 0.0005, 1e-15);
    EXPECT_LT((geometry.normal - n).norm(), 1e-13);
    EXPECT_LT((geometry.point - a.x - 0.01975 * n).norm(), 1e-15);
  }
}

TEST(SuperquadricPair, AlmostSpheresConvergeToTheSphereFormula) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const double off = 1 + 1e-13;
    const Superquadric a{random.on_sphere(), random.rotation(), Vec3(0.02, 0.02, 0.02 * off), 2};
    const Vec3 n = random.on_sphere();
    const Superquadric b{a.x + 0.0495 * n, random.rotation(), Vec3(0.03, 0.03, 0.03 * off), 2};
    PairMemory memory;
    ContactGeometry geometry;
    ASSERT_EQ(superquadric_pair(a, b, memory, geometry), PairOutcome::converged);
    EXPECT_NEAR(geometry.overlap, 0.0005, 1e-14);
    EXPECT_LT((geometry.normal - n).norm(), 1e-10);
    EXPECT_LT((geometry.point - a.x - 0.01975 * n).norm(), 1e-10);
  }
}

TEST(SuperquadricPair, BodiesApartAreSeparatedWarmAndCold) {
  const Superquadric a{Vec3::Zero(), Quat::Identity(), Vec3(1, 0.8, 0.6), 4};
  Superquadric b{Vec3(1.2, 1.1, 1.3), Quat(0.9, 0.1, 0.4, 0.2).normalized(), Vec3(0.7, 0.5, 0.9), 4};
  PairMemory memory;
  ContactGeometry geometry;
  EXPECT_EQ(superquadric_pair(a, b, memory, geometry), PairOutcome::separated);
  superquadric_gap(a, b, memory, geometry);
  ASSERT_LT(geometry.overlap, 0);
  b.x += (geometry.overlap + 0.01) * geometry.normal;  // leaves a gap of 0.01
  EXPECT_EQ(superquadric_pair(a, b, memory, geometry), PairOutcome::separated);
  b.x -= 0.02 * geometry.normal;
  EXPECT_EQ(superquadric_pair(a, b, memory, geometry), PairOutcome::converged);
  EXPECT_GT(geometry.overlap, 0.009);
}

TEST(SuperquadricPair, SwappedBodiesGiveTheOppositeNormal) {
  const PairRow& row = kPairs[8];
  ASSERT_LT(row.distance, 0);
  const Superquadric a{Vec3::Zero(), quat(row.q1), Vec3(1, 0.8, 0.6), row.m};
  const Superquadric b{vec(row.c), quat(row.q2), Vec3(0.7, 0.5, 0.9), 8};
  PairMemory forth, back;
  ContactGeometry ab, ba;
  ASSERT_EQ(superquadric_pair(a, b, forth, ab), PairOutcome::converged);
  ASSERT_EQ(superquadric_pair(b, a, back, ba), PairOutcome::converged);
  EXPECT_NEAR(ab.overlap, ba.overlap, 1e-13);
  EXPECT_LT((ab.normal + ba.normal).norm(), 1e-11);
  EXPECT_LT((ab.point - ba.point).norm(), 1e-11);
}

/// Pairs made to overlap by a known amount along a known common normal.
struct RandomPair {
  Superquadric a, b;
  double overlap = 0;
  Vec3 normal = Vec3::Zero();
};

RandomPair random_pair(Random& random, double m_a, double m_b, double elongation) {
  const auto axes = [&] {
    const double b = 0.5 * random.uniform(0.6, 1.4);
    return Vec3(b * random.uniform(1, std::sqrt(elongation)), b,
                b / random.uniform(1, std::sqrt(elongation)));
  };
  RandomPair pair;
  pair.a = {random.on_sphere(), random.rotation(), axes(), m_a};
  pair.b = {Vec3::Zero(), random.rotation(), axes(), m_b};
  const double least = std::min(pair.a.semi_axes.minCoeff(), pair.b.semi_axes.minCoeff());
  pair.overlap = 0.2 * least * std::pow(random.uniform(), 3);
  pair.normal = random.on_sphere();
  const Vec3 on_a = pair.a.q * support_point(pair.a.semi_axes, m_a, pair.a.q.conjugate() * pair.normal);
  const Vec3 on_b = pair.b.q * support_point(pair.b.semi_axes, m_b, pair.b.q.conjugate() * -pair.normal);
  pair.b.x = pair.a.x + on_a - on_b - pair.overlap * pair.normal;
  return pair;
}

/// The geometry's overlap is the gap along its normal, and no normal near it has a larger gap.
void expect_local_maximum(const Superquadric& a, const Superquadric& b, const ContactGeometry& geometry) {
  EXPECT_NEAR(gap_along(a, b, geometry.normal), -geometry.overlap, 1e-9);
  const auto [e1, e2] = tangent_frame(geometry.normal);
  for (const Vec3& turn : {e1, e2, Vec3(-e1), Vec3(-e2)})
    EXPECT_LE(gap_along(a, b, (geometry.normal + 1e-4 * turn).normalized()), -geometry.overlap + 1e-9);
}

class SuperquadricPairs : public testing::TestWithParam<std::array<double, 3>> {};

TEST_P(SuperquadricPairs, AreAllResolvedColdAndWarm) {
  const auto [m_a, m_b, elongation] = GetParam();
  constexpr int kPairsTried = 20000;
  Random random(static_cast<std::uint64_t>(100 * m_a + 10 * m_b + elongation));
  int unresolved = 0, fallback = 0, other_branch = 0, cold_again = 0, left = 0;
  for (int i = 0; i < kPairsTried; ++i) {
    const RandomPair pair = random_pair(random, m_a, m_b, elongation);
    Superquadric b = pair.b;
    PairMemory memory;
    ContactGeometry geometry;
    const PairOutcome outcome = superquadric_pair(pair.a, b, memory, geometry);
    unresolved += outcome == PairOutcome::unresolved;
    fallback += outcome == PairOutcome::fallback;
    if (outcome == PairOutcome::separated) {
      // Only where the known overlap is none to speak of.
      EXPECT_LT(pair.overlap, 1e-9);
      continue;
    }
    other_branch += std::fabs(geometry.overlap - pair.overlap) > 1e-9;
    if (i % 4 == 0) expect_local_maximum(pair.a, b, geometry);
    // As far as bodies move in a time step.
    b.x += 2e-4 * random.on_sphere();
    b.q = (b.q * Quat(Eigen::AngleAxisd(2e-4, random.on_sphere()))).normalized();
    const double last = geometry.overlap;
    const PairOutcome warm = superquadric_pair(pair.a, b, memory, geometry);
    unresolved += warm == PairOutcome::unresolved;
    cold_again += warm == PairOutcome::fallback;
    if (warm == PairOutcome::separated) {
      EXPECT_LT(last, 1e-3);
      ++left;
      continue;
    }
    EXPECT_NEAR(geometry.overlap, last, 2e-3);
    if (i % 4 == 1) expect_local_maximum(pair.a, b, geometry);
  }
  EXPECT_EQ(unresolved, 0);
  EXPECT_LT(left, kPairsTried / 3);
  EXPECT_LE(fallback + cold_again, 2);
  // Deep overlaps can have another local maximum of the gap nearer to the line of centres.
  EXPECT_LT(other_branch, kPairsTried / 1000);
}

INSTANTIATE_TEST_SUITE_P(Blockiness, SuperquadricPairs,
                         testing::Values(std::array{2.0, 2.0, 4.0}, std::array{2.5, 2.5, 4.0},
                                         std::array{3.0, 3.0, 4.0}, std::array{4.0, 4.0, 1.0},
                                         std::array{4.0, 4.0, 4.0}, std::array{6.0, 6.0, 4.0},
                                         std::array{8.0, 8.0, 1.0}, std::array{8.0, 8.0, 4.0},
                                         std::array{2.0, 8.0, 4.0}, std::array{3.5, 6.0, 2.0},
                                         std::array{16.0, 16.0, 1.0}, std::array{16.0, 16.0, 4.0}));

}  // namespace
}  // namespace sluice
