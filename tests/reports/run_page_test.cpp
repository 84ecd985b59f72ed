#include "reports/run_page.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "output/run_folder.h"
#include "output/run_manifest.h"
#include "output/temporary_folder.h"
#include "reports/comparison_page.h"
#include "reports/page_files.h"
#include "reports/sample_run.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

std::string page_of(const fs::path& folder) {
  write_run_page(folder);
  return read_whole_file(folder / "report.html");
}

/// Without the script, whose library names a namespace by address.
std::string without_script(std::string page) {
  const std::string script(page_script());
  const std::size_t at = page.find(script);
  if (at != std::string::npos) page.erase(at, script.size());
  return page;
}

TEST(RunPage, ShowsEverySectionOfAWetRun) {
  const TemporaryFolder temporary;
  write_sample_run(temporary.path, SampleScene::wet);
  const std::string page = page_of(temporary.path);
  for (const char* id : {"summary", "pictures", "view3d", "exits", "series", "mixing", "walls", "budgets",
                         "trust", "cost", "provenance"})
    EXPECT_TRUE(has(page, std::string("<section id=\"") + id + "\"")) << id;
  for (const char* text :
       {"t/h", "water per tonne of rock", "data:image/png;base64,", "rocks.substeps", "nozzles",
        "89abcdef01234567", "0123abc", "id=\"view-data\"", "id=\"series-data\"", "completed"})
    EXPECT_TRUE(has(page, text)) << text;
  // rock through the lip: 305.5 kg/s
  EXPECT_TRUE(has(page, "1100 <small>t/h") || has(page, "1 100 <small>t/h"));
}

TEST(RunPage, EscapesWhatUsersWrote) {
  const TemporaryFolder temporary;
  write_sample_run(temporary.path, SampleScene::wet);
  const std::string page = without_script(page_of(temporary.path));
  EXPECT_TRUE(has(page, "pipes &amp; &lt;rock&gt;"));
  EXPECT_TRUE(has(page, "&lt;tags&gt;"));
  for (const char* raw : {"<rock>", "<tags>", "right side <1>"}) EXPECT_FALSE(has(page, raw)) << raw;
}

TEST(RunPage, LoadsNothingFromAnywhere) {
  const TemporaryFolder temporary;
  write_sample_run(temporary.path, SampleScene::wet);
  const std::string page = without_script(page_of(temporary.path));
  for (const char* address : {"http:", "https:", "//cdn", "src=\"/", "@import", "url("})
    EXPECT_FALSE(has(page, address)) << address;
}

TEST(RunPage, SaysWhatADryRunLeftOut) {
  const TemporaryFolder temporary;
  write_sample_run(temporary.path, SampleScene::dry);
  const std::string page = page_of(temporary.path);
  EXPECT_TRUE(has(page, "<h3>Left out</h3><div class=\"tags out\"><span>water</span><span>coupling</span>"));
  EXPECT_FALSE(has(page, "Water with its fines</text>"));
  EXPECT_FALSE(has(page, "water points inside"));
  EXPECT_TRUE(has(page, "coloured by their speed"));
}

TEST(RunPage, IsWrittenForARunThatHasOnlyAManifest) {
  const TemporaryFolder temporary;
  RunManifest m;
  m.outcome = Outcome::failed;
  m.failure = RunManifest::Failure{"water.walls", 0.25, "point 7 is <nowhere>"};
  write_manifest(temporary.path / "run.json", m);
  const std::string page = page_of(temporary.path);
  EXPECT_TRUE(has(page, "The run failed"));
  EXPECT_TRUE(has(page, "point 7 is &lt;nowhere&gt;"));
  EXPECT_FALSE(has(page, "section id=\"view3d\""));
}

TEST(RunPage, IsTheSameEveryTime) {
  const TemporaryFolder temporary;
  write_sample_run(temporary.path, SampleScene::dry);
  EXPECT_EQ(page_of(temporary.path), page_of(temporary.path));
}

TEST(RunPage, RefusesAFolderWithoutARun) {
  const TemporaryFolder temporary;
  EXPECT_THROW(write_run_page(temporary.path), EnvironmentError);
}

TEST(PageFiles, AreThoseOfTheSourceFolder) {
  const fs::path folder = fs::path(SLUICE_ROOT) / "src" / "reports" / "page";
  EXPECT_TRUE(page_script() == read_whole_file(folder / "viewer.bundle.js"));
  EXPECT_TRUE(page_style() == read_whole_file(folder / "viewer.bundle.css"));
  EXPECT_EQ(page_script().find("</script"), std::string_view::npos);
}

TEST(ComparisonPage, LaysRunsBesideEachOther) {
  const TemporaryFolder temporary;
  write_sample_run(temporary.path / "a", SampleScene::wet, 1);
  write_sample_run(temporary.path / "b", SampleScene::wet, 2);
  write_sample_run(temporary.path / "c", SampleScene::dry, 3);
  write_comparison_page({temporary.path / "a", temporary.path / "b", temporary.path / "c"},
                        temporary.path / "c.html");
  const std::string page = read_whole_file(temporary.path / "c.html");
  // alike titles are told apart by their folders
  EXPECT_TRUE(has(page, "Sample chute, pipes &amp; &lt;rock&gt; (a)"));
  EXPECT_TRUE(has(page, "Sample chute, pipes &amp; &lt;rock&gt; (b)"));
  EXPECT_TRUE(has(page, "Dry sample chute"));
  EXPECT_TRUE(has(page, "<td>lip: rock, t/h</td><td>1100</td>"));
  EXPECT_TRUE(has(page, "class=\"whisker\""));
  EXPECT_FALSE(has(page, "http"));
}

}  // namespace
}  // namespace sluice
