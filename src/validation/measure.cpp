#include "validation/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "processes/input_node.h"

namespace sluice {

namespace {

void need_column(const CsvTable& reference, const char* column) {
  if (reference.find(column)) return;
  throw InputError({{"reference table", 0, 0},
                    column,
                    "is not a column",
                    fmt::format("it has {}", fmt::join(reference.columns, ", ")),
                    "compare with the measure's header"});
}

}  // namespace

const char* norm_words(ErrorNorm norm) {
  switch (norm) {
    case ErrorNorm::largest:
      return "largest difference";
    case ErrorNorm::rms:
      return "root mean square difference";
    case ErrorNorm::relative_l2:
      return "relative L2 difference";
  }
  return "";
}

double error_of(const std::vector<Compared>& values, ErrorNorm norm) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  double most = 0, sum = 0, difference = 0, size = 0;
  for (const Compared& v : values) {
    const double off = std::abs(v.measured - v.reference) / v.scale;
    if (!std::isfinite(off)) return std::numeric_limits<double>::quiet_NaN();
    most = std::max(most, off);
    sum += off * off;
    difference += (v.measured - v.reference) * (v.measured - v.reference);
    size += v.reference * v.reference;
  }
  switch (norm) {
    case ErrorNorm::largest:
      return most;
    case ErrorNorm::rms:
      return std::sqrt(sum / static_cast<double>(values.size()));
    case ErrorNorm::relative_l2:
      return std::sqrt(difference / size);
  }
  return most;
}

std::vector<double> reference_numbers(const CsvTable& reference, const char* column) {
  need_column(reference, column);
  return reference.numbers(column);
}

std::vector<std::string> reference_texts(const CsvTable& reference, const char* column) {
  need_column(reference, column);
  return reference.texts(column);
}

std::vector<std::string> reference_words(const CsvTable& reference, const char* column,
                                         const std::vector<std::string>& known) {
  const std::vector<std::string> words = reference_texts(reference, column);
  for (const std::string& word : words)
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw InputError({{"reference table", 0, 0},
                        column,
                        "is '" + word + "'",
                        fmt::format("this measure knows {}", fmt::join(known, ", ")),
                        suggest_word(word, known)});
  return words;
}

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(above - x.begin());
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + share * (y[i] - y[i - 1]);
}

}  // namespace sluice
