#include "validation/water_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "validation/measured_table.h"
#include "validation/water_scenes.h"

namespace sluice {

void WaterFront::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 4, .doc = "grid cells in the column's height"});
  s.number("height", height, {.unit = "m", .above = 0, .doc = "of the column"});
  s.number("width", width, {.unit = "m", .above = 0, .doc = "of the column"});
  s.number("last", last, {.above = 1.5, .doc = "where the front is left, over the width"});
  s.text("curve", curve, {.doc = "published curve"});
  s.text("time", time, {.doc = "column of that file: t sqrt(g H) / width"});
  s.text("place", place, {.doc = "column of that file: distance from the closed end over the width"});
  s.text("series", series, {.doc = "of that file, where it has several"});
}

namespace {

constexpr double g = 9.81;
constexpr double first = 1.45;  ///< place from which on the way the gate went no longer counts

struct Curve {
  std::vector<double> time, place;
};

/// Rises by the same from place to place: time of each of `n` places, and the place.
Curve between(const Curve& c, double from, double to, int n) {
  Curve out;
  for (int k = 0; k < n; ++k) {
    const double at = from + (to - from) * k / (n - 1);
    out.place.push_back(at);
    out.time.push_back(interpolated(c.place, c.time, at));
  }
  return out;
}

/// dZ/dT of the straight line through the points.
double slope_of(const Curve& c) {
  double t = 0, z = 0, tt = 0, tz = 0;
  const double n = static_cast<double>(c.time.size());
  for (std::size_t k = 0; k < c.time.size(); ++k) {
    t += c.time[k] / n;
    z += c.place[k] / n;
  }
  for (std::size_t k = 0; k < c.time.size(); ++k) {
    tt += (c.time[k] - t) * (c.time[k] - t);
    tz += (c.time[k] - t) * (c.place[k] - z);
  }
  return tz / tt;
}

/// Farthest column of a cell that holds a quarter of a cell of water.
double front_of(const WaterPoints& p, double h, double slab_mass) {
  std::vector<double> mass;
  for (std::size_t i = 0; i < p.count(); ++i) {
    const auto k = static_cast<std::size_t>(std::max(0.0, p.x[i].x() / h));
    if (mass.size() <= k) mass.resize(k + 1);
    mass[k] += p.mass[i];
  }
  std::size_t k = mass.size();
  while (k > 0 && mass[k - 1] < 0.25 * slab_mass) --k;
  // The last one is filled so far.
  const double ahead = k < mass.size() ? mass[k] / (0.25 * slab_mass) : 0.0;
  return (static_cast<double>(k) + ahead) * h;
}

Curve published(const CsvTable& table, const WaterFront& c) {
  const std::vector<double> time = reference_numbers(table, c.time.c_str());
  const std::vector<double> place = reference_numbers(table, c.place.c_str());
  std::vector<std::string> who;
  if (!c.series.empty()) who = reference_texts(table, "series");
  Curve out;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if ((!who.empty() && who[k] != c.series) || place[k] < first || place[k] > c.last) continue;
    out.time.push_back(time[k]);
    out.place.push_back(place[k]);
  }
  if (out.time.empty())
    throw EnvironmentError(
        fmt::format("{}: no point of '{}' lies between {} and {}", c.curve, c.series, first, c.last));
  return out;
}

}  // namespace

Measured WaterFront::run(const CsvTable& reference) const {
  const double slope = reference_numbers(reference, "slope").front();
  const double scale = reference_numbers(reference, "scale").front();
  const double h = height / cells, across = 4 * h, reach = (last + 0.3) * width;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 2 * std::sqrt(g * height);
  setup.config.deepest = height;
  setup.gravity = {0, 0, -g};
  setup.domain = water_domain({Vec3(-h, 0, -h), Vec3(reach, across, 1.2 * height)}, {false, true, false});
  std::vector<Wall> walls;
  walls.push_back(sheet("floor", {Vec3(-h, -across, 0), Vec3(reach + h, -across, 0),
                                  Vec3(reach + h, 2 * across, 0), Vec3(-h, 2 * across, 0)}));
  walls.push_back(sheet("end", {Vec3(0, -across, -h), Vec3(0, 2 * across, -h),
                                Vec3(0, 2 * across, 1.2 * height), Vec3(0, -across, 1.2 * height)}));
  WaterScene scene(setup, std::move(walls));
  const double c = scene.water->limits().sound_speed, density = setup.config.fluid.density;
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(width, across, height)};
  fill.pressure = [&](const Vec3& x) { return still_pressure(density, g, c, height - x.z()); };
  scene.fill(fill);

  const double per_time = std::sqrt(g * height) / width;
  Curve found;
  while (found.place.empty() || found.place.back() < last) {
    for (int n = 0; n < 10; ++n) scene.step();
    const double at = front_of(scene.water->points(), h, density * h * h * across) / width;
    if (found.place.empty() || at > found.place.back()) {
      found.time.push_back(scene.t * per_time);
      found.place.push_back(at);
    }
    if (scene.t * per_time > 10)
      throw NumericalError("validation", scene.t, "the front does not come so far", "lower 'last'");
  }

  Measured out;
  out.particle_steps = scene.point_steps;
  out.values.push_back({"slope of the front", slope_of(between(found, first, last, 50)), slope, scale});
  const auto table = measured_table(curve);
  if (!table) {
    out.note = without_table(curve);
    return out;
  }
  const Curve measured = published(*table, *this);
  double shift = 0;
  for (std::size_t k = 0; k < measured.time.size(); ++k)
    shift += (measured.time[k] - interpolated(found.place, found.time, measured.place[k])) /
             static_cast<double>(measured.time.size());
  double square = 0;
  for (std::size_t k = 0; k < measured.time.size(); ++k) {
    const double at = interpolated(found.time, found.place, measured.time[k] - shift);
    square += std::pow(at / measured.place[k] - 1, 2) / static_cast<double>(measured.time.size());
  }
  out.values.push_back({"place of the front after one shift, root mean square of the relative difference",
                        std::sqrt(square), 0, 1});
  return out;
}

}  // namespace sluice
