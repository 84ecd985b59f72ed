#include <regex>

#include "processes/key_list.h"
#include "processes/parse_yaml.h"
#include "processes/sample.h"

namespace sluice::sample {
namespace {

/// The schema as a tree: JSON is YAML.
InputNode schema_tree() {
  std::vector<InputProblem> problems;
  InputNode tree =
      parse_yaml(json_schema(process_keys<Root>(), "Sluice process"), "schema.json", "", problems);
  EXPECT_TRUE(problems.empty());
  return tree;
}

const InputNode& at(const InputNode& node, const std::vector<std::string>& path) {
  const InputNode* here = &node;
  for (const std::string& key : path) {
    const InputEntry* entry = here->find(key);
    if (!entry) throw std::out_of_range("no '" + key + "'");
    here = &entry->value;
  }
  return *here;
}

std::vector<std::string> items(const InputNode& node) {
  std::vector<std::string> texts;
  for (const InputNode& item : node.list) texts.push_back(item.scalar);
  return texts;
}

TEST(JsonSchema, SaysWhichDraftItIs) {
  EXPECT_EQ(at(schema_tree(), {"$schema"}).scalar, "https://json-schema.org/draft/2020-12/schema");
}

TEST(JsonSchema, RefusesUnknownKeysAndAsksForRequiredOnes) {
  const InputNode tree = schema_tree();
  EXPECT_EQ(at(tree, {"else", "additionalProperties"}).scalar, "false");
  EXPECT_EQ(items(at(tree, {"else", "required"})), std::vector<std::string>{"title"});
  const InputNode& water = at(tree, {"else", "properties", "water", "additionalProperties"});
  EXPECT_EQ(items(at(water, {"required"})), (std::vector<std::string>{"kind", "flow"}));
  EXPECT_EQ(at(water, {"additionalProperties"}).scalar, "false");
}

TEST(JsonSchema, AsksForNothingWhereAnotherFileIsExtended) {
  const InputNode tree = schema_tree();
  EXPECT_FALSE(at(tree, {"then"}).find("required"));
  EXPECT_FALSE(at(tree, {"then", "properties", "water", "additionalProperties"}).find("required"));
  EXPECT_TRUE(at(tree, {"then", "properties", "layers", "items"}).find("required"));
}

TEST(JsonSchema, NumbersWithAUnitAreTextAndThePatternKnowsThem) {
  const InputNode tree = schema_tree();
  const InputNode& every = at(tree, {"else", "properties", "output", "properties", "every"});
  EXPECT_EQ(at(every, {"type"}).scalar, "string");
  const std::regex pattern(at(every, {"pattern"}).scalar);
  for (const char* good : {"1 s", "0.5 ms", ".5 s", "1e-3 s", "-2 s", "25mm", "3 1/s", "35 °", "10 %"})
    EXPECT_TRUE(std::regex_search(good, pattern)) << good;
  for (const char* bad : {"1", "s", "010 s", "", "one s", "1 2 s", "."})
    EXPECT_FALSE(std::regex_search(bad, pattern)) << bad;
}

TEST(JsonSchema, PlainNumbersKeepTheirRange) {
  const InputNode tree = schema_tree();
  const InputNode& friction = at(tree, {"else", "properties", "friction"});
  ASSERT_EQ(at(friction, {"anyOf"}).list.size(), 2u);
  EXPECT_EQ(at(at(friction, {"anyOf"}).list[0], {"minimum"}).scalar, "0");
  EXPECT_EQ(at(at(friction, {"anyOf"}).list[0], {"maximum"}).scalar, "2");
  EXPECT_EQ(at(tree, {"else", "properties", "seed", "type"}).scalar, "integer");
  EXPECT_EQ(at(tree, {"else", "properties", "seed", "maximum"}).scalar, "1000");
}

TEST(JsonSchema, ChoicesListTheirWordsAndVectorsHaveThreeItems) {
  const InputNode tree = schema_tree();
  const InputNode& water = at(tree, {"else", "properties", "water", "additionalProperties", "properties"});
  EXPECT_EQ(items(at(water, {"kind", "enum"})), (std::vector<std::string>{"pipe", "spray"}));
  EXPECT_EQ(at(water, {"at", "minItems"}).scalar, "3");
  EXPECT_EQ(at(water, {"at", "maxItems"}).scalar, "3");
}

TEST(JsonSchema, DescriptionsSayMeaningUnitRangeAndDefault) {
  EXPECT_EQ(at(schema_tree(), {"else", "properties", "output", "properties", "every", "description"}).scalar,
            "time between frames; a time (s, ms or min); above 0 s; default 100 ms");
}

struct Awkward {
  double x = 0;
  void keys(Schema& s) { s.number("x", x, {.doc = "a \"quoted\" \\ word\nand a line"}); }
};

TEST(JsonSchema, EscapesWhatJsonDemands) {
  std::vector<InputProblem> problems;
  const InputNode tree = parse_yaml(json_schema(keys_of<Awkward>(), "x"), "schema.json", "", problems);
  EXPECT_EQ(at(tree, {"else", "properties", "x", "description"}).scalar,
            "a \"quoted\" \\ word\nand a line; default 0");
}

}  // namespace
}  // namespace sluice::sample
