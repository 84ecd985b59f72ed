#include "analysis/gauges.h"

#include <limits>

#include "base/statistics.h"

namespace sluice {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// What all gauges do alike: keep the last reading.
class Gauge : public Probe {
 public:
  Gauge(const GaugeConfig& config, std::vector<std::string> endings)
      : config_(config), readings_(endings.size(), not_known) {
    for (const std::string& ending : endings) columns_.push_back(config.name + "_" + ending);
  }
  const std::string& name() const override { return config_.name; }
  double interval() const override { return config_.interval; }
  std::vector<std::string> columns() const override { return columns_; }
  std::vector<double> values() const override { return readings_; }
  void exchange(StateArchive& archive) override { archive.values("readings", readings_); }

 protected:
  bool in_box(const Vec3& x) const { return !config_.low || Box{*config_.low, *config_.high}.contains(x); }

  GaugeConfig config_;
  std::vector<double> readings_;

 private:
  std::vector<std::string> columns_;
};

class LevelGauge : public Gauge {
 public:
  explicit LevelGauge(const GaugeConfig& c) : Gauge(c, {"level_m"}) {}
  void look(const SceneView& scene) override {
    if (scene.water == nullptr) return;
    std::vector<double> heights;
    for (const Vec3& x : scene.water->points().x) {
      const double dx = x.x() - config_.x, dy = x.y() - config_.y;
      if (dx * dx + dy * dy <= config_.radius * config_.radius) heights.push_back(x.z());
    }
    readings_ = {column_level(std::move(heights))};
  }
};

class PressureGauge : public Gauge {
 public:
  explicit PressureGauge(const GaugeConfig& c) : Gauge(c, {"pressure_Pa"}) {}
  void look(const SceneView& scene) override {
    if (scene.water == nullptr) return;
    const WaterPoints points = scene.water->points();
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < points.count(); ++i) {
      if (!in_box(points.x[i])) continue;
      sum += points.pressure[i];
      count += 1;
    }
    readings_ = {count > 0 ? sum / count : not_known};
  }
};

class HoldupGauge : public Gauge {
 public:
  explicit HoldupGauge(const GaugeConfig& c) : Gauge(c, {"rock_kg", "water_kg", "fines_kg"}) {}
  void look(const SceneView& scene) override {
    double rock = 0, water = 0, fines = 0;
    if (scene.rocks != nullptr) {
      const Rocks& rocks = scene.rocks->rocks();
      for (std::size_t i = 0; i < rocks.count(); ++i) rock += in_box(rocks.x[i]) ? rocks.mass[i] : 0;
    }
    if (scene.water != nullptr && !config_.low) {
      water = scene.water->total_mass();
      fines = scene.water->total_fines();
    } else if (scene.water != nullptr) {
      const WaterPoints points = scene.water->points();
      for (std::size_t i = 0; i < points.count(); ++i) {
        if (!in_box(points.x[i])) continue;
        water += points.mass[i];
        fines += points.fines_mass[i];
      }
    }
    readings_ = {rock, water, fines};
  }
};

}  // namespace

double column_level(std::vector<double> heights) {
  if (heights.size() < 3) return not_known;
  const double low = quantile(heights, 0.1), middle = quantile(heights, 0.5), high = quantile(heights, 0.9);
  return middle + 0.5 * (high - low) / 0.8;
}

void GaugeConfig::keys(Schema& s) {
  where = s.here();
  s.choice(
      "kind", kind,
      {{"level", GaugeKind::level}, {"pressure", GaugeKind::pressure}, {"holdup", GaugeKind::holdup}},
      {.required = true,
       .doc =
           "level: height of the water at a place; pressure: of the water in a box; holdup: rock and water "
           "in a box or in all"});
  const bool level = kind == GaugeKind::level;
  s.number("x", x,
           {.unit = "m",
            .required = level,
            .doc = "place of the column",
            .applies = level,
            .applies_to = "kind: level"});
  s.number("y", y,
           {.unit = "m",
            .required = level,
            .doc = "place of the column",
            .applies = level,
            .applies_to = "kind: level"});
  s.number("radius", radius,
           {.unit = "m",
            .required = level,
            .above = 0,
            .doc = "of the column; two grid spacings or more",
            .applies = level,
            .applies_to = "kind: level"});
  s.vector("low", low,
           {.unit = "m",
            .required = kind == GaugeKind::pressure,
            .doc = "corner of the box with the smallest coordinates",
            .applies = !level,
            .applies_to = "kind: pressure or holdup"});
  s.vector("high", high,
           {.unit = "m",
            .required = kind == GaugeKind::pressure,
            .doc = "corner with the largest coordinates",
            .applies = !level,
            .applies_to = "kind: pressure or holdup"});
  s.number("interval", interval, {.unit = "s", .above = 0, .doc = "simulated time between readings"});
  if (low.has_value() != high.has_value())
    s.problem(low ? "high" : "low", "is missing", "a box has two corners", "give both or none");
  if (low && high && !(low->array() < high->array()).all())
    s.problem("high", "is not above 'low' in every direction", "the box would have no volume",
              "swap or correct the corners");
}

std::unique_ptr<Probe> make_gauge(const GaugeConfig& config) {
  switch (config.kind) {
    case GaugeKind::level:
      return std::make_unique<LevelGauge>(config);
    case GaugeKind::pressure:
      return std::make_unique<PressureGauge>(config);
    case GaugeKind::holdup:
      break;
  }
  return std::make_unique<HoldupGauge>(config);
}

}  // namespace sluice
