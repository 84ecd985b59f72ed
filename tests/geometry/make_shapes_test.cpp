#include "geometry/make_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/audit_mesh.h"
#include "geometry/shapes.h"

namespace sluice {
namespace {

TEST(MakeShapes, PrismIsClosedOutwardAndHasItsVolume) {
  const TriMesh prism = make_prism("p", {{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 1}}, {-1, 2});
  const PartAudit audit = audit_mesh(prism).at(0);
  EXPECT_TRUE(audit.closed);
  EXPECT_TRUE(audit.consistent);
  EXPECT_NEAR(audit.volume, 3 * 3, 1e-14);
}

TEST(MakeShapes, CappedTubeIsClosedOutwardAndOpenTubeHasTwoEnds) {
  Tube tube{Vec3(1, 2, 3), Vec3(2, 2, 4), 0.1, 16, TubeEnds::capped};
  const PartAudit closed = audit_mesh(make_tube("t", tube)).at(0);
  EXPECT_TRUE(closed.closed);
  EXPECT_TRUE(closed.consistent);
  // A regular 16-gon drawn over sqrt(2).
  EXPECT_NEAR(closed.volume, 0.5 * 16 * 0.01 * std::sin(std::numbers::pi / 8) * std::numbers::sqrt2, 1e-12);
  tube.ends = TubeEnds::open;
  const PartAudit open = audit_mesh(make_tube("t", tube)).at(0);
  EXPECT_EQ(open.boundary_loops, 2u);
  EXPECT_TRUE(open.consistent);
}

TEST(MakeShapes, SheetFollowsItsProfileAcrossTheWidth) {
  const TriMesh sheet = make_sheet("s", {{0, 0}, {1, 0}, {1, 2}}, {-0.5, 1.5});
  const PartAudit audit = audit_mesh(sheet).at(0);
  EXPECT_TRUE(audit.consistent);
  EXPECT_EQ(audit.boundary_loops, 1u);
  EXPECT_DOUBLE_EQ(audit.area, 2 * 3);
  EXPECT_DOUBLE_EQ(audit_mesh(make_polygon("q", {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {0, 1, 0}})).at(0).area,
                   1.5);
}

}  // namespace
}  // namespace sluice
