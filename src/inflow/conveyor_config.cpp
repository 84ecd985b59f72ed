#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inflow/conveyor_feed.h"

namespace sluice {

void ConveyorFeedConfig::keys(Schema& s) {
  where = s.here();
  s.number("rate", rate,
           {.unit = "kg/s",
            .required = true,
            .above = 0,
            .doc = "dry rock, fines included",
            .example = "1200 t/h"});
  s.number("belt_speed", belt_speed,
           {.unit = "m/s",
            .required = true,
            .above = 0,
            .doc = "of the belt and its burden",
            .example = "2.2 m/s"});
  s.vector(
      "position", position,
      {.unit = "m",
       .required = true,
       .doc =
           "middle of the belt, on its surface, at the front edge of the band where rocks are set down; the "
           "band reaches upstream from here"});
  s.vector("travel", travel,
           {.required = true, .doc = "direction in which the belt runs; any length", .example = "[1, 0, 0]"});
  s.number("burden_width", burden_width,
           {.unit = "m", .required = true, .above = 0, .doc = "of the rock on the belt"});
  s.number("offset", offset,
           {.unit = "m", .doc = "of the burden's middle from the belt's, to the left of travel"});
  s.number("bed_depth", bed_depth,
           {.unit = "m", .required = true, .above = 0, .doc = "largest height of the rock on the belt"});
  s.choice("profile", profile, {{"flat", BedProfile::flat}, {"heaped", BedProfile::heaped}},
           {.doc = "height over the width: one depth, or a parabola that ends at the edges"});
  s.number("band_length", band_length,
           {.unit = "m",
            .above = 0,
            .doc = "of the band in which rocks are set down; default: room for two of the largest rocks, or "
                   "the bed depth"});
  s.number("moisture", moisture,
           {.at_least = 0,
            .at_most = 1,
            .doc = "water that comes with the rock, over dry rock, by mass",
            .example = "5 %"});
  s.choice(
      "below_cutoff", below_cutoff, {{"slurry", BelowCutoff::slurry}, {"leave_out", BelowCutoff::leave_out}},
      {.doc =
           "what is finer than the cut-off: enters the slurry with the moisture, or is left out of the run"});
  s.text("material", material, {.required = true, .doc = "of the rock"});
  s.section("sizes", sizes, {.required = true, .doc = "size distribution by mass"});
  s.section("shapes", shapes, {.doc = "shapes; default: spheres"});
  s.number("start", start, {.unit = "s", .at_least = 0, .doc = "when the feed begins"});
  s.number("stop", stop, {.unit = "s", .above = 0, .doc = "when it ends; default: never"});
  if (stop && *stop <= start)
    s.problem("stop", "is not after 'start'", "the feed would never run", "give a later time");
  if (s.given("travel") && !(travel.norm() > 0))
    s.problem("travel", "has no length", "the belt must run somewhere", "give a vector such as [1, 0, 0]");
}

double feed_capacity(const ConveyorFeedConfig& c, double density) {
  const double section = c.bed_depth * c.burden_width * (c.profile == BedProfile::flat ? 1.0 : 2.0 / 3.0);
  return section * c.belt_speed * bulk_fraction * density;
}

BeltFrame belt_frame(const ConveyorFeedConfig& c, double widest, const Vec3& gravity) {
  BeltFrame belt;
  belt.along = c.travel.normalized();
  const Vec3 up = gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3::UnitZ();
  const Vec3 across = up.cross(belt.along);
  if (across.norm() < 1e-6)
    throw InputError(InputProblem{c.where, "travel", "is upright", "a belt carries rock across gravity",
                                  "give a direction that is level or inclined"});
  belt.across = across.normalized();
  belt.up = belt.along.cross(belt.across);
  belt.front = c.position + c.offset * belt.across;
  belt.speed = c.belt_speed;
  belt.width = c.burden_width;
  belt.length = c.band_length.value_or(std::max(2 * widest, c.bed_depth));
  return belt;
}

}  // namespace sluice
