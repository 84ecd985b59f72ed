#pragma once
/// Progress of a run for whoever watches: on a terminal one line that is rewritten, elsewhere (a log
/// file, a pipeline) a plain line now and then.
///
///   t 1.320 / 5 s  26 %  rocks 12034  water 540 k  dt 12.1 us rock, 85 us water  4.2 min per s  15 min to go

#include <cstdint>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>

namespace sluice {

/// Where a run stands. What a scene does not have is absent.
struct ProgressState {
  double simulated = 0;  ///< [s]
  double until = 0;      ///< planned end [s]
  double wall = 0;       ///< since this process began [s]
  std::optional<std::uint64_t> rocks, water_points;
  std::optional<double> dt_rock, dt_water;  ///< [s]
};

/// "45 s", "3 min 20 s", "1 h 05 min", "2 d 3 h"; seconds rounded.
std::string duration_words(double seconds);
/// "812", "12034", "540 k", "1.40 M"
std::string count_words(std::uint64_t n);

class Progress {
 public:
  enum class Style {
    rewritten,  ///< a terminal: one line, rewritten
    plain,      ///< lines, one every ten seconds or so
  };
  struct Settings {
    Style style = Style::plain;
    std::size_t columns = 0;  ///< a rewritten line is cut to this; 0 = not cut
    double every = 10;        ///< wall time between two lines [s]
  };
  /// Settings that suit the stream: rewritten five times a second on a terminal, else plain.
  static Settings settings_for(std::FILE* stream);

  /// @param stream  outlives this
  Progress(std::FILE* stream, Settings settings) : stream_(stream), settings_(settings) {}
  explicit Progress(std::FILE* stream) : Progress(stream, settings_for(stream)) {}

  /// Call as often as you like (every step): it writes only when it is time to.
  void update(const ProgressState& state);
  /// Writes a line of its own (a warning, say); the progress line goes on below it.
  void say(const std::string& text);
  /// Writes the last state and ends the line.
  void finish(const ProgressState& state);

 private:
  struct Mark {
    double wall, simulated;
  };
  std::string line(const ProgressState& state) const;
  void remember(const ProgressState& state);
  void write(const std::string& text);

  std::FILE* stream_;
  Settings settings_;
  std::deque<Mark> marks_;  ///< of the last half minute: the speed is taken over them
  std::optional<double> last_written_;
  std::size_t shown_ = 0;  ///< length of the line on the terminal
};

}  // namespace sluice
