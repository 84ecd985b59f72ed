#include "app/progress.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace sluice {
namespace {

/// What was written to a stream.
class Captured {
 public:
  Captured() : stream_(open_memstream(&text_, &size_)) {}
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  ~Captured() {
    std::fclose(stream_);
    std::free(text_);
  }
  std::FILE* stream() { return stream_; }
  std::string text() {
    std::fflush(stream_);
    return {text_, size_};
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* stream_;
};

ProgressState state_at(double wall, double simulated) {
  ProgressState s;
  s.wall = wall;
  s.simulated = simulated;
  s.until = 5;
  s.rocks = 12034;
  s.water_points = 540999;
  s.dt_rock = 12.1e-6;
  s.dt_water = 85e-6;
  return s;
}

TEST(DurationWords, SuitTheLength) {
  EXPECT_EQ(duration_words(0.4), "0 s");
  EXPECT_EQ(duration_words(45), "45 s");
  EXPECT_EQ(duration_words(200), "3 min 20 s");
  EXPECT_EQ(duration_words(905), "15 min");
  EXPECT_EQ(duration_words(3900), "1 h 05 min");
  EXPECT_EQ(duration_words(183600), "2 d 3 h");
  EXPECT_EQ(duration_words(-3), "0 s");
}

TEST(CountWords, KeepThreeDigitsOrSo) {
  EXPECT_EQ(count_words(0), "0");
  EXPECT_EQ(count_words(12034), "12034");
  EXPECT_EQ(count_words(540999), "540 k");
  EXPECT_EQ(count_words(1400000), "1.40 M");
}

TEST(Progress, PlainLinesComeAtTheirInterval) {
  Captured out;
  Progress progress(out.stream(), {Progress::Style::plain, 0, 10});
  for (int second = 0; second <= 35; ++second) progress.update(state_at(second, second * 0.01));
  EXPECT_EQ(out.text(),
            "t 0.100 / 5 s  2 %  rocks 12034  water 540 k  dt 12.1 us rock, 85 us water  1 min 40 s per s  8 "
            "min 10 s "
            "to go\n"
            "t 0.200 / 5 s  4 %  rocks 12034  water 540 k  dt 12.1 us rock, 85 us water  1 min 40 s per s  8 "
            "min 00 s "
            "to go\n"
            "t 0.300 / 5 s  6 %  rocks 12034  water 540 k  dt 12.1 us rock, 85 us water  1 min 40 s per s  7 "
            "min 50 s "
            "to go\n");
}

TEST(Progress, LeavesOutWhatTheSceneHasNot) {
  Captured out;
  Progress progress(out.stream(), {Progress::Style::plain, 0, 10});
  ProgressState dry = state_at(0, 0);
  dry.water_points.reset();
  dry.dt_water.reset();
  progress.update(dry);
  dry.wall = 10;
  dry.simulated = 100;
  dry.until = 0;
  progress.update(dry);
  EXPECT_EQ(out.text(), "t 100.000 s  rocks 12034  dt 12.1 us  10 x real time\n");
}

TEST(Progress, SpeedForgetsWhatIsLongPast) {
  Captured out;
  Progress progress(out.stream(), {Progress::Style::plain, 0, 10});
  progress.update(state_at(0, 0));
  progress.update(state_at(100, 0.1));                                                  // 1000 s per s
  for (int i = 1; i <= 8; ++i) progress.update(state_at(100 + 10 * i, 0.1 + 0.1 * i));  // 100 s per s
  const std::string all = out.text();
  const std::string last = all.substr(all.rfind('\n', all.size() - 2) + 1);
  EXPECT_NE(last.find("1 min 40 s per s"), std::string::npos) << last;
}

TEST(Progress, ARewrittenLineStaysOneLineAndCoversTheLast) {
  Captured out;
  Progress progress(out.stream(), {Progress::Style::rewritten, 21, 1});
  progress.update(state_at(0, 0));
  progress.update(state_at(1, 0.01));
  progress.update(state_at(2, 0.02));
  EXPECT_EQ(out.text(), "\rt 0.010 / 5 s  0 %  r\rt 0.020 / 5 s  0 %  r");
  progress.say("warning: wet");
  progress.finish(state_at(3, 5));
  EXPECT_EQ(out.text(), "\rt 0.010 / 5 s  0 %  r\rt 0.020 / 5 s  0 %  r\r" + std::string(21, ' ') +
                            "\rwarning: wet\n\rt 5.000 / 5 s  100 % \n");
}

TEST(Progress, AFileGetsPlainLines) {
  std::FILE* file = std::tmpfile();
  ASSERT_TRUE(file);
  EXPECT_EQ(Progress::settings_for(file).style, Progress::Style::plain);
  EXPECT_EQ(Progress::settings_for(file).every, 10.0);
  std::fclose(file);
}

}  // namespace
}  // namespace sluice
