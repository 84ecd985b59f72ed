#include "processes/process_document.h"

#include "processes/sample.h"

namespace sluice::sample {
namespace {

using ProcessDocumentTest = InAFolder;

TEST_F(ProcessDocumentTest, AMissingProcessFileIsTheEnvironmentsFault) {
  EXPECT_THROW(ProcessDocument::read(folder_ / "none.yaml"), EnvironmentError);
  EXPECT_THROW(ProcessDocument::read(folder_), EnvironmentError);
}

TEST_F(ProcessDocumentTest, SyntaxErrorsHaveLineAndColumn) {
  EXPECT_EQ(wrong("title: a\noutput: {every: 1 s\n").substr(0, 28), "process.yaml:3:1: is not YAM");
  EXPECT_EQ(wrong("title: a\n\tseed: 1\n").substr(0, 17), "process.yaml:2:1:");
}

TEST_F(ProcessDocumentTest, NoticesAQuoteThatIsNeverClosed) {
  for (const char* title : {"\"a", "'a", "'a''", "\"a\\\""})
    EXPECT_EQ(wrong(std::string("title: ") + title + "\nseed: 1\n"),
              "process.yaml:1:8: is not YAML: a quote is never closed close it")
        << title;
  EXPECT_EQ(wrong("seed: 1\n'title: a\n").substr(0, 17), "process.yaml:2:1:");
  EXPECT_EQ(read("title: \"it's \\\"here\\\"\"\n").title, "it's \"here\"");
  EXPECT_EQ(read("title: 'it''s'\n").title, "it's");
}

TEST_F(ProcessDocumentTest, RefusesWhatIsNotOneSection) {
  EXPECT_EQ(wrong(""),
            "process.yaml:1:1: the file is empty (a section with keys is needed) write 'key: value' lines");
  EXPECT_EQ(wrong("# nothing\n"),
            "process.yaml:1:1: the file is empty (a section with keys is needed) write 'key: value' lines");
  EXPECT_EQ(wrong("- a\n- b\n"),
            "process.yaml:1:1: the file is a list (a section with keys is needed) write 'key: value' lines");
  EXPECT_NE(wrong("title: a\n---\ntitle: b\n").find("a second document begins"), std::string::npos);
  EXPECT_NE(wrong("title: a\n? [x, y]\n: 3\n").find("a key is not a word"), std::string::npos);
}

TEST_F(ProcessDocumentTest, RefusesFilesOfAnotherKind) {
  EXPECT_NE(wrong(std::string(300, 'x')).find("x ...' (a section with keys is needed)"), std::string::npos);
  EXPECT_NE(wrong(std::string("\0\x01\xff\xfe garbage\0", 13)), "nothing");
  EXPECT_NE(wrong("solid plate\n facet normal 0 0 1\n"), "nothing");
}

TEST_F(ProcessDocumentTest, StopsAtAliasesWithoutEnd) {
  EXPECT_NE(wrong("title: &a [*a]\n"), "nothing");
  std::string text = "l0: &l0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string below = "*l" + std::to_string(i - 1);
    text += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " [" + below;
    for (int k = 1; k < 10; ++k) text += ", " + below;
    text += "]\n";
  }
  EXPECT_NE(wrong(text).find("nested too deeply or too large"), std::string::npos);
  EXPECT_NE(wrong("title: " + std::string(100000, '[')), "nothing");
}

TEST_F(ProcessDocumentTest, SetChangesAValue) {
  const Root root = read("title: a\nfriction: 0.1\nlayers: [{depth: 1 m}, {depth: 2 m}]\n",
                         {"friction=0.7", "layers.1.depth=30 mm", "output.every=2 s", "sizes=[1 mm, 2 mm]"});
  EXPECT_EQ(root.friction, 0.7);
  EXPECT_DOUBLE_EQ(root.layers[1].depth, 0.03);
  EXPECT_EQ(root.layers[0].depth, 1.0);
  EXPECT_EQ(root.output.every, 2.0);
  EXPECT_EQ(root.sizes.size(), 2u);
}

TEST_F(ProcessDocumentTest, SetCanAddASection) {
  const Root root = read("title: a\n", {"water.w={kind: spray, flow: 1 l/s}", "water.w.angle=90 deg"});
  ASSERT_EQ(root.water.size(), 1u);
  EXPECT_DOUBLE_EQ(root.water[0].angle, 3.14159265358979324 / 2);
}

TEST_F(ProcessDocumentTest, SetNamesItselfAsThePlace) {
  EXPECT_EQ(wrong("title: a\n", {"output.every=3 kg"}),
            "--set output.every: 'every' has unit 'kg' (a time is needed) use s, ms or min");
  EXPECT_EQ(wrong("title: a\n", {"frction=0.3"}),
            "--set frction: 'frction' is not a key (of this file) did you mean 'friction'?");
}

TEST_F(ProcessDocumentTest, SetRefusesAPathThatDoesNotExist) {
  const std::string text = "title: a\noutput: {every: 1 s}\nlayers: [{depth: 1 m}]\n";
  EXPECT_EQ(wrong(text, {"outptu.every=2 s"}),
            "--set outptu.every: 'outptu' does not exist did you mean 'output'?");
  EXPECT_EQ(wrong(text, {"layers.1.depth=2 m"}),
            "--set layers.1.depth: '1' is not an item of this list (it has 1 items, counted from 0)");
  EXPECT_EQ(wrong(text, {"title.a=2"}),
            "--set title.a: 'a' does not exist ('title' is 'a', not a section) write --set title=value");
  for (const char* bad : {"friction", "=3", ".a=3", "a..b=3", "a.=3"})
    EXPECT_NE(wrong(text, {bad}).find("is not an assignment"), std::string::npos) << bad;
  EXPECT_NE(wrong(text, {"friction="}).find("has a value that cannot be read"), std::string::npos);
}

TEST_F(ProcessDocumentTest, ExtendsChangesSomeKeysOfAnotherFile) {
  write("base/cad/plate.obj", "o plate\n");
  write("base/base.yaml",
        "title: base\nmesh: cad/plate.obj\nlayers: [{depth: 1 m}, {depth: 2 m}]\noutput: {every: 1 s, "
        "frames: false}\n");
  write("middle.yaml", "extends: base/base.yaml\nseed: 5\n");
  const Root root = read("extends: middle.yaml\ntitle: new\nlayers: [{depth: 3 m}]\noutput: {every: 2 s}\n");
  EXPECT_EQ(root.title, "new");
  EXPECT_EQ(root.seed, 5);
  EXPECT_EQ(root.mesh, folder_ / "base/cad/plate.obj");
  EXPECT_EQ(root.layers.size(), 1u);
  EXPECT_EQ(root.output.every, 2.0);
  EXPECT_FALSE(root.output.frames);
  const ProcessDocument document = ProcessDocument::read(folder_ / "process.yaml");
  EXPECT_EQ(document.files().size(), 3u);
  EXPECT_EQ(document.file(), folder_ / "process.yaml");
}

TEST_F(ProcessDocumentTest, ExtendsKeepsThePlaceOfEveryKey) {
  write("base.yaml", "title: base\n\nfriction: 7\n");
  EXPECT_EQ(wrong("extends: base.yaml\nseed: x\n"),
            "process.yaml:2:7: 'seed' is 'x' (a whole number is needed) write digits only, as in 10\n"
            "base.yaml:3:11: 'friction' is '7' (out of range) use at least 0, at most 2");
}

TEST_F(ProcessDocumentTest, ExtendsRefusesCirclesAndMissingFiles) {
  write("other.yaml", "extends: process.yaml\n");
  EXPECT_EQ(wrong("title: a\nextends: other.yaml\n"),
            "other.yaml:1:10: 'extends' names 'process.yaml', which extends this file (a file cannot extend "
            "itself) "
            "break the circle");
  EXPECT_EQ(wrong("title: a\nextends: none.yaml\n"),
            "process.yaml:2:10: 'extends' names 'none.yaml', which is not there (the path is relative to "
            "this file) "
            "check the path");
  EXPECT_EQ(
      wrong("title: a\nextends: [b]\n"),
      "process.yaml:2:10: 'extends' is a list (the name of one file is needed) write 'extends: other.yaml'");
}

}  // namespace
}  // namespace sluice::sample
