#include "inflow/conveyor_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/dem_system.h"
#include "inflow/belt_slurry.h"
#include "inflow/feed_clock.h"

namespace sluice {

namespace {

/// Places tried for a rock in one step; a rock without room is tried again in the next.
constexpr int places_per_step = 12;
/// Rocks without room after which a step tries no more: the band is full.
constexpr int misses_per_step = 24;
/// Rocks drawn ahead at most while the feed is blocked; the rest stays counted as mass.
constexpr std::size_t longest_list = 4096;
/// Transits of the band after which a rock that still waits means that the feed is blocked: after one it goes
/// first, after the second the belt has cleared the band.
constexpr double blocked_after = 3;
/// Gap under a rock that is set down on the belt, of its radius.
constexpr double gap = 0.01;
/// Keeps the streams of one emitter apart.
constexpr std::uint64_t placing_stream = 1ULL << 41;

/// A rock that is drawn but not yet on the belt.
struct Drawn {
  double size = 0;   ///< [m]
  double mass = 0;   ///< [kg]
  double since = 0;  ///< when it fell due [s]
  int shape = 0;
};

class ConveyorFeed : public Inflow {
 public:
  ConveyorFeed(const ConveyorFeedConfig& c, const ShapeMix& mix, const InflowTarget& target, int material,
               const BeltFrame& belt)
      : config_(c),
        mix_(mix),
        sizes_(c.sizes),
        belt_(belt),
        rocks_(target.rocks),
        material_(material),
        source_(target.index),
        draws_(target.seed, static_cast<std::uint64_t>(target.index)),
        places_(target.seed, placing_stream + static_cast<std::uint64_t>(target.index)) {
    const double stop = c.stop.value_or(std::numeric_limits<double>::infinity());
    clock_ = {c.rate * (1 - sizes_.fines_fraction()), c.start, stop};
    const double fines = c.below_cutoff == BelowCutoff::slurry ? c.rate * sizes_.fines_fraction() : 0;
    const double wet = fines + c.rate * c.moisture;
    if (wet > 0) slurry_.emplace(belt, FeedClock{wet, c.start, stop}, fines / wet, target);
    next_ = draw();
  }

  const std::string& name() const override { return config_.name; }
  const char* kind() const override { return "conveyor"; }
  void advance(double t, double dt) override;
  InflowBudget rock() const override {
    return {requested_, entered_, requested_ - entered_, entered_momentum()};
  }
  InflowBudget water() const override { return slurry_ ? slurry_->slurry() : InflowBudget{}; }
  InflowBudget fines() const override { return slurry_ ? slurry_->fines() : InflowBudget{}; }
  std::string warning() const override;
  void exchange(StateArchive& archive) override;

 private:
  Drawn draw();
  bool set_down(const Drawn& rock);
  double bed_height(double across) const;
  double transit() const {
    return belt_.length / belt_.speed;
  }  ///< time in which the belt clears the band [s]
  Vec3 entered_momentum() const { return (entered_ * belt_.speed) * belt_.along; }

  ConveyorFeedConfig config_;
  ShapeMix mix_;
  SizeDistribution sizes_;
  BeltFrame belt_;
  DemSystem* rocks_;
  int material_, source_;
  Random draws_, places_;
  FeedClock clock_;
  std::optional<BeltSlurry> slurry_;
  std::vector<Drawn> waiting_;  ///< due, in the order in which they were drawn
  Drawn next_;                  ///< not yet due
  double requested_ = 0, entered_ = 0, longest_wait_ = 0;
};

Drawn ConveyorFeed::draw() {
  Drawn rock;
  rock.size = sizes_.draw(draws_);
  rock.shape = mix_.draw(draws_);
  rock.mass = rocks_->mass_of(rock.shape, material_, rock.size);
  return rock;
}

double ConveyorFeed::bed_height(double across) const {
  if (config_.profile == BedProfile::flat) return config_.bed_depth;
  const double y = 2 * across / belt_.width;
  return config_.bed_depth * std::max(0.0, 1 - y * y);
}

void ConveyorFeed::advance(double t, double dt) {
  const double t_end = t + dt;
  if (slurry_) slurry_->advance(t_end);

  // Draw what has fallen due.
  requested_ = clock_.requested(t_end);
  double drawn = entered_;
  for (const Drawn& rock : waiting_) drawn += rock.mass;
  while (requested_ - drawn >= next_.mass && waiting_.size() < longest_list) {
    next_.since = t_end;
    drawn += next_.mass;
    waiting_.push_back(next_);
    next_ = draw();
  }

  // Set down what finds room; a rock that has waited long enough keeps the others back.
  std::vector<Drawn> left;
  int misses = 0;
  bool held = false;
  for (const Drawn& rock : waiting_) {
    if (!held && misses < misses_per_step && set_down(rock)) {
      entered_ += rock.mass;
      continue;
    }
    ++misses;
    held = held || t_end - rock.since > transit();
    left.push_back(rock);
  }
  waiting_ = std::move(left);
  if (!waiting_.empty()) longest_wait_ = std::max(longest_wait_, t_end - waiting_.front().since);
}

bool ConveyorFeed::set_down(const Drawn& rock) {
  const double R = rocks_->shapes()[static_cast<std::size_t>(rock.shape)].bounding_radius * rock.size;
  const double half = std::max(0.0, 0.5 * belt_.width - R);
  const double run = std::max(0.0, belt_.length - 2 * R);
  for (int i = 0; i < places_per_step; ++i) {
    double across = places_.uniform(-half, half);
    // A heap carries more in its middle: thin the places by its height.
    if (places_.uniform() * config_.bed_depth > bed_height(across))
      across = places_.uniform(-0.5, 0.5) * half;
    const double behind = R + run * places_.uniform();
    const double top = std::max(bed_height(across), (2 + 2 * gap) * R);
    for (double height = (1 + gap) * R; height + R <= top + gap * R; height += 0.5 * R) {
      const Vec3 x = belt_.at(behind, across, height);
      if (!rocks_->has_room(x, R, true)) continue;
      rocks_->add({.x = x,
                   .v = belt_.speed * belt_.along,
                   .q = places_.rotation(),
                   .shape = rock.shape,
                   .material = material_,
                   .source = source_,
                   .size = rock.size});
      return true;
    }
  }
  return false;
}

std::string ConveyorFeed::warning() const {
  if (longest_wait_ <= blocked_after * transit()) return "";
  return fmt::format(
      "{}: {:.3g} kg wait for room at the belt (longest wait {:.2g} s); raise 'bed_depth', 'burden_width' or "
      "'belt_speed', or lower 'rate'",
      config_.name, requested_ - entered_, longest_wait_);
}

void ConveyorFeed::exchange(StateArchive& archive) {
  archive.value("requested", requested_);
  archive.value("entered", entered_);
  archive.value("longest_wait", longest_wait_);
  archive.value("draws", draws_.state);
  archive.value("places", places_.state);

  // The list, with the next rock at its end.
  std::vector<Drawn> all = waiting_;
  all.push_back(next_);
  std::vector<std::array<double, 3>> numbers;
  std::vector<std::int32_t> shapes;
  for (const Drawn& rock : all) {
    numbers.push_back({rock.size, rock.mass, rock.since});
    shapes.push_back(rock.shape);
  }
  archive.values("drawn", numbers);
  archive.values("drawn_shapes", shapes);
  all.clear();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    all.push_back({numbers[i][0], numbers[i][1], numbers[i][2], shapes[i]});
  next_ = all.back();
  all.pop_back();
  waiting_ = std::move(all);

  if (slurry_) {
    archive.enter("slurry");
    slurry_->exchange(archive);
    archive.leave();
  }
}

/// What keeps the feed's slurry from being one; nothing where all is well.
void check_slurry(const ConveyorFeedConfig& c, double fines, const InflowTarget& target,
                  std::vector<InputProblem>& problems) {
  const bool slurry = c.below_cutoff == BelowCutoff::slurry && fines > 0;
  if (target.water == nullptr) {
    if (slurry)
      problems.push_back(
          {c.where, "below_cutoff", fmt::format("sends {:.3g} % of the feed into the slurry", 100 * fines),
           "the process has no 'water' section", "use 'below_cutoff: leave_out' or add 'water'"});
    if (c.moisture > 0)
      problems.push_back({c.where, "moisture", "brings water", "the process has no 'water' section",
                          "take 'moisture' out or add 'water'"});
    return;
  }
  if (!slurry) return;
  const FluidModel& model = target.water->model();
  const double grains = fines / model.fines_density;
  const double phi = grains / (grains + c.moisture / model.density);
  if (phi < model.packing) return;
  const double least = grains * (1 / model.packing - 1) * model.density;
  problems.push_back(
      {c.where, "moisture", fmt::format("is {:.3g} %", 100 * c.moisture),
       fmt::format("with {:.3g} % fines the slurry on the belt would be {:.3g} % grains, and stops "
                   "flowing at {:.3g} %",
                   100 * fines, 100 * phi, 100 * model.packing),
       fmt::format("raise it above {:.2g} %, or use 'below_cutoff: leave_out'", 100 * least)});
}

}  // namespace

std::unique_ptr<Inflow> make_conveyor_feed(const ConveyorFeedConfig& c, const ShapeMix& mix,
                                           const InflowTarget& target) {
  if (target.rocks == nullptr)
    throw InputError(InputProblem{c.where, c.name, "feeds rock", "the process has no 'rocks' section",
                                  "add 'rocks' or take the entry out"});
  const SizeDistribution sizes(c.sizes);
  const double widest = 2 * mix.largest_radius() * sizes.largest();
  const BeltFrame belt = belt_frame(c, widest, target.gravity);
  std::vector<InputProblem> problems;

  const auto& materials = target.rocks->materials().all;
  const auto material = std::find_if(materials.begin(), materials.end(),
                                     [&](const Material& m) { return m.name == c.material; });
  if (material == materials.end()) {
    problems.push_back({c.where, "material", fmt::format("names '{}'", c.material),
                        "there is no such material", "list it under 'materials'"});
  } else {
    const double capacity = feed_capacity(c, material->density);
    if (c.rate > capacity)
      problems.push_back(
          {c.where, "rate", fmt::format("is {:.4g} t/h", 3.6 * c.rate),
           fmt::format("a bed {:.3g} m deep and {:.3g} m wide at {:.3g} m/s carries {:.4g} t/h", c.bed_depth,
                       c.burden_width, c.belt_speed, 3.6 * capacity),
           "raise 'bed_depth', 'burden_width' or 'belt_speed', or lower 'rate'"});
  }
  if (widest > std::min(belt.width, belt.length))
    problems.push_back({c.where, belt.width < belt.length ? "burden_width" : "band_length",
                        fmt::format("is {:.3g} m", std::min(belt.width, belt.length)),
                        fmt::format("the largest rock turns in {:.3g} m", widest),
                        "widen it or cut the top size"});
  for (const double behind : {0.0, belt.length})
    for (const double across : {-0.5, 0.5})
      if (problems.empty() && target.domain.outside(belt.at(behind, across * belt.width, 0.5 * c.bed_depth)))
        problems.push_back({c.where, "position", "puts the feed's band outside the domain",
                            fmt::format("the band reaches {:.3g} m upstream of it", belt.length),
                            "move it inside or enlarge the domain"});
  check_slurry(c, sizes.fines_fraction(), target, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return std::make_unique<ConveyorFeed>(c, mix, target, static_cast<int>(material - materials.begin()), belt);
}

}  // namespace sluice
