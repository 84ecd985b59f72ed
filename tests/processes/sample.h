#pragma once
/// A small root struct that uses every feature of the schema, and a folder to write files into.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "base/schema.h"
#include "processes/process_document.h"

namespace sluice::sample {

enum class Kind { pipe, spray };

struct Water {
  std::string name;
  Kind kind = Kind::pipe;
  double flow = 0;                ///< [m3/s]
  double bore = 0;                ///< [m]
  double angle = 0.5;             ///< [rad]
  std::optional<double> offset;   ///< [m]
  Vec3 at = Vec3::Zero();         ///< [m]
  std::optional<Vec3> direction;  ///< unit vector
  std::optional<Location> bore_at;

  void keys(Schema& s) {
    s.choice("kind", kind, {{"pipe", Kind::pipe}, {"spray", Kind::spray}},
             {.required = true, .doc = "what it is"});
    s.number("flow", flow,
             {.unit = "m3/s", .required = true, .above = 0, .doc = "volume flow", .example = "450 m3/h"});
    s.number("bore", bore,
             {.unit = "m",
              .required = true,
              .above = 0,
              .at_most = 2,
              .doc = "inner diameter",
              .applies = kind == Kind::pipe,
              .applies_to = "kind: pipe"});
    s.number(
        "angle", angle,
        {.unit = "rad", .doc = "opening angle", .applies = kind == Kind::spray, .applies_to = "kind: spray"});
    s.number("offset", offset, {.unit = "m", .doc = "from the axis"});
    s.vector("at", at, {.unit = "m", .doc = "where it stands"});
    s.vector("direction", direction, {.doc = "where it points"});
    if (s.given("bore")) bore_at = s.at("bore");
  }
};

struct Layer {
  double depth = 0;  ///< [m]
  void keys(Schema& s) {
    s.number("depth", depth, {.unit = "m", .required = true, .at_least = 0, .doc = "thickness"});
  }
};

struct Output {
  double every = 0.1;  ///< [s]
  bool frames = true;
  void keys(Schema& s) {
    s.number("every", every, {.unit = "s", .above = 0, .doc = "time between frames"});
    s.flag("frames", frames, {.doc = "write frames"});
  }
};

struct Restart {
  std::int64_t generation = 0;
  void keys(Schema& s) { s.integer("generation", generation, {.at_least = 0, .doc = "which one"}); }
};

struct Root {
  std::string title = "untitled";
  std::int64_t seed = 1;
  std::filesystem::path mesh;
  std::vector<std::string> tags;
  std::vector<double> sizes;  ///< [m]
  std::vector<Water> water;
  std::vector<Layer> layers;
  Output output;
  std::optional<Restart> restart;
  double friction = 0.5;

  void keys(Schema& s) {
    s.text("title", title, {.required = true, .doc = "heading of the page", .example = "Feed box"});
    s.integer("seed", seed, {.at_least = 0, .at_most = 1000, .doc = "of the random numbers"});
    s.file("mesh", mesh, {.doc = "a CAD file"});
    s.texts("tags", tags, {.doc = "words to find it by"});
    s.numbers("sizes", sizes, {.unit = "m", .above = 0, .doc = "passing sizes"});
    s.number("friction", friction, {.at_least = 0, .at_most = 2, .doc = "Coulomb coefficient"});
    s.named("water", water, {.doc = "where water comes from"});
    s.list("layers", layers, {.doc = "layers of rock"});
    s.section("output", output, {.doc = "what is written"});
    s.section("restart", restart, {.doc = "where to go on"});
    if (sizes.size() == 1) s.problem("sizes", "has one item", "a range is needed", "give two");
  }
};

/// A fresh folder for one test, removed at its end.
class InAFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("sluice-" + std::to_string(getpid()) + "-" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path;
  }
  Root read(const std::string& text, const std::vector<std::string>& sets = {}) const {
    return read_file(write("process.yaml", text), sets);
  }
  static Root read_file(const std::filesystem::path& path, const std::vector<std::string>& sets = {}) {
    ProcessDocument document = ProcessDocument::read(path, sets);
    Root root = document.as<Root>();
    document.finish();
    return root;
  }
  /// What is wrong with a text, a line a problem, without the folder's name.
  std::string wrong(const std::string& text, const std::vector<std::string>& sets = {}) const {
    return wrong_file(write("process.yaml", text), sets);
  }
  std::string wrong_file(const std::filesystem::path& path, const std::vector<std::string>& sets = {}) const {
    try {
      read_file(path, sets);
    } catch (const InputError& e) {
      std::string all = e.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t i = all.find(prefix); i != std::string::npos; i = all.find(prefix))
        all.erase(i, prefix.size());
      return all;
    }
    return "nothing";
  }

  std::filesystem::path folder_;
};

}  // namespace sluice::sample
