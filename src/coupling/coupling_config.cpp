#include "coupling/coupling.h"

namespace sluice {

void CouplingConfig::keys(Schema& s) {
  s.choice("mode", mode, {{"two_way", CouplingMode::two_way}, {"one_way", CouplingMode::one_way}},
           {.doc = "one_way: rocks feel the water, the water does not feel the rocks"});
  s.choice("drag", drag, drag_models, {.doc = "drag law of a rock among others"});
  s.number("kernel_diameters", kernel_diameters,
           {.at_least = 2, .at_most = 16, .doc = "least width of the averaging kernel over the rock's size"});
  s.number("filter_time_factor", filter_time_factor,
           {.at_least = 0,
            .at_most = 100,
            .doc = "buoyancy is low-passed over this many times spacing / sound speed"});
  s.number("resolve_from", resolve_from,
           {.at_least = 3,
            .doc = "rocks at least this many times the water's spacing large are met by the water with their "
                   "own shape, as walls that move; without it, none are"});
  if (s.given("resolve_from")) resolve_from_at = s.at("resolve_from");
  s.number(
      "resolve_partly_from", resolve_partly_from,
      {.above = 0,
       .doc = "from this many times the water's spacing on, up to resolve_from, a growing core of a rock is "
              "met so, and the rest as in small rocks; a third of resolve_from unless given",
       .applies = resolve_from.has_value(),
       .applies_to = "resolve_from"});
  if (resolve_from && resolve_partly_from && *resolve_partly_from > *resolve_from)
    s.problem("resolve_partly_from", "is above resolve_from",
              "rocks are resolved in part before they are resolved whole", "lower it");
  s.choice("lubrication", lubrication, {{"none", FilmModel::none}, {"normal", FilmModel::normal}},
           {.doc = "normal: films thinner than the water's spacing between resolved spheres, or these and "
                   "walls, resist being squeezed and drawn",
            .applies = resolve_from.has_value(),
            .applies_to = "resolve_from"});
  if (s.given("lubrication")) lubrication_at = s.at("lubrication");
  s.number("lubrication_roughness", lubrication_roughness,
           {.above = 0,
            .at_most = 0.1,
            .doc = "thinnest film over the rock's radius",
            .applies = lubrication != FilmModel::none,
            .applies_to = "lubrication: normal"});
  s.choice(
      "torque", torque,
      {{"none", CouplingTorque::none}, {"centre_of_pressure", CouplingTorque::centre_of_pressure}},
      {.doc = "centre_of_pressure: drag acts beside a long or flat rock's centre and turns it broadside, "
              "and water resists the spin of rocks that are not resolved"});
  s.integer("wetting_points", wetting_points,
            {.at_least = 8, .at_most = 256, .doc = "points in each rock that find its wetted fraction"});
}

}  // namespace sluice
