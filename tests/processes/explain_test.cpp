#include "processes/key_list.h"
#include "processes/sample.h"

namespace sluice::sample {
namespace {

TEST(Explain, ListsEveryKeyWithItsPath) {
  const std::string all = explain_all(process_keys<Root>());
  for (const char* path : {"extends\n",
                           "title\n",
                           "seed\n",
                           "mesh\n",
                           "tags\n",
                           "sizes\n",
                           "friction\n",
                           "water\n",
                           "water.<name>.kind\n",
                           "water.<name>.flow\n",
                           "water.<name>.bore\n",
                           "water.<name>.angle\n",
                           "water.<name>.offset\n",
                           "water.<name>.at\n",
                           "water.<name>.direction\n",
                           "layers\n",
                           "layers.<n>.depth\n",
                           "output\n",
                           "output.every\n",
                           "output.frames\n",
                           "restart\n",
                           "restart.generation\n"})
    EXPECT_NE(all.find(path), std::string::npos) << path;
}

TEST(Explain, TellsMeaningUnitRangeDefaultAndWhenAKeyApplies) {
  const auto keys = process_keys<Root>();
  EXPECT_EQ(explain_one(keys, "water.left.bore"),
            "water.<name>.bore\n"
            "  meaning   inner diameter\n"
            "  value     a length (m, mm or in)\n"
            "  range     above 0 m, at most 2 m\n"
            "  default   none: it is required\n"
            "  only with kind: pipe\n");
  EXPECT_EQ(explain_one(keys, "output.every"),
            "output.every\n"
            "  meaning   time between frames\n"
            "  value     a time (s, ms or min)\n"
            "  range     above 0 s\n"
            "  default   100 ms\n");
  EXPECT_NE(explain_one(keys, "water.flow").find("  example   flow: 450 m3/h\n"), std::string::npos);
  EXPECT_NE(explain_one(keys, "kind").find("one of pipe, spray"), std::string::npos);
}

TEST(Explain, ListsKeysOfAnotherKindThanTheDefault) {
  // `angle` does not apply to a struct as it is built: it is listed all the same.
  const std::string angle = explain_one(process_keys<Root>(), "angle");
  EXPECT_NE(angle.find("only with kind: spray"), std::string::npos);
  EXPECT_NE(angle.find("opening angle"), std::string::npos);
}

TEST(Explain, FindsAKeyByItsPathOrItsEnd) {
  const auto keys = process_keys<Root>();
  const std::string whole = explain_one(keys, "water.<name>.bore");
  for (const char* query : {"water.left.bore", "water.bore", "bore", "<name>.bore"})
    EXPECT_EQ(explain_one(keys, query), whole) << query;
  EXPECT_EQ(explain_one(keys, "layers.0.depth"), explain_one(keys, "depth"));
}

TEST(Explain, ASectionShowsWhatIsBelowIt) {
  const std::string output = explain_one(process_keys<Root>(), "output");
  EXPECT_NE(output.find("output.every\n"), std::string::npos);
  EXPECT_NE(output.find("output.frames\n    true or false; default true\n    write frames\n"),
            std::string::npos);
}

TEST(Explain, SuggestsTheNearestKey) {
  const auto keys = process_keys<Root>();
  const auto refusal = [&](const char* query) -> std::string {
    try {
      return explain_one(keys, query);
    } catch (const InputError& e) {
      return e.what();
    }
  };
  EXPECT_EQ(refusal("output.evry"), "'output.evry' is not a key did you mean 'output.every'?");
  EXPECT_EQ(refusal("frictoin"), "'frictoin' is not a key did you mean 'friction'?");
  EXPECT_EQ(refusal("zzzzzz"), "'zzzzzz' is not a key see `sluice explain` for all keys");
}

struct TwoKinds {
  bool wide = false;
  double size = 1;
  void keys(Schema& s) {
    s.number("size", size, {.unit = "m", .applies = !wide, .applies_to = "wide: false"});
    s.number("size", size, {.unit = "m", .applies = wide, .applies_to = "wide: true"});
  }
};

TEST(Explain, AKeyDeclaredOnceAKindIsListedOnce) {
  const auto keys = keys_of<TwoKinds>();
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].applies_to, "wide: false; wide: true");
}

}  // namespace
}  // namespace sluice::sample
