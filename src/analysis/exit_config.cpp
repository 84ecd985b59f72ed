#include <fmt/format.h>

#include <algorithm>

#include "analysis/exits.h"

namespace sluice {

namespace {

int flat_axes(const ExitConfig& c) {
  int flat = 0;
  for (int k = 0; k < 3; ++k) flat += c.low[k] == c.high[k] ? 1 : 0;
  return flat;
}

}  // namespace

void ExitConfig::keys(Schema& s) {
  where = s.here();
  s.choice(
      "kind", kind, {{"plane", ExitKind::plane}, {"box", ExitKind::box}, {"deck", ExitKind::deck}},
      {.required = true,
       .doc =
           "plane: what crosses a rectangle leaves; box: what gets inside leaves; deck: a screen part that "
           "lets water and fines through and stops rocks"});
  const bool deck = kind == ExitKind::deck;
  s.vector("low", low,
           {.unit = "m",
            .required = !deck,
            .doc = "corner with the smallest coordinates",
            .applies = !deck,
            .applies_to = "kind: plane or box"});
  s.vector("high", high,
           {.unit = "m",
            .required = !deck,
            .doc = "corner with the largest; a plane is flat in one direction",
            .applies = !deck,
            .applies_to = "kind: plane or box"});
  s.text("part", part,
         {.required = deck,
          .doc = "the screen deck, a part that blocks rocks only",
          .applies = deck,
          .applies_to = "kind: deck"});
  s.number("aperture", aperture,
           {.unit = "m",
            .above = 0,
            .doc = "opening of the screen cloth",
            .applies = deck,
            .applies_to = "kind: deck"});
  s.integer("bins", bins,
            {.at_least = 1, .at_most = 1000, .doc = "parts of the width that are counted apart"});
  s.vector("width_from", width_from,
           {.unit = "m", .doc = "one end of the width; default: the longest level edge of the exit"});
  s.vector("width_to", width_to, {.unit = "m", .doc = "the other end"});
  s.number("dry_dose", dry_dose,
           {.unit = "s",
            .at_least = 0,
            .doc = "a rock counts as dry if it met water for no longer (wetted fraction x time)"});
  if (s.given("width_from") != s.given("width_to"))
    s.problem(s.given("width_from") ? "width_to" : "width_from", "is missing", "a width has two ends",
              "give both ends or none");
  if (s.given("width_from") && s.given("width_to") && width_from == width_to)
    s.problem("width_to", "is where 'width_from' is", "the width would be nothing", "give its other end");
  if (deck || !s.given("low") || !s.given("high")) return;
  if (!(low.array() <= high.array()).all())
    s.problem("high", "is below 'low'", "the corners are given from small to large", "swap the coordinates");
  const int flat = flat_axes(*this);
  if (kind == ExitKind::plane && flat != 1)
    s.problem("high", fmt::format("makes a body flat in {} directions", flat),
              "a plane is flat in exactly one", "give one coordinate alike in 'low' and 'high'");
  if (kind == ExitKind::box && flat != 0)
    s.problem("high", "makes a body without volume", "a box exit takes what is inside",
              "use kind: plane or a box");
}

void check_exits(const std::vector<ExitConfig>& configs, const Domain& domain, const Walls& walls,
                 double cell) {
  std::vector<InputProblem> problems;
  for (const ExitConfig& c : configs) {
    if (c.name == "outside")
      problems.push_back({c.where, c.name, "is a name that is taken",
                          "it stands for the open faces of the domain", "give the exit another name"});
    if (c.kind == ExitKind::deck) {
      const auto wall = std::find_if(walls.all().begin(), walls.all().end(),
                                     [&](const Wall& w) { return w.name == c.part; });
      if (wall == walls.all().end())
        problems.push_back({c.where, "part", fmt::format("is '{}', which is not a wall", c.part),
                            "the deck is one of the walls", "name one of 'walls'"});
      else if (wall->blocks != BlocksPhase::rocks_only)
        problems.push_back({c.where, "part", fmt::format("is '{}', which also stops water", c.part),
                            "a deck lets water through its apertures",
                            fmt::format("set 'blocks: rocks_only' for the wall '{}'", c.part)});
      else if (cell > 0 && c.aperture > 2 * cell)
        problems.push_back({c.where, "aperture", fmt::format("is {:.3g} m", c.aperture),
                            "apertures of more than two cells must be CAD that the water can see",
                            "model the deck's openings, or use a larger water.spacing"});
      continue;
    }
    // A particle on the very face of the domain is inside, one beyond is gone: the exit must begin inside.
    const Box& box = domain.box;
    if (!box.overlaps({c.low, c.high}))
      problems.push_back(
          {c.where, "low", fmt::format("puts exit '{}' outside the domain", c.name),
           "nothing can ever reach it",
           fmt::format("move it into [{:.3g}, {:.3g}, {:.3g}] .. [{:.3g}, {:.3g}, {:.3g}] m", box.lo.x(),
                       box.lo.y(), box.lo.z(), box.hi.x(), box.hi.y(), box.hi.z())});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace sluice
