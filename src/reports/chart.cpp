#include "reports/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/format.h"

namespace sluice {
namespace {

// distinct for colour-blind readers too: Okabe & Ito (2008), darkened for a white page
constexpr std::array<const char*, 7> colours = {"#1156a4", "#c4601d", "#12876f", "#8c3f8c",
                                                "#8a7500", "#5a6672", "#b3243f"};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(double x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  bool empty() const { return low > high; }
};

/// The frame, its ticks and labels, and where data lands on it.
class Plot {
 public:
  Plot(const ChartAxes& axes, Range x, Range y, bool has_legend) : axes_(axes), top_(has_legend ? 46 : 28) {
    if (x.empty()) x = {0, 1};
    if (y.empty()) y = {0, 1};
    y.include(0);
    if (x.high <= x.low) x = {x.low - 0.5, x.low + 0.5};
    if (y.high <= y.low) y.high = y.low + 1;
    const std::vector<double> ticks = round_ticks(y.low, y.high);
    y_ = {std::min(y.low, ticks.front()), std::max(y.high, ticks.back())};
    x_ = x;
    svg_ = fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
        "aria-label=\"{2}\">"
        "<text class=\"title\" x=\"{3}\" y=\"15\">{2}</text>",
        axes.width, axes.height, html(axes.title), left_);
    for (const double t : ticks)
      svg_ += fmt::format(
          "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>"
          "<text class=\"tick\" x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
          left_, axes.width - right_, y_at(t), y_at(t), left_ - 6, y_at(t) + 4, tick_text(t, ticks));
    const std::vector<double> x_ticks = round_ticks(x_.low, x_.high);
    for (const double t : x_ticks) {
      if (t < x_.low - 1e-9 * (x_.high - x_.low) || t > x_.high + 1e-9 * (x_.high - x_.low)) continue;
      svg_ += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                          x_at(t), axes.height - bottom_ + 16, tick_text(t, x_ticks));
    }
    svg_ += fmt::format(
        "<text class=\"label\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
        "<text class=\"label\" transform=\"translate(13 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        (left_ + axes.width - right_) / 2, axes.height - 6, html(axes.x_label),
        (top_ + axes.height - bottom_) / 2, html(axes.y_label));
  }

  double x_at(double x) const {
    return left_ + (axes_.width - left_ - right_) * (x - x_.low) / (x_.high - x_.low);
  }
  double y_at(double y) const {
    const double bottom = axes_.height - bottom_;
    return bottom - (bottom - top_) * (y - y_.low) / (y_.high - y_.low);
  }
  void add(const std::string& shape) { svg_ += shape; }
  void legend(const std::vector<ChartSeries>& series) {
    double x = left_;
    for (std::size_t k = 0; k < series.size(); ++k) {
      svg_ += fmt::format(
          "<rect x=\"{:.0f}\" y=\"25\" width=\"11\" height=\"11\" rx=\"2\" fill=\"{}\"/>"
          "<text class=\"key\" x=\"{:.0f}\" y=\"35\">{}</text>",
          x, series_colour(k), x + 16, html(series[k].name));
      x += 34 + 6.3 * static_cast<double>(series[k].name.size());
    }
  }
  std::string finish() {
    return svg_ + fmt::format("<line class=\"axis\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/></svg>",
                              left_, axes_.width - right_, y_at(0), y_at(0));
  }

 private:
  static std::string tick_text(double t, const std::vector<double>& ticks) {
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
    if (std::abs(t) >= 1e6) return fmt::format("{:g}", t);
    return fmt::format("{:.{}f}", std::abs(t) < 1e-9 * step ? 0.0 : t, decimals);
  }

  ChartAxes axes_;
  Range x_, y_;
  int left_ = 66, right_ = 14, top_, bottom_ = 42;
  std::string svg_;
};

}  // namespace

std::string series_colour(std::size_t k) {
  return colours[k % colours.size()];
}

std::vector<double> round_ticks(double low, double high) {
  if (high <= low) high = low + 1;
  const double span = high - low;
  const double ten = std::pow(10, std::floor(std::log10(span / 5)));
  double step = 10 * ten;
  for (const double s : {1.0, 2.0, 2.5, 5.0}) {
    if (span / (s * ten) <= 6) {
      step = s * ten;
      break;
    }
  }
  std::vector<double> ticks;
  const auto first = static_cast<long long>(std::floor(low / step + 1e-9));
  const auto last = static_cast<long long>(std::ceil(high / step - 1e-9));
  for (long long k = first; k <= last; ++k) ticks.push_back(static_cast<double>(k) * step);
  return ticks;
}

std::string line_chart(const ChartAxes& axes, const std::vector<ChartSeries>& series) {
  Range x, y;
  for (const ChartSeries& s : series) {
    for (const double v : s.x) x.include(v);
    for (const double v : s.y) y.include(v);
  }
  Plot plot(axes, x, y, series.size() > 1);
  for (std::size_t k = 0; k < series.size(); ++k) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < series[k].y.size(); ++i) {
      if (!std::isfinite(series[k].y[i]) || !std::isfinite(series[k].x[i])) {
        drawing = false;
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", plot.x_at(series[k].x[i]),
                          plot.y_at(series[k].y[i]));
      drawing = true;
    }
    plot.add(fmt::format("<path class=\"curve\" stroke=\"{}\" d=\"{}\"/>", series_colour(k), path));
  }
  if (series.size() > 1) plot.legend(series);
  return plot.finish();
}

std::string bin_chart(const ChartAxes& axes, const std::vector<double>& edges,
                      const std::vector<ChartSeries>& series) {
  Range x, y;
  for (const double e : edges) x.include(e);
  for (const ChartSeries& s : series) {
    for (const auto* values : {&s.y, &s.low, &s.high})
      for (const double v : *values) y.include(v);
  }
  Plot plot(axes, x, y, series.size() > 1);
  const double n = static_cast<double>(series.size());
  for (std::size_t k = 0; k < series.size(); ++k) {
    const ChartSeries& s = series[k];
    for (std::size_t i = 0; i + 1 < edges.size() && i < s.y.size(); ++i) {
      if (!std::isfinite(s.y[i])) continue;
      const double from = plot.x_at(edges[i]), room = plot.x_at(edges[i + 1]) - from;
      const double left = from + room * (0.08 + 0.84 * static_cast<double>(k) / n), width = room * 0.84 / n;
      const double top = plot.y_at(std::max(0.0, s.y[i])), bottom = plot.y_at(std::min(0.0, s.y[i]));
      plot.add(
          fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
                      "fill-opacity=\".82\"><title>{}</title></rect>",
                      left, top, width, bottom - top, series_colour(k), number(s.y[i])));
      if (i < s.low.size() && i < s.high.size() && std::isfinite(s.low[i]) && std::isfinite(s.high[i])) {
        const double middle = left + width / 2, low = plot.y_at(s.low[i]), high = plot.y_at(s.high[i]);
        const double cap = std::min(5.0, width / 3);
        plot.add(fmt::format(
            "<path class=\"whisker\" d=\"M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {1:.1f}H{4:.1f}M{3:.1f} "
            "{2:.1f}H{4:.1f}\"/>",
            middle, low, high, middle - cap, middle + cap));
      }
    }
  }
  if (series.size() > 1) plot.legend(series);
  return plot.finish();
}

}  // namespace sluice
