// Motions of walls in a process file: read with their units, refused where they cannot be.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "base/errors.h"
#include "processes/build_parts.h"
#include "processes/key_list.h"
#include "processes/sample.h"

namespace sluice {
namespace {

using std::numbers::pi;

const std::string plate_obj =
    "o plate\nv 0.2 0.2 0.5\nv 0.8 0.2 0.5\nv 0.8 0.8 0.5\nv 0.2 0.8 0.5\nf 1 2 3\nf 1 3 4\n";

/// Stones on a plate; the plate's further keys are put in place of the dots, from line 18 on.
const std::string scene = R"(title: A plate that moves
duration: 0.5 s
domain:
  low: [0 m, 0 m, 0 m]
  high: [1 m, 1 m, 2 m]
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
    material: steel
    surface_velocity: [0.1 m/s, 0 m/s, 0 m/s]
...
rocks:
  impact_speed: 2 m/s
rock_fills:
  stones:
    low: [0.1 m, 0.1 m, 1 m]
    high: [0.9 m, 0.9 m, 1.9 m]
    count: 5
    material: rock
    sizes: {curve: points, points: [{size: 40 mm, passing: 0}, {size: 60 mm, passing: 1}], cutoff: 40 mm}
)";

class WallMotionInput : public sample::InAFolder {
 protected:
  void SetUp() override {
    InAFolder::SetUp();
    write("plate.obj", plate_obj);
  }
  static std::string with(const std::string& keys) {
    std::string text = scene;
    text.replace(text.find("..."), 3, keys);
    return text;
  }
  ProcessConfig read_scene(const std::string& keys) const {
    return read_process(write("process.yaml", with(keys)), {});
  }
  void expect_refused(const std::string& keys, int line, const std::string& key,
                      const std::string& words) const {
    try {
      build_parts(read_scene(keys));
    } catch (const InputError& e) {
      const InputProblem& p = e.problems().front();
      EXPECT_EQ(p.where.file, (folder_ / "process.yaml").string()) << p.text();
      EXPECT_EQ(p.where.line, line) << p.text();
      EXPECT_EQ(p.key, key) << p.text();
      EXPECT_FALSE(p.suggestion.empty()) << p.text();
      EXPECT_NE(p.text().find(words), std::string::npos) << p.text();
      return;
    }
    ADD_FAILURE() << "accepted, but '" << key << "' is wrong";
  }
};

TEST_F(WallMotionInput, ReadsAScreenBoxInPlantUnits) {
  const ProcessConfig config = read_scene(
      "    motion: {kind: vibration, direction: [1, 0, 1], stroke: 8 mm, frequency: 900 rpm, phase: 90 deg,\n"
      "      cross_direction: [-1, 0, 1], cross_stroke: 3 mm, start: 0.5 s, ramp: 1 s}");
  const WallMotion& m = *config.walls[0].motion;
  EXPECT_EQ(m.kind, MotionKind::vibration);
  EXPECT_DOUBLE_EQ(m.stroke, 0.008);
  EXPECT_DOUBLE_EQ(m.frequency, 15);
  EXPECT_DOUBLE_EQ(m.phase, pi / 2);
  EXPECT_DOUBLE_EQ(m.cross_stroke, 0.003);
  const BuiltProcess built = build_parts(config);
  EXPECT_EQ(*built.parts.walls->all()[0].motion, m);
  EXPECT_EQ(built.parts.walls->all()[0].surface_velocity, Vec3(0.1, 0, 0));
  const std::vector<std::string> present = built.parts.present();
  EXPECT_NE(std::find(present.begin(), present.end(), "1 moving wall"), present.end());
}

TEST_F(WallMotionInput, ReadsARotationInTurnsAMinute) {
  const ProcessConfig config =
      read_scene("    motion: {kind: rotation, axis: [0, 1, 0], centre: [0.5 m, 0 m, 0.5 m], speed: 30 rpm}");
  EXPECT_NEAR(config.walls[0].motion->speed, pi, 1e-14);
  EXPECT_EQ(config.walls[0].motion->centre, Vec3(0.5, 0, 0.5));
}

TEST_F(WallMotionInput, ReadsKeyframes) {
  const ProcessConfig config = read_scene(
      "    motion:\n      kind: keyframes\n      centre: [0.5 m, 0.5 m, 0.5 m]\n      keyframes:\n"
      "        - {time: 0 s}\n        - {time: 2 s, shift: [0 m, 0 m, 100 mm], turn: [0 deg, 30 deg, 0 "
      "deg]}");
  const WallMotion& m = *config.walls[0].motion;
  ASSERT_EQ(m.keyframes.size(), 2u);
  EXPECT_EQ(m.keyframes[1].shift, Vec3(0, 0, 0.1));
  EXPECT_NEAR(m.keyframes[1].turn.y(), pi / 6, 1e-15);
  EXPECT_NO_THROW(build_parts(config));
}

TEST_F(WallMotionInput, LeavesAWallWithoutItStanding) {
  const ProcessConfig config = read_scene("");
  EXPECT_FALSE(config.walls[0].motion);
  const std::vector<std::string> present = build_parts(config).parts.present();
  EXPECT_NE(std::find(present.begin(), present.end(), "1 wall"), present.end());
}

TEST_F(WallMotionInput, MayMissAKeyOfItsKind) {
  expect_refused("    motion: {kind: vibration, direction: [1, 0, 1], stroke: 8 mm}", 18, "frequency",
                 "is missing");
  expect_refused("    motion: {kind: rotation, axis: [0, 1, 0], speed: 30 rpm}", 18, "centre", "is missing");
}

TEST_F(WallMotionInput, MayHaveAKeyOfAnotherKind) {
  expect_refused(
      "    motion: {kind: rotation, axis: [0, 1, 0], centre: [0 m, 0 m, 0 m], speed: 3 rpm, stroke: 8 mm}",
      18, "stroke", "kind: vibration");
}

TEST_F(WallMotionInput, MayHaveNoDirectionOrSpeed) {
  expect_refused("    motion: {kind: vibration, direction: [0, 0, 0], stroke: 8 mm, frequency: 15 Hz}", 18,
                 "direction", "it has no direction");
  expect_refused("    motion: {kind: rotation, axis: [0, 0, 1], centre: [0 m, 0 m, 0 m], speed: 0 rpm}", 18,
                 "speed", "is zero");
}

TEST_F(WallMotionInput, MayHaveASecondStrokeWithoutALength) {
  expect_refused(
      "    motion: {kind: vibration, direction: [1, 0, 0], stroke: 8 mm, frequency: 15 Hz,\n"
      "      cross_direction: [0, 0, 1]}",
      19, "cross_direction", "without 'cross_stroke'");
}

TEST_F(WallMotionInput, MayHaveKeyframesOutOfOrderOrTooFew) {
  expect_refused("    motion: {kind: keyframes, keyframes: [{time: 1 s}, {time: 1 s}]}", 18, "keyframes",
                 "times ascend");
  expect_refused("    motion: {kind: keyframes, keyframes: [{time: 1 s}]}", 18, "keyframes", "has 1 entry");
}

TEST_F(WallMotionInput, MayJumpWhereItRepeats) {
  expect_refused(
      "    motion: {kind: keyframes, after_last: repeat, keyframes: [{time: 0 s},\n"
      "      {time: 1 s, shift: [0 m, 0 m, 1 mm]}]}",
      18, "keyframes", "does not end where it begins");
}

TEST_F(WallMotionInput, MayMoveAWallThatBlocksWater) {
  const std::string water =
      "    motion: {kind: vibration, direction: [1, 0, 1], stroke: 8 mm, frequency: 15 Hz}\n"
      "water:\n  spacing: 100 mm\n  fastest_bulk_speed: 2 m/s\n"
      "water_fills:\n  pool:\n    low: [0.1 m, 0.1 m, 0.1 m]\n    high: [0.9 m, 0.9 m, 0.4 m]";
  EXPECT_NO_THROW(build_parts(read_scene(water)));
}

TEST_F(WallMotionInput, MayLeaveTheDomain) {
  expect_refused(
      "    motion: {kind: keyframes, keyframes: [{time: 0 s}, {time: 9 s, shift: [3 m, 0 m, 0 m]}]}", 18,
      "motion", "enlarge the domain");
}

TEST_F(WallMotionInput, MayBeTooFastForTheStep) {
  expect_refused("    motion: {kind: vibration, direction: [1, 0, 1], stroke: 1 um, frequency: 50 kHz}", 18,
                 "motion", "time steps of the rocks");
}

TEST_F(WallMotionInput, WarnsOfAWallThatReachesOutOrOutrunsTheImpactSpeed) {
  const BuiltProcess built = build_parts(read_scene(
      "    motion: {kind: rotation, axis: [0, 0, 1], centre: [0.8 m, 0.5 m, 0.5 m], speed: 4 rad/s}"));
  ASSERT_EQ(built.warnings.size(), 2u);
  EXPECT_NE(built.warnings[0].find("out of the domain"), std::string::npos);
  EXPECT_NE(built.warnings[1].find("impact_speed"), std::string::npos);
}

TEST_F(WallMotionInput, IsExplained) {
  const std::string text = explain_one(process_keys<ProcessConfig>(), "walls.motion.stroke");
  EXPECT_NE(text.find("from end to end"), std::string::npos) << text;
  EXPECT_NE(text.find("kind: vibration"), std::string::npos) << text;
}

}  // namespace
}  // namespace sluice
