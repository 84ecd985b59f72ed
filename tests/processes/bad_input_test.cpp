// Bad input, one kind a test: each is refused with the file, the place in it, the key and a remedy.

#include <gtest/gtest.h>

#include "base/errors.h"
#include "processes/build_parts.h"
#include "processes/sample.h"

namespace sluice {
namespace {

const std::string plate_obj =
    "o plate\nv 0.2 0.2 0.7\nv 0.8 0.2 0.7\nv 0.8 0.8 0.7\nv 0.2 0.8 0.7\nf 1 2 3\nf 1 3 4\n";

const std::string plate_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0.2 0.2 0.7\n0.8 0.2 0.7\n0.8 0.8 0.7\n3 0 1 2\n";

/// A scene with one of everything; the tests spoil one line each.
const std::string scene = R"(title: A plate in a tank
duration: 0.5 s
domain:
  low: [0 m, 0 m, 0 m]
  high: [1 m, 1 m, 2 m]
  z_low: wall
  wall_material: steel
materials:
  rock: {density: 2700 kg/m3}
  steel: {}
contacts:
  - {between: [rock, rock], friction: 0.6, restitution: 0.2}
  - {between: [rock, steel], friction: 0.5, restitution: 0.2}
walls:
  plate:
    file: plate.obj
    unit: m
    parts: [plate]
    material: steel
rocks:
  impact_speed: 2 m/s
water:
  spacing: 100 mm
  fastest_bulk_speed: 2 m/s
water_fills:
  pool:
    low: [0.1 m, 0.1 m, 0.1 m]
    high: [0.9 m, 0.9 m, 0.5 m]
rock_fills:
  stones:
    low: [0.1 m, 0.1 m, 1 m]
    high: [0.9 m, 0.9 m, 1.9 m]
    count: 5
    material: rock
    sizes: {curve: points, points: [{size: 40 mm, passing: 0}, {size: 60 mm, passing: 1}], cutoff: 40 mm}
    shapes:
      classes:
        - {kind: superquadric, blockiness: [2, 4]}
conveyors:
  feed:
    rate: 50 t/h
    belt_speed: 1 m/s
    position: [0.5 m, 0.5 m, 1.5 m]
    travel: [1, 0, 0]
    burden_width: 0.5 m
    bed_depth: 0.2 m
    material: rock
    sizes: {curve: points, points: [{size: 40 mm, passing: 0}, {size: 60 mm, passing: 1}], cutoff: 40 mm}
sprays:
  nozzle:
    rated_flow: 135 l/min
    rated_pressure: 1 bar
    angle: 75 deg
    position: [0.5 m, 0.5 m, 1.8 m]
    direction: [0, 0, -1]
    total_flow: 8 m3/h
exits:
  bottom:
    kind: plane
    low: [0 m, 0 m, 0.05 m]
    high: [1 m, 1 m, 0.05 m]
gauges:
  surface: {kind: level, x: 0.3 m, y: 0.2 m, radius: 60 mm}
mixing:
  tank: {low: [0 m, 0 m, 0 m], high: [1 m, 1 m, 1 m], slabs: 2, cell: 0.2 m}
)";

class BadInput : public sample::InAFolder {
 protected:
  void SetUp() override {
    InAFolder::SetUp();
    write("plate.obj", plate_obj);
  }

  /// The scene with one text replaced by another.
  static std::string with(const std::string& old_text, const std::string& new_text) {
    std::string text = scene;
    const std::size_t at = text.find(old_text);
    if (at == std::string::npos || text.find(old_text, at + 1) != std::string::npos)
      ADD_FAILURE() << "'" << old_text << "' must stand in the scene once";
    else
      text.replace(at, old_text.size(), new_text);
    return text;
  }

  std::vector<InputProblem> problems_of(const std::string& text) const {
    try {
      build_parts(read_process(write("process.yaml", text), {}));
    } catch (const InputError& e) {
      return e.problems();
    }
    return {};
  }

  /// The first problem names the file, this line and key, and a remedy; it holds `words`.
  void expect_refused(const std::string& text, int line, const std::string& key,
                      const std::string& words) const {
    const std::vector<InputProblem> problems = problems_of(text);
    ASSERT_FALSE(problems.empty()) << "accepted, but '" << key << "' is wrong";
    const InputProblem& p = problems.front();
    EXPECT_EQ(p.where.file, (folder_ / "process.yaml").string()) << p.text();
    EXPECT_EQ(p.where.line, line) << p.text();
    EXPECT_GT(p.where.column, 0) << p.text();
    EXPECT_EQ(p.key, key) << p.text();
    EXPECT_FALSE(p.suggestion.empty()) << p.text();
    EXPECT_NE(p.text().find(words), std::string::npos) << p.text();
  }

  /// The plate comes from a file with these bytes instead.
  void expect_mesh_refused(const std::string& name, const std::string& bytes,
                           const std::string& words) const {
    write(name, bytes);
    std::string text = with("file: plate.obj", "file: " + name);
    text.erase(text.find("    parts: [plate]\n"), 19);
    expect_refused(text, 16, "file", words);
    const std::vector<InputProblem> problems = problems_of(text);
    ASSERT_FALSE(problems.empty());
    EXPECT_NE(problems.front().problem.find((folder_ / name).string()), std::string::npos)
        << problems.front().text();
  }
};

TEST_F(BadInput, IsNotFoundInTheUnspoiltScene) {
  for (const InputProblem& p : problems_of(scene)) ADD_FAILURE() << p.text();
}

TEST_F(BadInput, MayBeAChannelThatIsNone) {
  const auto channel = [](const std::string& keys) {
    return with("exits:\n  bottom:",
                "channels:\n  launder:\n" + keys + "    position: [0.5 m, 0.5 m, 0.6 m]\nexits:\n  bottom:");
  };
  const std::string section = "    width: 0.3 m\n    depth: 0.1 m\n";
  for (const InputProblem& p :
       problems_of(channel(section + "    direction: [1, 0, 0]\n    flow: 200 m3/h\n")))
    ADD_FAILURE() << p.text();
  expect_refused(channel(section + "    direction: [1, 0, 0]\n"), 58, "flow", "'total_flow'");
  expect_refused(channel(section + "    direction: [0, 0, -1]\n    flow: 200 m3/h\n"), 58, "direction",
                 "'pipes'");
  expect_refused(channel("    width: 0.3 m\n    direction: [1, 0, 0]\n    flow: 200 m3/h\n"), 58, "depth",
                 "is missing");
}

TEST_F(BadInput, MayBeAnUnknownKey) {
  expect_refused(with("  spacing: 100 mm", "  spacing: 100 mm\n  spacng: 3 mm"), 24, "spacng",
                 "did you mean 'spacing'?");
}

TEST_F(BadInput, MayBeAWrongUnit) {
  expect_refused(with("spacing: 100 mm", "spacing: 100 kg"), 23, "spacing", "a length is needed");
}

TEST_F(BadInput, MayBeANumberWithoutAUnit) {
  expect_refused(with("spacing: 100 mm", "spacing: 0.1"), 23, "spacing", "without a unit");
}

TEST_F(BadInput, MayBeAMissingKey) {
  expect_refused(with("  spacing: 100 mm\n", ""), 22, "spacing", "is missing");
}

TEST_F(BadInput, MayBeAKeyGivenTwice) {
  expect_refused(with("  spacing: 100 mm\n", "  spacing: 100 mm\n  spacing: 50 mm\n"), 24, "spacing",
                 "is given twice");
}

TEST_F(BadInput, MayBeAnEmptySection) {
  expect_refused(with("rocks:\n  impact_speed: 2 m/s\n", "rocks:\n"), 20, "rocks", "is empty");
}

TEST_F(BadInput, MayBeAnEmptyFile) {
  const std::vector<InputProblem> problems = problems_of("");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].where.line, 1);
  EXPECT_FALSE(problems[0].suggestion.empty());
}

TEST_F(BadInput, MayBeANumberThatIsNotFinite) {
  expect_refused(with("spacing: 100 mm", "spacing: nan"), 23, "spacing", "a finite number is needed");
  expect_refused(with("spacing: 100 mm", "spacing: inf mm"), 23, "spacing", "a finite number is needed");
}

TEST_F(BadInput, MayBeAMeshThatIsNotThere) {
  expect_refused(with("file: plate.obj", "file: plato.obj"), 16, "file", "did you mean 'plate.obj'?");
}

TEST_F(BadInput, MayBeAnEmptyMesh) {
  expect_mesh_refused("bad.obj", "", "is empty");
}

TEST_F(BadInput, MayBeATruncatedMesh) {
  expect_mesh_refused("bad.obj", plate_obj.substr(0, plate_obj.size() - 3), "at least three are needed");
  expect_mesh_refused("bad.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "truncated");
}

TEST_F(BadInput, MayBeAMeshWithVerticesThatAreNotNumbers) {
  std::string spoilt = plate_obj;
  spoilt.replace(spoilt.find("0.8"), 3, "nan");
  expect_mesh_refused("bad.obj", spoilt, "a finite number is needed");
}

TEST_F(BadInput, MayBeAMeshWithIndicesOutOfRange) {
  std::string spoilt = plate_obj;
  spoilt.replace(spoilt.find("f 1 2 3"), 7, "f 1 2 9");
  expect_mesh_refused("bad.obj", spoilt, "names vertex '9'");
}

TEST_F(BadInput, MayBeADamagedPly) {
  expect_mesh_refused("bad.ply", plate_ply.substr(0, plate_ply.size() - 12), "ends too early");
  std::string spoilt = plate_ply;
  spoilt.replace(spoilt.find("end_header\n"), 11, "");
  expect_mesh_refused("bad.ply", spoilt, "no line of a PLY header");
  spoilt = plate_ply;
  spoilt.replace(spoilt.find("3 0 1 2"), 7, "3 0 1 7");
  expect_mesh_refused("bad.ply", spoilt, "names vertex 7");
}

TEST_F(BadInput, MayBeAMeshWithoutArea) {
  expect_mesh_refused("bad.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "has no area");
}

TEST_F(BadInput, MayBeAWallInTheWrongUnit) {
  write("far.obj", "o plate\nv 200 200 700\nv 800 200 700\nv 800 800 700\nf 1 2 3\n");
  expect_refused(with("file: plate.obj", "file: far.obj"), 16, "file", "check 'unit'");
}

TEST_F(BadInput, MayBeAPartThatIsNotInTheMesh) {
  expect_refused(with("parts: [plate]", "parts: [plat]"), 18, "parts", "did you mean 'plate'?");
  expect_refused(with("parts: [plate]", "parts: []"), 18, "parts", "names no part");
}

TEST_F(BadInput, MayBeAFeedThatCannotFitThroughItsBed) {
  expect_refused(with("rate: 50 t/h", "rate: 5000 t/h"), 40, "rate", "raise 'bed_depth'");
}

TEST_F(BadInput, MayBeAnExitOutsideTheDomain) {
  expect_refused(with("low: [0 m, 0 m, 0.05 m]\n    high: [1 m, 1 m, 0.05 m]",
                      "low: [0 m, 0 m, 9 m]\n    high: [1 m, 1 m, 9 m]"),
                 58, "low", "move it into [0, 0, 0] .. [1, 1, 2] m");
}

TEST_F(BadInput, MayBeAnExitWithTheNameOfTheOpenFaces) {
  expect_refused(with("  bottom:", "  outside:"), 58, "outside", "another name");
}

TEST_F(BadInput, MayBeADeckThatIsNoWall) {
  expect_refused(with("kind: plane\n    low: [0 m, 0 m, 0.05 m]\n    high: [1 m, 1 m, 0.05 m]",
                      "kind: deck\n    part: mesh"),
                 58, "part", "name one of 'walls'");
  expect_refused(with("kind: plane\n    low: [0 m, 0 m, 0.05 m]\n    high: [1 m, 1 m, 0.05 m]",
                      "kind: deck\n    part: plate"),
                 58, "part", "set 'blocks: rocks_only'");
}

TEST_F(BadInput, MayBeAnUnknownMaterial) {
  expect_refused(with("parts: [plate]\n    material: steel", "parts: [plate]\n    material: wood"), 19,
                 "material", "there are: rock, steel");
  expect_refused(with("count: 5\n    material: rock", "count: 5\n    material: wood"), 30, "material",
                 "name one of 'materials'");
  expect_refused(with("wall_material: steel", "wall_material: wood"), 7, "wall_material",
                 "there are: rock, steel");
  expect_refused(with("  wall_material: steel\n", ""), 3, "wall_material", "not a material");
  expect_refused(with("[rock, steel]", "[rock, wood]"), 13, "between", "there are: rock, steel");
}

TEST_F(BadInput, MayBeAContactThatIsNotStated) {
  expect_refused(with("  - {between: [rock, steel], friction: 0.5, restitution: 0.2}\n", ""), 19, "contacts",
                 "add {between: [rock, steel]");
}

TEST_F(BadInput, MayBeAContactThatIsHalfStated) {
  expect_refused(with("[rock, steel], friction: 0.5,", "[rock, steel],"), 13, "friction", "is missing");
  expect_refused(with("[rock, steel], friction: 0.5, restitution: 0.2", "[rock, steel], friction: 0.5"), 13,
                 "restitution", "is missing");
  expect_refused(with("[rock, steel]", "[rock]"), 13, "between", "a contact has two sides");
  expect_refused(with("[rock, steel]", "[]"), 13, "between", "a contact has two sides");
}

TEST_F(BadInput, MayBeAContactThatIsStatedTwice) {
  expect_refused(with("[rock, steel], friction: 0.5, restitution: 0.2}",
                      "[rock, steel], friction: 0.5, restitution: 0.2}\n"
                      "  - {between: [steel, rock], friction: 0.9, restitution: 0.2}"),
                 14, "between", "the pair stands in line 13 already");
}

TEST_F(BadInput, MayBeARockWithEdgesThatPointInwards) {
  expect_refused(with("blockiness: [2, 4]", "blockiness: [1.5, 4]"), 38, "blockiness", "use at least 2");
}

TEST_F(BadInput, MayBeARockWithoutSize) {
  const std::vector<InputProblem> problems = problems_of(with(
      "{curve: points, points: [{size: 40 mm, passing: 0}, {size: 60 mm, passing: 1}], cutoff: 40 mm}\n    "
      "shapes",
      "{curve: points, points: [{size: 0 mm, passing: 0}, {size: 60 mm, passing: 1}], cutoff: 40 mm}\n    "
      "shapes"));
  ASSERT_FALSE(problems.empty());
  for (const InputProblem& p : problems) {
    EXPECT_EQ(p.where.line, 35) << p.text();
    EXPECT_FALSE(p.suggestion.empty()) << p.text();
  }
}

TEST_F(BadInput, MayBeARockWithoutDensity) {
  expect_refused(with("2700 kg/m3", "0 kg/m3"), 9, "density", "use above 0 kg/m3");
  expect_refused(with("rock: {density: 2700 kg/m3}", "rock: {}"), 40, "material",
                 "give materials.rock.density");
}

TEST_F(BadInput, MayBeADomainTurnedInsideOut) {
  expect_refused(with("high: [1 m, 1 m, 2 m]", "high: [1 m, -1 m, -2 m]"), 5, "high",
                 "is not above 'low' along y, z");
}

TEST_F(BadInput, MayBeALevelAboveItsBox) {
  expect_refused(with("high: [0.9 m, 0.9 m, 0.5 m]", "high: [0.9 m, 0.9 m, 0.5 m]\n    level: 0.7 m"), 29,
                 "level", "give a height inside the box");
}

TEST_F(BadInput, MayBeAFillOutsideTheDomain) {
  expect_refused(with("high: [0.9 m, 0.9 m, 0.5 m]", "high: [1.9 m, 0.9 m, 0.5 m]"), 26, "high",
                 "lies outside the domain");
}

TEST_F(BadInput, MayBeAFillOfASheet) {
  expect_refused(with("high: [0.9 m, 0.9 m, 0.5 m]", "high: [0.9 m, 0.9 m, 0.5 m]\n    inside: plate"), 26,
                 "inside", "is not closed");
}

TEST_F(BadInput, MayBeANozzleWithoutWater) {
  expect_refused(with("water:\n  spacing: 100 mm\n  fastest_bulk_speed: 2 m/s\n", ""), 47, "water",
                 "add 'water:'");
}

TEST_F(BadInput, MayBeANozzleOutsideTheDomain) {
  expect_refused(with("position: [0.5 m, 0.5 m, 1.8 m]", "position: [0.5 m, 0.5 m, 2.8 m]"), 50, "position",
                 "move it inside");
}

TEST_F(BadInput, MayBeRocksThatDoNotFitTheirBox) {
  expect_refused(with("count: 5\n", "count: 1000000000\n"), 30, "count", "enlarge the box");
  expect_refused(with("count: 5\n", "mass: 1e12 kg\n"), 30, "mass", "enlarge the box");
  expect_refused(with("high: [0.9 m, 0.9 m, 1.9 m]", "high: [0.12 m, 0.9 m, 1.9 m]"), 30, "count",
                 "enlarge the box");
}

TEST_F(BadInput, MayBeCellsTooFineOrTooCoarseForTheDomain) {
  expect_refused(with("spacing: 100 mm", "spacing: 1e-9 m"), 22, "spacing", "use larger cells");
  expect_refused(with("spacing: 100 mm", "spacing: 50 m"), 22, "spacing", "fit into the domain");
}

TEST_F(BadInput, MayBeAGaugeBesideTheDomain) {
  expect_refused(with("x: 0.3 m", "x: 30 m"), 63, "x", "move the gauge inside");
}

TEST_F(BadInput, MayBeAMixingZoneThatIsNowhereOrTooFine) {
  expect_refused(with("tank: {low: [0 m, 0 m, 0 m], high: [1 m, 1 m, 1 m]",
                      "tank: {low: [5 m, 0 m, 0 m], high: [6 m, 1 m, 1 m]"),
                 65, "low", "enlarge the domain");
  expect_refused(with("cell: 0.2 m", "cell: 1 um"), 65, "cell", "about two top sizes");
}

/// The contact laws of the scene, with other text.
std::string contacts_of(const std::string& rock, const std::string& steel, const std::string& on_rock,
                        const std::string& on_steel) {
  return "  rock: {density: 2700 kg/m3" + rock + "}\n  steel: {" + steel +
         "}\ncontacts:\n  - {between: [rock, rock], friction: 0.6, restitution: 0.2" + on_rock +
         "}\n  - {between: [rock, steel], friction: 0.5, restitution: 0.2" + on_steel + "}";
}
const std::string hertz = ", law: hertz_mindlin", elastic = "youngs_modulus: 50 MPa, poissons_ratio: 0.25";

TEST_F(BadInput, IsNotFoundInASceneOfElasticAndAdhesiveContacts) {
  const std::string old = contacts_of("", "", "", "");
  for (const InputProblem& p :
       problems_of(with(old, contacts_of(", " + elastic, elastic, hertz + ", adhesion: 5 N/m", hertz))))
    ADD_FAILURE() << p.text();
  std::string mixed = with(old, contacts_of(", " + elastic, "", hertz, ", adhesion: 5 N/m"));
  mixed.replace(mixed.find("  impact_speed: 2 m/s"), 21, "  impact_speed: 2 m/s\n  tangential_ratio: 0.3");
  for (const InputProblem& p : problems_of(mixed)) ADD_FAILURE() << p.text();
}

TEST_F(BadInput, MayBeAnElasticContactWithoutElasticConstants) {
  const std::string old = contacts_of("", "", "", "");
  expect_refused(with(old, contacts_of("", "", "", hertz)), 9, "youngs_modulus",
                 "rock on steel hertz_mindlin");
  expect_refused(with(old, contacts_of(", " + elastic, "youngs_modulus: 1 GPa", "", hertz)), 10,
                 "poissons_ratio", "is missing for 'steel'");
  EXPECT_EQ(problems_of(with(old, contacts_of("", "", "", hertz))).size(), 4u);
  expect_refused(with(old, contacts_of(", youngs_modulus: 0 Pa, poissons_ratio: 0.2", "", hertz, "")), 9,
                 "youngs_modulus", "out of range");
  expect_refused(with(old, contacts_of(", youngs_modulus: 1 GPa, poissons_ratio: 0.6", "", hertz, "")), 9,
                 "poissons_ratio", "out of range");
}

TEST_F(BadInput, MayBeAKeyOfTheOtherContactLaw) {
  const std::string old = contacts_of("", "", "", "");
  expect_refused(with(old, contacts_of("", "", ", tangential: partial_slip", "")), 12, "tangential",
                 "'law' is linear");
  expect_refused(with(old, contacts_of(", " + elastic, "", hertz + ", tangential: partial_slid", "")), 12,
                 "tangential", "partial_slip");
  expect_refused(with(old, contacts_of("", elastic, "", "")), 10, "youngs_modulus",
                 "has no effect on 'steel'");
  for (const char* key : {"tangential_ratio: 0.3", "stiffness_per_size: 1e6 N/m2", "impact_overlap: 0.01"}) {
    std::string text = with(old, contacts_of(", " + elastic, elastic, hertz, hertz));
    text.replace(text.find("  impact_speed: 2 m/s"), 21, std::string("  impact_speed: 2 m/s\n  ") + key);
    expect_refused(text, 22, std::string(key).substr(0, std::string(key).find(':')), "has no effect");
  }
}

TEST_F(BadInput, MayBeAnUnknownContactLawOrAdhesionThatPushes) {
  const std::string old = contacts_of("", "", "", "");
  expect_refused(with(old, contacts_of("", "", ", law: hertz_mindlim", "")), 12, "law", "hertz_mindlin");
  expect_refused(with(old, contacts_of("", "", ", adhesion: -1 N/m", "")), 12, "adhesion", "out of range");
}

TEST_F(BadInput, MayResolveRocksThatTheWaterDoesNotFeelOrThatAreNoCellsLarge) {
  const std::string old = "  fastest_bulk_speed: 2 m/s", line = old + "\ncoupling: {";
  expect_refused(with(old, line + "mode: one_way, resolve_from: 4}"), 25, "resolve_from", "'one_way'");
  expect_refused(with(old, line + "resolve_from: 1}"), 25, "resolve_from", "out of range");
  EXPECT_TRUE(problems_of(with(old, line + "resolve_from: 4}")).empty());
  expect_refused(with(old, line + "resolve_from: 4, resolve_partly_from: 5}"), 25, "resolve_partly_from",
                 "above resolve_from");
  expect_refused(with(old, line + "resolve_partly_from: 5}"), 25, "resolve_partly_from", "resolve_from");
  EXPECT_TRUE(problems_of(with(old, line + "resolve_from: 4, resolve_partly_from: 2}")).empty());
}

TEST_F(BadInput, MayAskForFilmsWhereNoRockIsResolvedOrIsASphere) {
  const std::string old = "  fastest_bulk_speed: 2 m/s", line = old + "\ncoupling: {";
  expect_refused(with(old, line + "lubrication: normal}"), 25, "lubrication", "resolve_from");
  expect_refused(with(old, line + "resolve_from: 4, lubrication_roughness: 1e-3}"), 25,
                 "lubrication_roughness", "lubrication: normal");
  expect_refused(with(old, line + "resolve_from: 4, lubrication: normel}"), 25, "lubrication", "normal");
  const std::string films = "resolve_from: 4, lubrication: normal}";
  expect_refused(with(old, line + films), 25, "lubrication", "spheres");
  std::string spheres = with(old, line + films);
  const std::string blocks = "{kind: superquadric, blockiness: [2, 4]}";
  spheres.replace(spheres.find(blocks), blocks.size(), "{kind: sphere}");
  EXPECT_TRUE(problems_of(spheres).empty());
}

}  // namespace
}  // namespace sluice
