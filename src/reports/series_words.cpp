#include "reports/series_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/format.h"

namespace sluice {

namespace {

std::string with_unit(const std::string& text, const KeyResult& result) {
  return result.shown_unit.empty() ? text : text + " " + result.shown_unit;
}

/// Why one of two rungs tells nothing.
std::string missing_words(const SeriesRow& row, const std::string& name) {
  if (!row.completed()) return fmt::format("the run at {} {}", row.label, row.outcome);
  const KeyResult* r = find_result(row.results, name);
  if (!r) return "there is none at " + row.label;
  if (!r->reason.empty()) return row.label + ": " + r->reason;
  return "";
}

}  // namespace

std::string shown(const KeyResult& result, double value, double half_width) {
  return with_unit(number_with_limits(value * result.factor, half_width * result.factor), result);
}

std::vector<KeyResult> headline_results(const std::vector<SeriesRow>& rows,
                                        const std::vector<KeyResult>& all) {
  std::vector<KeyResult> out;
  for (const KeyResult& r : all)
    if (r.headline && std::any_of(rows.begin(), rows.end(), [&](const SeriesRow& row) {
          const KeyResult* own = row.completed() ? find_result(row.results, r.name) : nullptr;
          return own && std::isfinite(own->value) && own->value != 0;
        }))
      out.push_back(r);
  return out;
}

std::string change_words(const ConvergeRecord& record, std::size_t rung, const KeyResult& result) {
  const Change c = *record.change(rung, result.name);
  const std::string by = "changes it by " + shown(result, c.value, c.half_width);
  const std::string most =
      with_unit(number((std::abs(c.value) + c.half_width) * std::abs(result.factor), 2), result);
  switch (c.verdict) {
    case ChangeVerdict::resolved:
      return by + ", far beyond chance";
    case ChangeVerdict::changed:
      return by + ", more than chance but too near to it for an order";
    case ChangeVerdict::bounded:
      return by + ", no more than chance: the change is below " + most;
    case ChangeVerdict::too_short:
      return by + ": the sampling is too short to tell, it may be anything up to " + most;
    case ChangeVerdict::unknown:
      break;
  }
  std::string why = missing_words(record.rungs[rung], result.name);
  if (why.empty()) why = missing_words(record.rungs[rung - 1], result.name);
  return (std::isfinite(c.value) ? by + ": whether by chance, the sampling is too short to tell"
                                 : "tells nothing") +
         (why.empty() ? "" : " (" + why + ")");
}

std::string ladder_sentence(const ConvergeRecord& record, const KeyResult& result) {
  const std::size_t last = record.rungs.size() - 1;
  const SeriesRow &coarse = record.rungs[last - 1], &fine = record.rungs[last];
  const LadderPoint p = record.point(last - 1, result.name);
  std::string text = std::isfinite(p.value)
                         ? fmt::format("At {} it is {} and costs {}", coarse.label,
                                       shown(result, p.value, p.half_width), duration(coarse.run_time))
                         : fmt::format("At {} it is not known", coarse.label);
  text += fmt::format("; {} costs {} and {}.", fine.label, duration(fine.run_time),
                      change_words(record, last, result));
  if (const auto e = record.extrapolation(result.name))
    text +=
        fmt::format(" Of order {} over the last three rungs, it tends to {}; the error at {} is below {}.",
                    number(e->order, 2), shown(result, e->value, std::nan("")), fine.label,
                    shown(result, e->index, std::nan("")));
  return text;
}

}  // namespace sluice
