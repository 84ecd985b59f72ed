#include "processes/process_config.h"

#include <fmt/format.h>

#include "processes/process_document.h"

namespace sluice {

double metres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::mm:
      return 1e-3;
    case LengthUnit::cm:
      return 1e-2;
    case LengthUnit::m:
      return 1.0;
    case LengthUnit::inch:
      return 0.0254;
  }
  return 1.0;
}

void DomainConfig::keys(Schema& s) {
  s.vector(
      "low", low,
      {.unit = "m", .required = true, .doc = "lowest corner of the box", .example = "[-1 m, -1.3 m, 0 m]"});
  s.vector("high", high, {.unit = "m", .required = true, .doc = "highest corner of the box"});
  const auto face = [&](const char* key, Face& value, const char* doc) {
    s.choice(key, value, {{"open", Face::open}, {"wall", Face::wall}, {"periodic", Face::periodic}},
             {.doc = doc});
  };
  face("x_low", low_face[0], "face at low x: what leaves through an open face is counted as 'outside'");
  face("x_high", high_face[0], "face at high x");
  face("y_low", low_face[1], "face at low y");
  face("y_high", high_face[1], "face at high y");
  face("z_low", low_face[2], "face at low z");
  face("z_high", high_face[2], "face at high z");
  s.text("wall_material", wall_material, {.doc = "material of the faces that are walls"});
  wall_material_at = s.at("wall_material");
  std::string empty_along;
  for (int k = 0; k < 3; ++k) {
    static const char* names[3][2] = {{"x_low", "x_high"}, {"y_low", "y_high"}, {"z_low", "z_high"}};
    if ((low_face[k] == Face::periodic) != (high_face[k] == Face::periodic))
      s.problem(low_face[k] == Face::periodic ? names[k][1] : names[k][0], "is not periodic",
                "a periodic face needs a periodic one opposite", "make both periodic or neither");
    if (!(low[k] < high[k])) empty_along += fmt::format("{}{}", empty_along.empty() ? "" : ", ", "xyz"[k]);
  }
  if (s.given("low") && s.given("high") && !empty_along.empty())
    s.problem("high", fmt::format("is not above 'low' along {}", empty_along), "the box would be empty",
              "swap or widen them");
}

Domain DomainConfig::domain() const {
  Domain d;
  d.box = {low, high};
  d.low = low_face;
  d.high = high_face;
  return d;
}

void MaterialConfig::keys(Schema& s) {
  where = s.here();
  s.number("density", density,
           {.unit = "kg/m3", .above = 0, .doc = "needed for materials that rocks are made of"});
  s.number("youngs_modulus", youngs_modulus,
           {.unit = "Pa",
            .above = 0,
            .doc = "needed where a contact of it has 'law: hertz_mindlin', refused elsewhere",
            .example = "50 MPa"});
  s.number("poissons_ratio", poissons_ratio,
           {.above = -1,
            .at_most = 0.5,
            .doc = "needed where a contact of it has 'law: hertz_mindlin', refused elsewhere"});
  youngs_modulus_at = s.at("youngs_modulus");
  poissons_ratio_at = s.at("poissons_ratio");
}

void ContactConfig::keys(Schema& s) {
  where = s.here();
  s.texts(
      "between", between,
      {.required = true, .doc = "two materials; the same one twice for itself", .example = "[rock, steel]"});
  s.number("restitution", properties.restitution,
           {.required = true, .above = 0, .at_most = 1, .doc = "normal speed after over before impact"});
  s.number("friction", properties.friction,
           {.required = true, .at_least = 0, .doc = "Coulomb coefficient, static and sliding"});
  s.number("rolling", properties.rolling,
           {.at_least = 0, .doc = "rolling resistance coefficient: torque over radius times normal force"});
  s.choice("law", properties.law, {{"linear", ForceLaw::linear}, {"hertz_mindlin", ForceLaw::hertz_mindlin}},
           {.doc = "linear: a spring as stiff as the overlaps under 'rocks' ask for; hertz_mindlin: elastic "
                   "spheres of half the size, as stiff as the materials"});
  law_at = s.at("law");
  s.choice(
      "tangential", properties.tangential,
      {{"rescaled", Tangential::rescaled},
       {"whole_stretch", Tangential::whole_stretch},
       {"partial_slip", Tangential::partial_slip}},
      {.doc = "with 'law: hertz_mindlin'. rescaled: one spring, which makes no energy; whole_stretch: its "
              "force is stiffness times all its stretch, as in many codes, and may make energy; "
              "partial_slip: the contact slips from its rim inwards, as elastic bodies do"});
  if (s.given("tangential") && properties.law != ForceLaw::hertz_mindlin)
    s.problem("tangential", "has no effect", "'law' is linear", "write 'law: hertz_mindlin', or take it out");
  s.number("adhesion", properties.adhesion,
           {.unit = "N/m",
            .at_least = 0,
            .doc = "force that draws the two together while they touch, over their effective radius "
                   "R1 R2 / (R1 + R2); with either law"});
  if (s.given("between") && between.size() != 2)
    s.problem("between", "does not name two materials", "a contact has two sides", "write [rock, steel]");
}

void WallConfig::keys(Schema& s) {
  where = s.here();
  s.file("file", file, {.required = true, .doc = "CAD: .stl, .obj, .gltf, .glb or .ply"});
  s.choice("unit", unit,
           {{"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}, {"in", LengthUnit::inch}},
           {.required = true, .doc = "length unit of the file (STL and OBJ do not say; glTF is in m)"});
  s.texts("parts", parts, {.doc = "names of parts in the file; without it, all of them"});
  if (s.given("parts") && parts.empty())
    s.problem("parts", "names no part", "the entry would make no wall", "leave it out to take all parts");
  s.text("material", material, {.required = true, .doc = "one of 'materials'"});
  s.vector(
      "surface_velocity", surface_velocity,
      {.unit = "m/s",
       .doc = "the surface moves, the shape does not: a conveyor belt, or the transport of a vibrating deck; "
              "with 'motion' it turns with the wall"});
  s.section("motion", motion, {.doc = "how the wall itself moves; without it, it stands"});
  s.choice("blocks", blocks,
           {{"both", BlocksPhase::both},
            {"rocks_only", BlocksPhase::rocks_only},
            {"water_only", BlocksPhase::water_only}},
           {.doc = "rocks_only: a screen deck whose apertures let water through"});
  s.flag("repair", repair,
         {.doc = "merge equal vertices, drop degenerate and duplicate facets, orient facets alike"});
  file_at = s.at("file");
  parts_at = s.at("parts");
  material_at = s.at("material");
  motion_at = s.at("motion");
}

void OutputConfig::keys(Schema& s) {
  s.number("frames_every", frames_every,
           {.unit = "s", .at_least = 0, .doc = "simulated time between frames for ParaView; 0 = none"});
  s.number("series_every", series_every,
           {.unit = "s", .above = 0, .doc = "simulated time between rows of series.csv"});
  s.number("checkpoint_every", checkpoint_every,
           {.unit = "s", .above = 0, .doc = "simulated time between checkpoints"});
  s.number("exit_slot", exit_slot,
           {.unit = "s", .above = 0, .doc = "length of the time slots in which exits count"});
  s.flag("rock_surface", rock_surface, {.doc = "frames hold the rocks' real shapes besides their centres"});
}

void StopConfig::keys(Schema& s) {
  where = s.here();
  s.text("exit", exit, {.required = true, .doc = "one of 'exits'"});
  s.number("rock_rate", rock_rate,
           {.above = 0, .at_most = 1, .doc = "end the run when this share of the feed rate leaves"});
  s.number("over", over, {.unit = "s", .above = 0, .doc = "averaging time of that rate"});
}

void ProcessConfig::keys(Schema& s) {
  s.text("title", title, {.required = true, .doc = "of the run, as the page shows it"});
  s.number("duration", duration, {.unit = "s", .required = true, .above = 0, .doc = "simulated time"});
  s.integer("seed", seed,
            {.at_least = 0, .doc = "of every random choice; the same seed gives the same rocks"});
  s.vector("gravity", gravity, {.unit = "m/s2", .doc = "gravity"});
  s.section("domain", domain, {.required = true, .doc = "the box in which everything happens"});
  s.named("materials", materials, {.doc = "what rocks and walls are made of"});
  s.list("contacts", contacts, {.doc = "what happens where two materials touch"});
  s.named("walls", walls, {.doc = "CAD parts"});
  s.section("rocks", rocks, {.doc = "how rocks are simulated; without it there are none"});
  s.section("water", water, {.doc = "how water is simulated; without it there is none"});
  s.flag("coupled", coupled, {.doc = "false: rock and water of one scene ignore each other"});
  s.section("coupling", coupling, {.doc = "how rock and water act on each other"});
  s.named("conveyors", conveyors, {.doc = "belts that feed rock, and with it moisture and fines"});
  s.named("pipes", pipes, {.doc = "water jets from pipes"});
  s.named("channels", channels, {.doc = "water that comes down open channels"});
  s.named("sprays", sprays, {.doc = "spray nozzles"});
  s.named("water_fills", water_fills, {.doc = "water that is there at the start"});
  s.named("rock_fills", rock_fills, {.doc = "rocks that are there at the start"});
  s.named("exits", exits, {.doc = "where rock and water are taken out and counted"});
  s.named("gauges", gauges, {.doc = "levels, pressures and hold-ups over time"});
  s.named("mixing", mixing, {.doc = "how well rock and water mix along the box"});
  s.section("output", output, {.doc = "what is written, and how often"});
  s.section("stop", stop, {.doc = "end the run before 'duration'"});
  duration_at = s.at("duration");
  rocks_at = s.at("rocks");
  water_at = s.at("water");
}

ProcessConfig read_process(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  ProcessDocument document = ProcessDocument::read(file, overrides);
  ProcessConfig config = document.as<ProcessConfig>();
  document.finish();
  return config;
}

}  // namespace sluice
