#include "inflow/outlets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sluice {

void OutletRow::keys(Schema& s) {
  s.vector("position", position,
           {.unit = "m",
            .required = true,
            .doc = "middle of the (first) outlet",
            .example = "[1.2 m, 0 m, 3.1 m]"});
  s.vector("direction", direction,
           {.required = true, .doc = "the way the water goes; any length", .example = "[0, 0, -1]"});
  s.integer("count", count, {.at_least = 1, .at_most = 1000, .doc = "outlets in a row"});
  s.vector("spacing", spacing, {.unit = "m", .doc = "from one outlet of the row to the next"});
  s.numbers("blocked", blocked,
            {.at_least = 1, .doc = "outlets that give nothing, counted from 1 along the row"});
  s.number("flow", flow, {.unit = "m3/s", .above = 0, .doc = "of each open outlet", .example = "60 m3/h"});
  s.number("total_flow", total_flow,
           {.unit = "m3/s", .above = 0, .doc = "of all open outlets together, instead of 'flow'"});
  s.number("start", start, {.unit = "s", .at_least = 0, .doc = "when the water is turned on"});
  s.number("stop", stop, {.unit = "s", .above = 0, .doc = "when it is turned off; default: never"});
  if (s.given("direction") && !(direction.norm() > 0))
    s.problem("direction", "has no length", "the water must go somewhere",
              "give a vector such as [0, 0, -1]");
  if (count > 1 && !(spacing.norm() > 0))
    s.problem("spacing", "is zero", fmt::format("{} outlets would lie in one place", count),
              "give the vector from one outlet to the next");
  if (flow && total_flow)
    s.problem("total_flow", "is given beside 'flow'", "one follows from the other", "keep one of the two");
  if (stop && *stop <= start)
    s.problem("stop", "is not after 'start'", "the water would never run", "give a later time");
  for (double b : blocked)
    if (b != std::floor(b) || b > static_cast<double>(count))
      s.problem("blocked", fmt::format("names outlet {}", b),
                fmt::format("the row has outlets 1 to {}", count), "use whole numbers along the row");
  if (count >= 1 && open_outlets().empty())
    s.problem("blocked", "closes every outlet", "no water would come", "leave one open or drop the entry");
}

double OutletRow::flow_each() const {
  return flow ? *flow : total_flow.value_or(0) / static_cast<double>(open_outlets().size());
}

std::vector<Vec3> OutletRow::open_outlets() const {
  std::vector<Vec3> open;
  for (std::int64_t i = 0; i < count; ++i)
    if (std::find(blocked.begin(), blocked.end(), static_cast<double>(i + 1)) == blocked.end())
      open.push_back(position + static_cast<double>(i) * spacing);
  return open;
}

}  // namespace sluice
