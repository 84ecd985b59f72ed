#include "output/extremes_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice {

const char* outcome_word(ExtremeOutcome outcome) {
  switch (outcome) {
    case ExtremeOutcome::runs:
      return "runs";
    case ExtremeOutcome::stops:
      return "stops";
    case ExtremeOutcome::refused:
      return "refused";
    case ExtremeOutcome::broken:
      return "BROKEN";
  }
  return "";
}

bool ExtremeCase::good() const {
  return std::all_of(rungs.begin(), rungs.end(), [](const ExtremeRung& r) { return r.good(); });
}

const ExtremeRung* ExtremeCase::beyond() const {
  const auto found = std::find_if(rungs.begin(), rungs.end(),
                                  [](const ExtremeRung& r) { return r.outcome != ExtremeOutcome::runs; });
  return found == rungs.end() ? nullptr : &*found;
}

const ExtremeRung* ExtremeCase::frontier() const {
  const ExtremeRung* first = beyond();
  if (first == nullptr) return rungs.empty() ? nullptr : &rungs.back();
  return first == rungs.data() ? nullptr : first - 1;
}

std::string ExtremeCase::margin() const {
  const ExtremeRung* last = frontier();
  if (last == nullptr) return "none: the first rung does not run";
  std::string words = beyond() == nullptr ? "not reached on this ladder" : "";
  if (default_words.empty()) return words.empty() ? "no default" : words;
  if (!words.empty()) words += "; ";
  words += fmt::format("default {}", default_words);
  if (default_number && *default_number > 0 && last->number > 0) {
    const double ratio = last->number / *default_number;
    words += fmt::format(", {}a factor of {:.3g}", beyond() == nullptr ? "at least " : "",
                         std::max(ratio, 1 / ratio));
    const bool harder_is_more = rungs.back().number >= rungs.front().number;
    if (ratio != 1 && (ratio > 1) != harder_is_more) words += " BEYOND the frontier";
  }
  return words;
}

bool ExtremesRecord::good() const {
  return std::all_of(cases.begin(), cases.end(), [](const ExtremeCase& c) { return c.good(); });
}

}  // namespace sluice
