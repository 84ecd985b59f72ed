// The pages in a real browser: headless Chromium runs their scripts, the 3D view included.

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "output/temporary_folder.h"
#include "page/browser.h"
#include "reports/comparison_page.h"
#include "reports/run_page.h"
#include "reports/sample_run.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// Attribute of the document's root that the script leaves ("rocks").
std::string left_by_script(Browser& browser, const std::string& name) {
  return browser.value("String(document.documentElement.dataset." + name + ")");
}

std::string complaints_of(const Browser& browser) {
  std::string all;
  for (const std::string& complaint : browser.complaints()) all += complaint + "\n";
  return all;
}

std::size_t count_of(Browser& browser, const std::string& selector) {
  return browser.value("document.querySelectorAll('" + selector + "').length");
}

/// Colours, of 32 levels a channel, that the 3D view has drawn: read from its own buffer, not from the
/// screen.
int colours_of_scene(Browser& browser) {
  return browser.value(R"(new Promise(done => requestAnimationFrame(() => {
    const scene = document.querySelector('canvas[data-engine]');
    const copy = document.createElement('canvas');
    copy.width = scene.width;
    copy.height = scene.height;
    const context = copy.getContext('2d');
    context.drawImage(scene, 0, 0);
    const pixels = context.getImageData(0, 0, copy.width, copy.height).data;
    const seen = new Set();
    for (let k = 0; k < pixels.length; k += 4)
      seen.add((pixels[k] >> 3) << 10 | (pixels[k + 1] >> 3) << 5 | (pixels[k + 2] >> 3));
    done(seen.size);
  })))");
}

std::size_t colours_of(const Image& picture) {
  std::set<std::array<int, 3>> seen;
  for (std::size_t k = 0; k + 2 < picture.rgb.size(); k += 3)
    seen.insert({picture.rgb[k] / 8, picture.rgb[k + 1] / 8, picture.rgb[k + 2] / 8});
  return seen.size();
}

struct PageTest : ::testing::Test {
  void SetUp() override {
    ASSERT_FALSE(Browser::program().empty())
        << "Chromium is not installed: apt-get install chromium (scripts/test.sh does)";
  }
  TemporaryFolder temporary;
};

TEST_F(PageTest, RunsInABrowserWithoutAnError) {
  const fs::path folder = temporary.path / "run";
  write_sample_run(folder, SampleScene::wet);
  write_run_page(folder);
  Browser browser(temporary.path / "profile");
  browser.open("file://" + (folder / "report.html").string());
  EXPECT_EQ(left_by_script(browser, "viewer"), "ready");
  EXPECT_EQ(left_by_script(browser, "rocks"), "900");
  EXPECT_EQ(left_by_script(browser, "water"), "35000");  // every second of 70 000
  EXPECT_EQ(left_by_script(browser, "walls"), "5");
  EXPECT_NE(left_by_script(browser, "charts"), "0");
  EXPECT_EQ(count_of(browser, "canvas[data-engine]"), 1u);
  EXPECT_GT(count_of(browser, ".u-over"), 0u);  // interactive time charts
  EXPECT_TRUE(browser.value("document.body.innerHTML.includes('right side &lt;1&gt;')"));

  // the 3D view and the window around it are more than an empty frame
  EXPECT_GT(colours_of_scene(browser), 300);
  const Image window = browser.picture("#scene");
  EXPECT_GT(window.width, 1000);
  EXPECT_GT(colours_of(window), 300u);
  EXPECT_EQ(complaints_of(browser), "");
}

TEST_F(PageTest, RunsForADryScene) {
  const fs::path folder = temporary.path / "run";
  write_sample_run(folder, SampleScene::dry);
  write_run_page(folder);
  Browser browser(temporary.path / "profile");
  browser.open("file://" + (folder / "report.html").string());
  EXPECT_EQ(left_by_script(browser, "viewer"), "ready");
  EXPECT_EQ(left_by_script(browser, "water"), "0");
  EXPECT_EQ(complaints_of(browser), "");
}

TEST_F(PageTest, ShowsComparisonsWithoutAnError) {
  for (const int k : {1, 2}) write_sample_run(temporary.path / std::to_string(k), SampleScene::wet, k);
  write_comparison_page({temporary.path / "1", temporary.path / "2"}, temporary.path / "comparison.html");
  Browser browser(temporary.path / "profile");
  browser.open("file://" + (temporary.path / "comparison.html").string());
  EXPECT_GT(count_of(browser, ".chart"), 0u);
  EXPECT_EQ(complaints_of(browser), "");
}

TEST_F(PageTest, WouldBeToldOfAScriptThatFailsAndOfARequestToANetwork) {
  const fs::path page = temporary.path / "bad.html";
  std::ofstream(page) << "<img src='http://example.org/a.png'><script>throw Error('broken')</script>";
  Browser browser(temporary.path / "profile");
  browser.open("file://" + page.string());
  EXPECT_NE(complaints_of(browser).find("broken"), std::string::npos);
  EXPECT_NE(complaints_of(browser).find("ERR_NAME_NOT_RESOLVED"), std::string::npos);
}

}  // namespace
}  // namespace sluice
