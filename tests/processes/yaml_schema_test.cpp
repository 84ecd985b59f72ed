#include "processes/yaml_schema.h"

#include "processes/sample.h"

namespace sluice::sample {
namespace {

using YamlSchemaTest = InAFolder;

TEST_F(YamlSchemaTest, ReadsEveryFeature) {
  write("cad/plate.obj", "o plate\n");
  const Root root = read(R"(
title: Feed box 3
seed: 7
mesh: cad/plate.obj
tags: [wet, "1200"]
sizes: [25 mm, 0.1 m]
friction: 40 %
water:
  left: {kind: pipe, flow: 450 m3/h, bore: 90 mm, at: [1 m, 20 mm, -3 m], direction: [0, 0, -1]}
  right:
    kind: spray
    flow: 60 l/min
    angle: 180 deg
    offset: 1 in
layers:
  - depth: 10 mm
  - {depth: 0 m}
output: {every: 20 ms, frames: false}
restart: {generation: 2}
)");
  EXPECT_EQ(root.title, "Feed box 3");
  EXPECT_EQ(root.seed, 7);
  EXPECT_EQ(root.mesh, folder_ / "cad/plate.obj");
  EXPECT_EQ(root.tags, (std::vector<std::string>{"wet", "1200"}));
  ASSERT_EQ(root.sizes.size(), 2u);
  EXPECT_DOUBLE_EQ(root.sizes[0], 0.025);
  EXPECT_DOUBLE_EQ(root.friction, 0.4);
  ASSERT_EQ(root.water.size(), 2u);
  EXPECT_EQ(root.water[0].name, "left");
  EXPECT_DOUBLE_EQ(root.water[0].flow, 0.125);
  EXPECT_DOUBLE_EQ(root.water[0].bore, 0.09);
  EXPECT_LT((root.water[0].at - Vec3(1, 0.02, -3)).norm(), 1e-15);
  EXPECT_EQ(root.water[0].direction, Vec3(0, 0, -1));
  EXPECT_FALSE(root.water[0].offset);
  ASSERT_TRUE(root.water[0].bore_at);
  EXPECT_EQ(root.water[0].bore_at->line, 9);
  EXPECT_EQ(root.water[1].kind, Kind::spray);
  EXPECT_DOUBLE_EQ(root.water[1].angle, 3.14159265358979324);
  EXPECT_DOUBLE_EQ(root.water[1].offset.value(), 0.0254);
  ASSERT_EQ(root.layers.size(), 2u);
  EXPECT_DOUBLE_EQ(root.layers[0].depth, 0.01);
  EXPECT_DOUBLE_EQ(root.output.every, 0.02);
  EXPECT_FALSE(root.output.frames);
  ASSERT_TRUE(root.restart);
  EXPECT_EQ(root.restart->generation, 2);
}

TEST_F(YamlSchemaTest, KeepsDefaultsOfWhatIsLeftOut) {
  const Root root = read("title: short\n");
  EXPECT_EQ(root.seed, 1);
  EXPECT_EQ(root.output.every, 0.1);
  EXPECT_FALSE(root.restart);
  EXPECT_TRUE(root.water.empty());
}

TEST_F(YamlSchemaTest, NamesTheKeyThatWasMeant) {
  EXPECT_EQ(wrong("title: a\nfricton: 0.3\n"),
            "process.yaml:2:1: 'fricton' is not a key (of this file) did you mean 'friction'?");
  EXPECT_EQ(wrong("title: a\noutput:\n  evrey: 1 s\n"),
            "process.yaml:3:3: 'evrey' is not a key (of 'output') did you mean 'every'?");
}

TEST_F(YamlSchemaTest, ListsTheKeysWhereNoneIsNear) {
  EXPECT_EQ(wrong("title: a\noutput:\n  colour: red\n"),
            "process.yaml:3:3: 'colour' is not a key (of 'output') use one of every, frames");
}

TEST_F(YamlSchemaTest, NoticesAKeyGivenTwice) {
  EXPECT_EQ(wrong("title: a\nseed: 1\ntitle: b\n"),
            "process.yaml:3:1: 'title' is given twice (it stands in line 1 already) keep one");
}

TEST_F(YamlSchemaTest, NoticesASectionLeftEmpty) {
  EXPECT_EQ(wrong("title: a\noutput:\nseed: 1\n"),
            "process.yaml:2:1: 'output' is empty (what is written) write 'output: {...}' or leave it out");
  EXPECT_EQ(
      wrong("title: a\nwater:\n  left:\n"),
      "process.yaml:3:3: 'left' is empty (a section with keys is needed) write its keys below it, indented");
  EXPECT_EQ(
      wrong("title: ~\n"),
      "process.yaml:1:1: 'title' is empty (heading of the page) write 'title: Feed box' or leave it out");
}

TEST_F(YamlSchemaTest, NamesWhatIsMissingAndWhere) {
  EXPECT_EQ(wrong("title: a\nwater:\n  left: {kind: pipe, bore: 90 mm}\n"),
            "process.yaml:3:3: 'flow' is missing (volume flow) add 'flow: 450 m3/h'");
}

TEST_F(YamlSchemaTest, SaysUnknownKeysBeforeMissingOnes) {
  EXPECT_EQ(wrong("titel: a\nlayers:\n  - dept: 1 m\nsed: 3\n"),
            "process.yaml:1:1: 'titel' is not a key (of this file) did you mean 'title'?\n"
            "process.yaml:3:5: 'dept' is not a key (of 'layers') did you mean 'depth'?\n"
            "process.yaml:4:1: 'sed' is not a key (of this file) did you mean 'seed'?\n"
            "process.yaml:1:1: 'title' is missing (heading of the page) add 'title: Feed box'\n"
            "process.yaml:3:5: 'depth' is missing (thickness) add 'depth: 1 m'");
}

TEST_F(YamlSchemaTest, RefusesAnotherUnit) {
  EXPECT_EQ(wrong("title: a\nlayers:\n  - depth: 3 kg\n"),
            "process.yaml:3:12: 'depth' has unit 'kg' (a length is needed) use m, mm or in");
}

TEST_F(YamlSchemaTest, RefusesABareNumberWhereADimensionIsNeeded) {
  EXPECT_EQ(wrong("title: a\nlayers:\n  - depth: 3\n"),
            "process.yaml:3:12: 'depth' is '3', without a unit (a length is needed) use m, mm or in");
}

TEST_F(YamlSchemaTest, RefusesAUnitWhereNoneBelongs) {
  EXPECT_EQ(wrong("title: a\nfriction: 0.3 m\n"),
            "process.yaml:2:11: 'friction' has unit 'm' (a plain number is needed) leave the unit out");
}

TEST_F(YamlSchemaTest, RefusesNotANumberAndInfinity) {
  for (const char* value : {".nan", "nan", ".inf", "-inf", "1e999"})
    EXPECT_NE(wrong(std::string("title: a\nfriction: ") + value + "\n").find("a finite number is needed"),
              std::string::npos)
        << value;
}

TEST_F(YamlSchemaTest, RefusesNumbersThatSomeReadAsOctal) {
  EXPECT_EQ(
      wrong("title: a\nseed: 010\n"),
      "process.yaml:2:7: 'seed' is '010' (a number with a leading zero is octal to some readers and decimal "
      "to others) write '10'");
  EXPECT_NE(wrong("title: a\nfriction: 01\n"), "nothing");
  EXPECT_NE(wrong("title: a\nlayers: [{depth: 010 mm}]\n"), "nothing");
}

TEST_F(YamlSchemaTest, RefusesValuesOutOfRange) {
  EXPECT_EQ(wrong("title: a\nfriction: 2.5\n"),
            "process.yaml:2:11: 'friction' is '2.5' (out of range) use at least 0, at most 2");
  EXPECT_EQ(wrong("title: a\noutput: {every: 0 s}\n"),
            "process.yaml:2:17: 'every' is '0 s' (out of range) use above 0 s");
  EXPECT_EQ(wrong("title: a\nseed: -1\n"),
            "process.yaml:2:7: 'seed' is '-1' (out of range) use at least 0, at most 1000");
  EXPECT_EQ(wrong("title: a\nsizes: [1 mm, -1 mm]\n"),
            "process.yaml:2:15: 'sizes' is '-1 mm' (out of range) use above 0 m");
}

struct Angles {
  double up_to = 0, short_of = 0;  ///< [rad]
  void keys(Schema& s) {
    constexpr double right = 3.14159265358979324 / 2;
    s.number("up_to", up_to, {.unit = "rad", .at_least = -right, .at_most = right});
    s.number("short_of", short_of, {.unit = "rad", .below = right});
  }
};

TEST_F(YamlSchemaTest, ABoundIsTheBoundInAnyUnit) {
  for (const char* text : {"90 deg", "5400 arcmin", "1.5707963267948966 rad", "0.25 turn"}) {
    ProcessDocument closed = ProcessDocument::read(write("a.yaml", std::string("up_to: ") + text + "\n"));
    EXPECT_EQ(closed.as<Angles>().up_to, 3.14159265358979324 / 2) << text;
    EXPECT_NO_THROW(closed.finish()) << text;
    ProcessDocument open = ProcessDocument::read(write("b.yaml", std::string("short_of: ") + text + "\n"));
    open.as<Angles>();
    EXPECT_THROW(open.finish(), InputError) << text;
  }
}

TEST_F(YamlSchemaTest, SaysThatMergeKeysAreNotRead) {
  EXPECT_EQ(
      wrong("title: a\noutput:\n  <<: {every: 1 s}\n"),
      "process.yaml:3:3: '<<' is not read (merge keys are no part of YAML 1.2) write the keys out, or use "
      "'extends' at the top of the file");
}

TEST_F(YamlSchemaTest, RefusesAKeyThatDoesNotApply) {
  EXPECT_EQ(wrong("title: a\nwater:\n  w: {kind: pipe, flow: 1 l/s, bore: 9 mm, angle: 3 deg}\n"),
            "process.yaml:3:44: 'angle' does not apply here (it belongs to kind: spray) leave it out");
}

TEST_F(YamlSchemaTest, RefusesAnUnknownWordAndDoesNotGuessWhatApplies) {
  EXPECT_EQ(wrong("title: a\nwater:\n  w: {kind: spry, flow: 1 l/s, angle: 3 deg}\n"),
            "process.yaml:3:13: 'kind' is 'spry' (one of pipe, spray is needed) did you mean 'spray'?");
}

TEST_F(YamlSchemaTest, RefusesAnotherType) {
  EXPECT_EQ(wrong("title: [a]\n"),
            "process.yaml:1:8: 'title' is a list (text is needed) write 'title: Feed box'");
  EXPECT_EQ(wrong("title: a\nseed: many\n"),
            "process.yaml:2:7: 'seed' is 'many' (a whole number is needed) write digits only, as in 10");
  EXPECT_EQ(wrong("title: a\nseed: 1.5\n"),
            "process.yaml:2:7: 'seed' is '1.5' (a whole number is needed) write digits only, as in 10");
  EXPECT_EQ(wrong("title: a\noutput: {frames: yes}\n"),
            "process.yaml:2:18: 'frames' is 'yes' (true or false is needed) write true or false");
  EXPECT_EQ(wrong("title: a\nfriction: {a: 1}\n"),
            "process.yaml:2:11: 'friction' is a section (a number is needed) write '1'");
  EXPECT_EQ(
      wrong("title: a\noutput: 3\n"),
      "process.yaml:2:9: 'output' is '3' (a section with keys is needed) write its keys below it, indented");
  EXPECT_EQ(
      wrong("title: a\nlayers: {depth: 3 m}\n"),
      "process.yaml:2:9: 'layers' is a section (a list of sections is needed) begin each item with '- '");
  EXPECT_EQ(wrong("title: a\nwater: [{kind: pipe}]\n"),
            "process.yaml:2:8: 'water' is a list (names, each with a section below it, is needed) write "
            "'name:' and "
            "its keys below it, indented");
  EXPECT_EQ(wrong("title: a\nlayers: [3 m]\n"),
            "process.yaml:2:10: 'layers' is '3 m' (a section with keys is needed) write its keys below it, "
            "indented");
  EXPECT_EQ(wrong("title: a\ntags: wet\n"),
            "process.yaml:2:7: 'tags' is 'wet' (a list of words is needed) write 'tags: [one, two]'");
  EXPECT_EQ(wrong("title: a\ntags: [wet, [dry]]\n"),
            "process.yaml:2:13: 'tags' has an item that is a list (words are needed) write [one, two]");
}

TEST_F(YamlSchemaTest, RefusesVectorsWithoutThreeComponents) {
  EXPECT_EQ(wrong("title: a\nwater: {w: {kind: spray, flow: 1 l/s, at: [1 m, 2 m]}}\n"),
            "process.yaml:2:43: 'at' has 2 items ([x, y, z] is needed) write 'at: [1 m, 1 m, 1 m]'");
  EXPECT_EQ(wrong("title: a\nwater: {w: {kind: spray, flow: 1 l/s, at: [1 m, 2, 3 m]}}\n"),
            "process.yaml:2:49: 'at' is '2', without a unit (a length is needed) use m, mm or in");
}

TEST_F(YamlSchemaTest, NamesAMissingFileAndItsNearestNeighbour) {
  write("cad/plate.obj", "o plate\n");
  EXPECT_EQ(wrong("title: a\nmesh: cad/plates.obj\n"),
            "process.yaml:2:7: 'mesh' names 'cad/plates.obj', which is not there (looked for cad/plates.obj) "
            "did you "
            "mean 'plate.obj'?");
  EXPECT_EQ(wrong("title: a\nmesh: cad\n"),
            "process.yaml:2:7: 'mesh' names the folder 'cad' (a file is needed) name a file in it");
}

TEST_F(YamlSchemaTest, TakesProblemsThatAStructFindsItself) {
  EXPECT_EQ(wrong("title: a\nsizes: [1 mm]\n"),
            "process.yaml:2:1: 'sizes' has one item (a range is needed) give two");
}

TEST_F(YamlSchemaTest, ReportsEveryProblemInReadingOrder) {
  const std::string all = wrong("title: a\nseed: x\nfriction: 9\nfoo_bar_baz: 1\noutput: {every: 3 m}\n");
  std::size_t last = 0;
  for (const char* key : {"'seed'", "'friction'", "'foo_bar_baz'", "'every'"}) {
    const std::size_t found = all.find(key);
    ASSERT_NE(found, std::string::npos) << all;
    EXPECT_GE(found, last) << all;
    last = found;
  }
}

}  // namespace
}  // namespace sluice::sample
