#include "dem/dem_system.h"

namespace sluice {

void DemConfig::keys(Schema& s) {
  s.number("impact_speed", impact_speed,
           {.unit = "m/s",
            .above = 0,
            .doc = "fastest impact to be expected; sets the stiffness of the linear law and the time step"});
  s.number("impact_overlap", impact_overlap,
           {.above = 0, .at_most = 0.3, .doc = "overlap over radius allowed at that speed, linear law"});
  s.number("bed_overlap", bed_overlap,
           {.above = 0, .at_most = 0.1, .doc = "mean overlap over radius allowed in the bed, linear law"});
  s.number("bed_depth", bed_depth,
           {.unit = "m", .at_least = 0, .doc = "depth of rock that rests on the lowest layer"});
  s.number("stiffness_per_size", stiffness_per_size,
           {.unit = "N/m2",
            .above = 0,
            .doc = "normal stiffness over size of the linear law, instead of the two overlap rules"});
  s.number("tangential_ratio", tangential_ratio,
           {.above = 0, .at_most = 1, .doc = "tangential over normal stiffness of the linear law"});
  s.number("network_fraction", network_fraction,
           {.above = 0, .at_most = 1, .doc = "time step over the critical step of a contact network"});
  s.number("steps_per_contact", steps_per_contact,
           {.at_least = 5, .doc = "time steps in the shortest contact, at least"});
  s.choice("end_of_contact", end_of_contact,
           {{"no_tension", EndOfContact::no_tension}, {"tension", EndOfContact::tension}},
           {.doc = "whether the dashpot may pull at the end of a contact; restitution holds either way"});
  s.number("overlap_limit", overlap_limit,
           {.above = 0, .at_most = 1, .doc = "overlap over radius beyond which the run stops"});
  linear_keys.clear();
  for (const char* key : {"impact_overlap", "bed_overlap", "stiffness_per_size", "tangential_ratio"})
    if (s.given(key)) linear_keys.push_back({key, s.at(key)});
}

}  // namespace sluice
