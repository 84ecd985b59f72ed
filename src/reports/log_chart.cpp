#include "reports/log_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/format.h"

namespace sluice {

namespace {

/// Whole decades around positive values.
struct Decades {
  int low = 0, high = 1;
  bool empty = true;
  void include(double x) {
    if (!(x > 0) || !std::isfinite(x)) return;
    const int below = static_cast<int>(std::floor(std::log10(x))),
              above = static_cast<int>(std::ceil(std::log10(x)));
    low = empty ? below : std::min(low, below);
    high = empty ? std::max(above, below + 1) : std::max(high, above);
    empty = false;
  }
  double share(double x) const { return (std::log10(x) - low) / (high - low); }
};

}  // namespace

std::string log_chart(const ChartAxes& axes, const std::vector<ChartSeries>& series,
                      const std::vector<std::string>& labels, const std::vector<double>& limits) {
  Decades x, y;
  for (const ChartSeries& s : series) {
    for (const double v : s.x) x.include(v);
    for (const double v : s.y) y.include(v);
  }
  for (const double v : limits) y.include(v);
  const int left = 66, right = 20, top = 28, bottom = 42;
  const auto x_at = [&](double v) { return left + (axes.width - left - right) * x.share(v); };
  const auto y_at = [&](double v) {
    return axes.height - bottom - (axes.height - bottom - top) * y.share(v);
  };
  std::string svg = fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "aria-label=\"{2}\"><text class=\"title\" x=\"{3}\" y=\"15\">{2}</text>",
      axes.width, axes.height, html(axes.title), left);
  for (int k = y.low; k <= y.high; ++k)
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/><text class=\"tick\" x=\"{}\" "
        "y=\"{:.1f}\" text-anchor=\"end\">1e{}</text>",
        left, axes.width - right, y_at(std::pow(10, k)), y_at(std::pow(10, k)), left - 6,
        y_at(std::pow(10, k)) + 4, k);
  for (int k = x.low; k <= x.high; ++k)
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick\" "
        "x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">1e{4}</text>",
        x_at(std::pow(10, k)), top, axes.height - bottom, axes.height - bottom + 16, k);
  svg += fmt::format(
      "<text class=\"label\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>"
      "<text class=\"label\" transform=\"translate(13 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
      (left + axes.width - right) / 2, axes.height - 6, html(axes.x_label), (top + axes.height - bottom) / 2,
      html(axes.y_label));
  for (const double limit : limits)
    if (limit > 0)
      svg += fmt::format(
          "<line class=\"axis\" stroke-dasharray=\"5 4\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
          left, axes.width - right, y_at(limit), y_at(limit));
  for (std::size_t k = 0; k < series.size(); ++k) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < series[k].y.size(); ++i) {
      const double px = series[k].x[i], py = series[k].y[i];
      if (!(px > 0) || !(py > 0) || !std::isfinite(px) || !std::isfinite(py)) {
        drawing = false;
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", x_at(px), y_at(py));
      drawing = true;
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.4\" fill=\"{}\"/>", x_at(px), y_at(py),
                         series_colour(k));
      if (k == 0 && i < labels.size())
        svg += fmt::format("<text class=\"key\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x_at(px) + 6,
                           y_at(py) - 6, html(labels[i]));
    }
    svg += fmt::format("<path class=\"curve\" stroke=\"{}\" d=\"{}\"/>", series_colour(k), path);
  }
  return svg + "</svg>";
}

}  // namespace sluice
