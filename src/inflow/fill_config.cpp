#include <fmt/format.h>

#include "inflow/initial_fill.h"

namespace sluice {

namespace {

void box_keys(Schema& s, Vec3& low, Vec3& high) {
  s.vector("low", low,
           {.unit = "m", .required = true, .doc = "corner of the box with the smallest coordinates"});
  s.vector("high", high, {.unit = "m", .required = true, .doc = "corner with the largest coordinates"});
  if (s.given("low") && s.given("high") && !((low.array() < high.array()).all()))
    s.problem("high", "is not above 'low' in every direction", "the box would have no volume",
              "swap or correct the corners");
}

}  // namespace

void WaterFillConfig::keys(Schema& s) {
  where = s.here();
  box_keys(s, low, high);
  s.number("level", level,
           {.unit = "m", .doc = "height of the water's surface; default: the top of the box"});
  s.text("inside", inside, {.doc = "closed part; only what lies inside it is filled"});
  s.vector("velocity", velocity, {.unit = "m/s", .doc = "at the start"});
  s.flag("hydrostatic", hydrostatic, {.doc = "start under the pressure of its own weight"});
  s.number(
      "jitter", jitter,
      {.at_least = 0, .at_most = 0.5, .doc = "largest random displacement of the points, of their spacing"});
  s.number("fines", fines, {.at_least = 0, .below = 1, .doc = "volume fraction of fines in the water"});
  if (level && s.given("low") && s.given("high") && !(*level > low.z() && *level <= high.z()))
    s.problem("level", fmt::format("is {} m", *level),
              fmt::format("the box reaches from {} m to {} m", low.z(), high.z()),
              "give a height inside the box");
}

void RockFillConfig::keys(Schema& s) {
  where = s.here();
  box_keys(s, low, high);
  s.integer("count", count, {.at_least = 1, .doc = "rocks; or give 'mass'"});
  s.number("mass", mass,
           {.unit = "kg", .above = 0, .doc = "of all rocks, met to half a rock; or give 'count'"});
  s.text("material", material, {.required = true, .doc = "of the rocks"});
  s.section("sizes", sizes,
            {.required = true, .doc = "size distribution by mass; what is below its cut-off is left out"});
  s.section("shapes", shapes, {.doc = "shapes; default: spheres"});
  s.vector("velocity", velocity, {.unit = "m/s", .doc = "at the start"});
  if (s.given("count") && mass)
    s.problem("mass", "is given beside 'count'", "one follows from the other", "keep one of the two");
  if (!s.given("count") && !mass)
    s.problem("count", "is missing", "the number of rocks is not known", "give 'count' or 'mass'");
}

}  // namespace sluice
