/// The CAD files in `geometry/`: what their generators write is what is committed, and it is sound.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>

#include "geometry/audit_mesh.h"
#include "geometry/import_mesh.h"
#include "geometry/scratch_folder.h"
#include "geometry/surface_query.h"

namespace sluice {
namespace {

const std::filesystem::path geometry_folder = std::filesystem::path(SLUICE_ROOT) / "geometry";

std::vector<std::string> tokens_of(const std::string& text) {
  std::string spaced = text;
  for (char& c : spaced)
    if (c == ',') c = ' ';
  std::istringstream in(spaced);
  std::vector<std::string> tokens;
  for (std::string token; in >> token;) tokens.push_back(token);
  return tokens;
}

/// Equal words; numbers to the last digit written, which may round differently on another processor.
void expect_same(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto left = tokens_of(text_of(a)), right = tokens_of(text_of(b));
  ASSERT_EQ(left.size(), right.size()) << a;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i] == right[i]) continue;
    char *end_left = nullptr, *end_right = nullptr;
    const double x = std::strtod(left[i].c_str(), &end_left), y = std::strtod(right[i].c_str(), &end_right);
    ASSERT_TRUE(*end_left == 0 && *end_right == 0) << left[i] << " " << right[i];
    ASSERT_NEAR(x, y, 2e-9 * std::max(1.0, std::abs(x))) << a << " token " << i;
  }
}

void expect_regenerated(const std::string& generator, const std::string& set,
                        const std::vector<std::string>& files) {
  const ScratchFolder folder;
  const std::string command = std::string(SLUICE_BINARY_DIR) + "/" + generator + " " +
                              folder.path().string() + " > " + (folder.path() / "log").string();
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  for (const std::string& file : files) expect_same(folder.path() / file, geometry_folder / set / file);
}

std::map<std::string, PartAudit> audits_of(const std::string& file) {
  std::map<std::string, PartAudit> audits;
  for (PartAudit& audit : audit_mesh(import_mesh(geometry_folder / file, 1e-3))) audits[audit.part] = audit;
  return audits;
}

TEST(CommittedGeometry, IsWhatItsGeneratorsWrite) {
  expect_regenerated("feedbox_geometry", "feedbox", {"feedbox.obj", "outlets.csv"});
  expect_regenerated("transfer_chute_geometry", "transfer-chute", {"transfer-chute.obj"});
  expect_regenerated("screen_deck_geometry", "screen-deck", {"screen-deck.obj"});
  expect_regenerated("container_geometry", "container", {"container.obj"});
}

TEST(CommittedGeometry, FeedBoxHasSoundSolidsAndSheets) {
  const auto audits = audits_of("feedbox/feedbox.obj");
  for (const auto& [name, audit] : audits) {
    EXPECT_TRUE(audit.consistent) << name;
    EXPECT_EQ(audit.degenerate + audit.duplicates + audit.non_manifold_edges + audit.self_intersections, 0u)
        << name;
  }
  for (const char* solid : {"front_plate", "ledge_1", "ledge_2", "ledge_3", "chute", "header_nozzles"}) {
    ASSERT_TRUE(audits.contains(solid)) << solid;
    EXPECT_TRUE(audits.at(solid).closed) << solid;
    EXPECT_GT(audits.at(solid).volume, 0) << solid;
  }
  for (const char* sheet :
       {"belt", "skirts", "inlet_hood", "back_plate", "side_left", "side_right", "deck"}) {
    ASSERT_TRUE(audits.contains(sheet)) << sheet;
    EXPECT_FALSE(audits.at(sheet).closed) << sheet;
  }
  EXPECT_EQ(audits.at("header_pipes").components, 1u + 10u);
  EXPECT_GE(audits.at("header_nozzles").components, 2u + 40u);
  EXPECT_NEAR(audits.at("front_plate").volume, 0.012 * 2.4 * 3.5, 1e-9);
  EXPECT_NEAR(audits.at("chute").bounds.size().y(), 2.4, 1e-12);
}

TEST(CommittedGeometry, FeedBoxPassagesAreThreeTopSizesWide) {
  const TriMesh mesh = import_mesh(geometry_folder / "feedbox/feedbox.obj", 1e-3);
  const auto corner = [&](const char* part, bool leftmost) {
    Vec3 found(leftmost ? 1e9 : -1e9, 0, 0);
    for (const Vec3& x : extract_part(mesh, part).vertices)
      if (leftmost ? x.x() < found.x() : x.x() > found.x()) found = x;
    return found;
  };
  const SurfaceQuery back(extract_part(mesh, "back_plate")), front(extract_part(mesh, "front_plate"));
  const SurfaceQuery ledge_2(extract_part(mesh, "ledge_2")), ledge_3(extract_part(mesh, "ledge_3"));
  const SurfaceQuery chute(extract_part(mesh, "chute"));
  const Vec3 tip_1 = corner("ledge_1", true), tip_2 = corner("ledge_2", false),
             tip_3 = corner("ledge_3", true);
  constexpr double opening = 0.75 - 1e-9;
  EXPECT_GE(back.nearest(tip_1, 9)->distance, opening);
  EXPECT_GE(ledge_2.nearest(tip_1, 9)->distance, opening);
  EXPECT_GE(front.nearest(tip_2, 9)->distance, opening);
  EXPECT_GE(ledge_3.nearest(tip_2, 9)->distance, opening);
  EXPECT_GE(back.nearest(tip_3, 9)->distance, opening);
  EXPECT_GE(chute.nearest(tip_3, 9)->distance, opening);
  // Lip 0.4 m above the deck.
  const SurfaceQuery deck(extract_part(mesh, "deck"));
  const Vec3 lip = corner("chute", false);
  EXPECT_NEAR(deck.first_hit(Vec3(lip.x(), 0, 0.4), Vec3(lip.x(), 0, -1))->s * 1.4, 0.4, 1e-9);
}

TEST(CommittedGeometry, OutletsLieInsideTheBoxAndLookIntoIt) {
  const TriMesh mesh = import_mesh(geometry_folder / "feedbox/feedbox.obj", 1e-3);
  const SurfaceQuery query(mesh);
  std::istringstream table(text_of(geometry_folder / "feedbox/outlets.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "name,part,x_mm,y_mm,z_mm,direction_x,direction_y,direction_z,bore_mm");
  int pipes = 0, nozzles = 0;
  while (std::getline(table, line)) {
    const auto cell = tokens_of(line);
    ASSERT_EQ(cell.size(), 9u);
    const auto number = [&](std::size_t k) { return std::stod(cell[k]); };
    const Vec3 at = 1e-3 * Vec3(number(2), number(3), number(4)), direction(number(5), number(6), number(7));
    EXPECT_NEAR(direction.norm(), 1, 1e-8);
    EXPECT_TRUE(at.x() > -0.3 && at.x() < 1.05 && std::abs(at.y()) < 1.2);
    const auto hit = query.first_hit(at + 0.001 * direction, at + 3 * direction);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(mesh.part_names[static_cast<std::size_t>(mesh.part[static_cast<std::size_t>(hit->triangle)])]
                    .starts_with("ledge"));
    (cell[1] == "header_pipes" ? pipes : nozzles) += 1;
  }
  EXPECT_EQ(pipes, 10);
  EXPECT_GE(nozzles, 40);
}

TEST(CommittedGeometry, ChuteAndContainerAreSheets) {
  for (const char* file :
       {"transfer-chute/transfer-chute.obj", "screen-deck/screen-deck.obj", "container/container.obj"})
    for (const auto& [name, audit] : audits_of(file)) {
      EXPECT_FALSE(audit.closed) << name;
      EXPECT_EQ(audit.degenerate + audit.duplicates + audit.non_manifold_edges + audit.self_intersections, 0u)
          << name;
    }
  const auto tank = audits_of("container/container.obj").at("tank");
  EXPECT_EQ(tank.boundary_loops, 1u);
  EXPECT_NEAR((tank.bounds.size() - Vec3(0.6, 0.4, 0.5)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace sluice
