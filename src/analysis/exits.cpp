#include "analysis/exits.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>

#include "base/find_by_id.h"
#include "base/parallel.h"

namespace sluice {

namespace {

/// True if the path from a to b passes the rectangle low-high, which is flat in one axis.
bool crosses_rectangle(const Vec3& low, const Vec3& high, const Vec3& a, const Vec3& b) {
  int axis = 0;
  while (axis < 2 && low[axis] != high[axis]) ++axis;
  const double from = a[axis] - low[axis], to = b[axis] - low[axis];
  if ((from < 0) == (to < 0)) return false;
  const Vec3 at = a + from / (from - to) * (b - a);
  for (int k = 0; k < 3; ++k)
    if (k != axis && (at[k] < low[k] || at[k] > high[k])) return false;
  return true;
}

ExitConfig outside_config() {
  ExitConfig c;
  c.name = "outside";
  c.kind = ExitKind::box;
  c.bins = 1;
  return c;
}

Passage passage_of(double t, const RemovedRock& r) {
  return {.t = t,
          .x = r.x,
          .v = r.v,
          .mass = r.mass,
          .size = r.size,
          .birth = r.birth,
          .wet_dose = r.wet_dose,
          .rock = true};
}

Passage passage_of(double t, const RemovedPoint& p) {
  return {.t = t, .x = p.x, .v = p.v, .mass = p.mass, .fines_mass = p.fines_mass};
}

/// Orders points of space, to find one again.
struct Lexicographic {
  bool operator()(const Vec3& a, const Vec3& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

}  // namespace

Exits::Exits(std::vector<ExitConfig> configs, const Walls& walls, double interval, Domain domain)
    : outside_(outside_config(), interval), domain_(std::move(domain)) {
  for (ExitConfig& c : configs) {
    Box bounds{c.low, c.high};
    std::unique_ptr<SurfaceQuery> deck;
    if (c.kind == ExitKind::deck) {
      for (const Wall& wall : walls.all()) {
        if (wall.name != c.part) continue;
        deck = std::make_unique<SurfaceQuery>(wall.mesh);
        bounds = wall.mesh.bounds();
      }
      if (!deck)
        throw InputError(InputProblem{c.where, "part", fmt::format("names '{}'", c.part),
                                      "there is no such part", "use the name of a part under 'parts'"});
      if (c.width_from == c.width_to) {
        const int axis = bounds.size().x() >= bounds.size().y() ? 0 : 1;
        c.width_from[axis] = bounds.lo[axis];
        c.width_to[axis] = bounds.hi[axis];
      }
    }
    decks_.push_back(std::move(deck));
    bounds_.push_back(bounds);
    tallies_.emplace_back(std::move(c), interval);
  }
}

int Exits::exit_of(const Vec3& before, const Vec3& now, bool rock) const {
  const Vec3 step = domain_.nearest_image(now - before);
  for (std::size_t e = 0; e < tallies_.size(); ++e) {
    const ExitConfig& c = tallies_[e].config();
    if (c.kind == ExitKind::deck && rock) continue;
    if (c.kind == ExitKind::box) {
      if (bounds_[e].contains(now)) return static_cast<int>(e);
      continue;
    }
    const auto passes = [&](const Vec3& a, const Vec3& b) {
      Box path;
      path.include(a);
      path.include(b);
      if (!path.overlaps(bounds_[e])) return false;
      return c.kind == ExitKind::plane ? crosses_rectangle(c.low, c.high, a, b)
                                       : decks_[e]->first_hit(a, b).has_value();
    };
    // Through a periodic face the path is seen from both of its ends.
    if (passes(before, before + step)) return static_cast<int>(e);
    if (before + step != now && passes(now - step, now)) return static_cast<int>(e);
  }
  return -1;
}

void Exits::collect(double t, DemSystem* rocks, FluidSystem* water) {
  const bool some = !tallies_.empty();  // nobody's path is followed where there is none
  if (rocks != nullptr) {
    if (some) collect_rocks(t, *rocks);
    for (const RemovedRock& r : rocks->remove_outside()) outside_.add(passage_of(t, r));
    if (some) remember_places(rocks->rocks());
  }
  if (water != nullptr) {
    if (some) collect_water(t, *water);
    for (const RemovedPoint& p : water->remove_outside()) outside_.add(passage_of(t, p));
  }
}

void Exits::remember_places(const Rocks& rocks) {
  rock_before_ = rocks.x;
  rock_before_id_ = rocks.id;
}

std::vector<Vec3> Exits::places_before(const Rocks& rocks) const {
  std::vector<Vec3> before = rocks.x;
  FindById earlier(rock_before_id_);
  for (std::size_t i = 0; i < rocks.count(); ++i)
    if (const auto at = earlier.find(rocks.id[i])) before[i] = rock_before_[*at];
  return before;
}

void Exits::collect_rocks(double t, DemSystem& system) {
  const std::vector<Vec3> before = places_before(system.rocks());
  std::vector<int> exit(before.size());
  parallel_for(before.size(),
               [&](std::size_t i) { exit[i] = exit_of(before[i], system.rocks().x[i], true); });
  std::vector<std::size_t> leaving;
  for (std::size_t i = 0; i < exit.size(); ++i)
    if (exit[i] >= 0) leaving.push_back(i);
  if (!leaving.empty()) {
    const std::vector<RemovedRock> removed = system.remove(leaving);
    for (std::size_t k = 0; k < removed.size(); ++k)
      tallies_[static_cast<std::size_t>(exit[leaving[k]])].add(passage_of(t, removed[k]));
  }
}

void Exits::collect_water(double t, FluidSystem& water) {
  // One pass over the points for all exits; which exit took a point is noted by its last position.
  std::map<Vec3, int, Lexicographic> exit_at;
  std::mutex note;
  const std::vector<RemovedPoint> removed = water.remove_if([&](const Vec3& before, const Vec3& now) {
    const int exit = exit_of(before, now, false);
    if (exit < 0) return false;
    const std::lock_guard<std::mutex> lock(note);
    // Two points in the very same place: the lower exit, whichever thread comes first.
    const auto [at, fresh] = exit_at.try_emplace(now, exit);
    if (!fresh) at->second = std::min(at->second, exit);
    return true;
  });
  for (const RemovedPoint& p : removed) {
    // The position may come back rounded otherwise, or through a periodic face: then the nearest note.
    auto at = exit_at.find(p.x);
    if (at == exit_at.end())
      at = std::min_element(exit_at.begin(), exit_at.end(), [&](const auto& a, const auto& b) {
        return domain_.nearest_image(a.first - p.x).squaredNorm() <
               domain_.nearest_image(b.first - p.x).squaredNorm();
      });
    tallies_[static_cast<std::size_t>(at->second)].add(passage_of(t, p));
  }
}

void Exits::exchange(StateArchive& archive) {
  for (std::size_t e = 0; e < tallies_.size(); ++e) {
    archive.enter("exit" + std::to_string(e));
    tallies_[e].exchange(archive);
    archive.leave();
  }
  archive.enter("outside");
  outside_.exchange(archive);
  archive.leave();
  archive.values("rock_before", rock_before_);
  archive.values("rock_before_id", rock_before_id_);
}

}  // namespace sluice
