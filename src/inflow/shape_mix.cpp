#include "inflow/shape_mix.h"

#include <algorithm>

namespace sluice {

namespace {

/// Midpoints of `steps` equal parts of a range; one value where it has no width.
std::vector<double> values_of(double low, double high, std::int64_t steps) {
  if (!(high > low)) return {low};
  std::vector<double> values;
  for (std::int64_t i = 0; i < steps; ++i)
    values.push_back(low + (high - low) * (static_cast<double>(i) + 0.5) / static_cast<double>(steps));
  return values;
}

}  // namespace

void ShapeClass::keys(Schema& s) {
  s.choice("kind", kind, {{"sphere", ShapeKind::sphere}, {"superquadric", ShapeKind::superquadric}},
           {.doc = "family of shapes"});
  const bool sq = kind == ShapeKind::superquadric;
  const char* when = "kind: superquadric";
  s.number("share", share, {.above = 0, .doc = "of the rock's mass; shares are scaled to a sum of 1"});
  s.number("elongation_low", elongation_low,
           {.at_least = 1,
            .at_most = 8,
            .doc = "least ratio of long to middle axis",
            .applies = sq,
            .applies_to = when});
  s.number("elongation_high", elongation_high,
           {.at_least = 1,
            .at_most = 8,
            .doc = "greatest ratio of long to middle axis",
            .applies = sq,
            .applies_to = when});
  s.number("flatness_low", flatness_low,
           {.above = 0.1,
            .at_most = 1,
            .doc = "least ratio of short to middle axis",
            .applies = sq,
            .applies_to = when});
  s.number("flatness_high", flatness_high,
           {.above = 0.1,
            .at_most = 1,
            .doc = "greatest ratio of short to middle axis",
            .applies = sq,
            .applies_to = when});
  s.numbers("blockiness", blockiness,
            {.at_least = 2,
             .at_most = 16,
             .doc = "exponents, equally frequent: 2 = ellipsoid, 8 = nearly a box",
             .applies = sq,
             .applies_to = when});
  if (elongation_low > elongation_high)
    s.problem("elongation_low", "is above 'elongation_high'", "a range goes upwards",
              "swap the two or give both");
  if (flatness_low > flatness_high)
    s.problem("flatness_low", "is above 'flatness_high'", "a range goes upwards",
              "swap the two or give both");
  if (blockiness.empty())
    s.problem("blockiness", "is empty", "each shape has an exponent", "give at least one, such as [2, 4]");
}

void ShapeMixConfig::keys(Schema& s) {
  s.list("classes", classes, {.doc = "families of shapes with their shares of the mass; none = spheres"});
  s.integer("steps", steps,
            {.at_least = 1, .at_most = 16, .doc = "values that stand for a range of elongation or flatness"});
}

int ShapeMix::draw(Random& random) const {
  if (index_.size() == 1) return index_.front();
  const auto at = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, random.uniform());
  return index_[static_cast<std::size_t>(at - cumulative_.begin())];
}

ShapeMix make_shape_mix(const ShapeMixConfig& config, std::vector<RockShape>& table) {
  ShapeMix mix;
  std::vector<double> mass_share;
  const auto add = [&](const RockShape& shape, double share) {
    mix.index_.push_back(static_cast<int>(table.size()));
    mass_share.push_back(share);
    table.push_back(shape);
  };

  // The table: every combination of a class's values, with an equal part of its share.
  if (config.classes.empty()) add(make_sphere(), 1);
  for (const ShapeClass& c : config.classes) {
    if (c.kind == ShapeKind::sphere) {
      add(make_sphere(), c.share);
      continue;
    }
    const std::vector<double> elongations = values_of(c.elongation_low, c.elongation_high, config.steps);
    const std::vector<double> flatnesses = values_of(c.flatness_low, c.flatness_high, config.steps);
    const double part =
        c.share / static_cast<double>(elongations.size() * flatnesses.size() * c.blockiness.size());
    for (double e : elongations)
      for (double f : flatnesses)
        for (double m : c.blockiness) add(make_superquadric(e, f, m), part);
  }

  // Frequency by number, and the mean volume that goes with it.
  double masses = 0, numbers = 0;
  for (std::size_t i = 0; i < mass_share.size(); ++i) {
    const RockShape& shape = table[static_cast<std::size_t>(mix.index_[i])];
    masses += mass_share[i];
    numbers += mass_share[i] / shape.volume;
    mix.cumulative_.push_back(numbers);
    mix.largest_radius_ = std::max(mix.largest_radius_, shape.bounding_radius);
  }
  for (double& c : mix.cumulative_) c /= numbers;
  mix.mean_volume_ = masses / numbers;
  return mix;
}

}  // namespace sluice
