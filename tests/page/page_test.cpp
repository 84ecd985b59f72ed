// The pages in a real browser: headless Chromium runs their scripts, the 3D view included.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <set>

#include "output/run_folder.h"
#include "output/temporary_folder.h"
#include "reports/comparison_page.h"
#include "reports/png.h"
#include "reports/run_page.h"
#include "reports/sample_run.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// What a browser made of a page.
struct Visit {
  int status = -1;
  std::string document;  ///< after its scripts ran
  std::string log;       ///< of the browser, console included
  Image screen;
};

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    for (const char* folder : {"/usr/bin", "/usr/local/bin", "/snap/bin"})
      if (const fs::path path = fs::path(folder) / name; fs::exists(path)) return path.string();
  return "";
}

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// True for an empty picture and for one that nothing was drawn into.
bool is_one_colour(const decltype(Visit::screen)& picture) {
  for (std::size_t k = 3; k < picture.rgb.size(); ++k)
    if (picture.rgb[k] != picture.rgb[k - 3]) return false;
  return true;
}

/// No host name resolves in this browser: whatever the page asks of a network fails and is logged.
Visit visit(const fs::path& page, const fs::path& work) {
  const std::string common =
      "timeout 60 " + browser() +
      " --headless=new --no-sandbox --disable-gpu-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader"
      " --hide-scrollbars --no-first-run --disable-extensions --disable-background-networking"
      " --host-resolver-rules=\"MAP * ~NOTFOUND\" --enable-logging=stderr --window-size=1380,1000 "
      "--user-data-dir='" +
      (work / "profile").string() + "'";
  Visit v;
  v.status = run(common + " --virtual-time-budget=8000 --dump-dom 'file://" + page.string() + "' >'" +
                 (work / "dom").string() + "' 2>'" + (work / "log").string() + "'");
  v.document = read_whole_file(work / "dom");
  v.log = read_whole_file(work / "log");
  // A software renderer draws each frame of the 3D view slowly. Over a long virtual time, or on a busy
  // machine, headless Chromium gives up waiting for it and hands out a sheet in one colour: that is taken
  // again.
  const fs::path shot = work / "screen.png";
  for (int attempt = 0; attempt < 4 && is_one_colour(v.screen); ++attempt)
    if (run(common + " --virtual-time-budget=1500 --screenshot='" + shot.string() + "' 'file://" +
            page.string() + "#view3d' >'" + (work / "out").string() + "' 2>&1") == 0 &&
        fs::exists(shot))
      v.screen = read_png(read_whole_file(shot));
  return v;
}

std::string console_lines(const std::string& log) {
  std::string out;
  for (std::size_t at = 0; at < log.size();) {
    const std::size_t end = std::min(log.find('\n', at), log.size());
    const std::string line = log.substr(at, end - at);
    if (line.find("CONSOLE") != std::string::npos) out += line + "\n";
    at = end + 1;
  }
  return out;
}

/// Attribute of the document's root that the script leaves ("data-rocks").
std::string left_by_script(const std::string& document, const std::string& name) {
  const std::string key = "data-" + name + "=\"";
  const std::size_t at = document.find(key);
  if (at == std::string::npos) return "";
  return document.substr(at + key.size(), document.find('"', at + key.size()) - at - key.size());
}

struct PageTest : ::testing::Test {
  void SetUp() override {
    ASSERT_FALSE(browser().empty())
        << "Chromium is not installed: apt-get install chromium (scripts/test.sh does)";
  }
  TemporaryFolder temporary;
};

TEST_F(PageTest, RunsInABrowserWithoutAnError) {
  const fs::path folder = temporary.path / "run";
  write_sample_run(folder, SampleScene::wet);
  write_run_page(folder);
  const Visit v = visit(folder / "report.html", temporary.path);
  ASSERT_EQ(v.status, 0) << v.log;
  EXPECT_EQ(console_lines(v.log), "");
  EXPECT_EQ(left_by_script(v.document, "viewer"), "ready");
  EXPECT_EQ(left_by_script(v.document, "rocks"), "900");
  EXPECT_EQ(left_by_script(v.document, "water"), "35000");  // every second of 70 000
  EXPECT_EQ(left_by_script(v.document, "walls"), "5");
  EXPECT_NE(left_by_script(v.document, "charts"), "0");
  EXPECT_NE(v.document.find("<canvas data-engine=\"three.js"), std::string::npos);
  EXPECT_NE(v.document.find("class=\"u-over\""), std::string::npos);  // interactive time charts
  EXPECT_NE(v.document.find("right side &lt;1&gt;"), std::string::npos);

  // the 3D view and the pictures are more than an empty frame
  ASSERT_GT(v.screen.width, 1000);
  std::set<std::array<int, 3>> colours;
  for (std::size_t k = 0; k + 2 < v.screen.rgb.size(); k += 3)
    colours.insert({v.screen.rgb[k] / 8, v.screen.rgb[k + 1] / 8, v.screen.rgb[k + 2] / 8});
  EXPECT_GT(colours.size(), 300u);
}

TEST_F(PageTest, RunsForADryScene) {
  const fs::path folder = temporary.path / "run";
  write_sample_run(folder, SampleScene::dry);
  write_run_page(folder);
  const Visit v = visit(folder / "report.html", temporary.path);
  ASSERT_EQ(v.status, 0) << v.log;
  EXPECT_EQ(console_lines(v.log), "");
  EXPECT_EQ(left_by_script(v.document, "viewer"), "ready");
  EXPECT_EQ(left_by_script(v.document, "water"), "0");
}

TEST_F(PageTest, ShowsComparisonsWithoutAnError) {
  for (const int k : {1, 2}) write_sample_run(temporary.path / std::to_string(k), SampleScene::wet, k);
  write_comparison_page({temporary.path / "1", temporary.path / "2"}, temporary.path / "comparison.html");
  const Visit v = visit(temporary.path / "comparison.html", temporary.path);
  ASSERT_EQ(v.status, 0) << v.log;
  EXPECT_EQ(console_lines(v.log), "");
  EXPECT_NE(v.document.find("class=\"chart\""), std::string::npos);
}

}  // namespace
}  // namespace sluice
