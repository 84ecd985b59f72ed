#include "app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace sluice {

namespace {
// Long enough to even out steps that write a checkpoint, short enough to follow the filling of a box.
constexpr double speed_window = 30;  // [s]
}  // namespace

std::string duration_words(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  const long long minutes = whole / 60, hours = minutes / 60, days = hours / 24;
  if (days > 0) return fmt::format("{} d {} h", days, hours % 24);
  if (hours > 0) return fmt::format("{} h {:02} min", hours, minutes % 60);
  if (minutes >= 10) return fmt::format("{} min", minutes);
  if (minutes > 0) return fmt::format("{} min {:02} s", minutes, whole % 60);
  return fmt::format("{} s", whole);
}

std::string count_words(std::uint64_t n) {
  if (n < 100'000) return fmt::format("{}", n);
  if (n < 1'000'000) return fmt::format("{} k", n / 1000);
  return fmt::format("{:.2f} M", static_cast<double>(n) * 1e-6);
}

Progress::Settings Progress::settings_for(std::FILE* stream) {
  Settings settings;
  const int descriptor = fileno(stream);
  if (descriptor < 0 || !isatty(descriptor)) return settings;
  settings.style = Style::rewritten;
  settings.every = 0.2;
  winsize window{};
  settings.columns =
      ioctl(descriptor, TIOCGWINSZ, &window) == 0 && window.ws_col > 0 ? window.ws_col - 1u : 79;
  return settings;
}

std::string Progress::line(const ProgressState& state) const {
  std::string s = fmt::format("t {:.3f}", state.simulated);
  if (state.until > 0)
    s += fmt::format(" / {:g} s  {:.0f} %", state.until,
                     std::floor(std::clamp(100 * state.simulated / state.until, 0.0, 100.0)));
  else
    s += " s";
  if (state.rocks) s += "  rocks " + count_words(*state.rocks);
  if (state.water_points) s += "  water " + count_words(*state.water_points);
  const auto micro = [](double dt) { return fmt::format("{:.3g} us", dt * 1e6); };
  if (state.dt_rock && state.dt_water)
    s += fmt::format("  dt {} rock, {} water", micro(*state.dt_rock), micro(*state.dt_water));
  else if (state.dt_rock || state.dt_water)
    s += "  dt " + micro(state.dt_rock ? *state.dt_rock : *state.dt_water);
  if (marks_.empty()) return s;
  const double wall = state.wall - marks_.front().wall;
  const double simulated = state.simulated - marks_.front().simulated;
  if (wall <= 0 || simulated <= 0) return s;
  const double cost = wall / simulated;  // wall seconds per simulated second
  s += cost >= 1 ? fmt::format("  {} per s", duration_words(cost))
                 : fmt::format("  {:.3g} x real time", 1 / cost);
  if (state.until > state.simulated)
    s += fmt::format("  {} to go", duration_words(cost * (state.until - state.simulated)));
  return s;
}

void Progress::remember(const ProgressState& state) {
  marks_.push_back({state.wall, state.simulated});
  while (marks_.size() > 2 && state.wall - marks_[1].wall > speed_window) marks_.pop_front();
}

void Progress::write(const std::string& text) {
  if (settings_.style == Style::plain) {
    fmt::print(stream_, "{}\n", text);
  } else {
    const std::string cut = settings_.columns > 0 ? text.substr(0, settings_.columns) : text;
    fmt::print(stream_, "\r{:<{}}", cut, shown_);
    shown_ = cut.size();
  }
  std::fflush(stream_);
}

void Progress::update(const ProgressState& state) {
  if (!last_written_) {
    // Nothing is known yet: the first line comes after one interval.
    last_written_ = state.wall;
    remember(state);
    return;
  }
  if (state.wall - *last_written_ < settings_.every) return;
  write(line(state));
  remember(state);
  last_written_ = state.wall;
}

void Progress::say(const std::string& text) {
  if (settings_.style == Style::rewritten && shown_ > 0) {
    fmt::print(stream_, "\r{:<{}}\r", "", shown_);
    shown_ = 0;
  }
  fmt::print(stream_, "{}\n", text);
  std::fflush(stream_);
}

void Progress::finish(const ProgressState& state) {
  write(line(state));
  if (settings_.style == Style::rewritten) {
    fmt::print(stream_, "\n");
    std::fflush(stream_);
    shown_ = 0;
  }
}

}  // namespace sluice
