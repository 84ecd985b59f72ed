#include "validation/rock_hertz_oblique.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/measured_table.h"

namespace sluice {

void RockHertzOblique::keys(Schema& s) {
  s.number("steps_per_contact", steps_per_contact, {.at_least = 5, .doc = "time steps in one contact"});
  s.number("radius", radius, {.unit = "m", .above = 0, .doc = "of the sphere"});
  s.number("speed", speed, {.unit = "m/s", .above = 0, .doc = "in all, or along the normal"});
  s.number("density", density, {.unit = "kg/m3", .above = 0, .doc = "of the sphere"});
  s.number("modulus", modulus, {.unit = "Pa", .above = 0, .doc = "Young's modulus of the sphere"});
  s.number("poisson", poisson, {.above = -1, .at_most = 0.5, .doc = "Poisson's ratio of the sphere"});
  s.number("friction", friction, {.above = 0, .doc = "Coulomb's coefficient"});
  s.number("restitution", restitution, {.above = 0, .at_most = 1, .doc = "along the normal"});
  s.choice("tangential", tangential,
           {{"rescaled", Tangential::rescaled},
            {"whole_stretch", Tangential::whole_stretch},
            {"partial_slip", Tangential::partial_slip}},
           {.doc = "as in a process file"});
  s.choice("vary", vary, {{"angle", ObliqueVary::angle}, {"tangential_speed", ObliqueVary::tangential_speed}},
           {.doc = "angle at constant speed, or the speed along the plane at constant speed against it"});
  s.text("curve", curve, {.doc = "published curves"});
  s.text("series", series, {.doc = "of that file"});
}

namespace {

/// What is read off one impact.
enum class Reading { tangential_restitution, spin, psi };

struct Point {
  Reading reading;
  double at, expected;
  std::string source;
};

/// Rows of the published file that belong to the series.
void add_curve(std::vector<Point>& points, const CsvTable& curve, const std::string& series,
               ObliqueVary vary) {
  const std::vector<std::string> quantity = reference_texts(curve, "quantity");
  const std::vector<std::string> who = reference_texts(curve, "series");
  const std::vector<double> at =
      reference_numbers(curve, vary == ObliqueVary::angle ? "incident_angle_deg" : "Vst_over_mu_Vn");
  const std::vector<double> value = reference_numbers(curve, "value");
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (who[k] != series) continue;
    if (quantity[k] == "et_tangential_restitution_center")
      points.push_back({Reading::tangential_restitution, at[k], value[k], "curve"});
    if (quantity[k] == "omega_rad_s") points.push_back({Reading::spin, at[k], value[k], "curve"});
    if (quantity[k] == "psi2_vs_psi1") points.push_back({Reading::psi, at[k], value[k], "curve"});
  }
}

std::vector<Point> points_of(const CsvTable& reference, ObliqueVary vary) {
  std::vector<Point> points;
  const auto add = [&](const char* place, const char* column, Reading reading) {
    const std::vector<double> at = reference_numbers(reference, place);
    const std::vector<double> value = reference_numbers(reference, column);
    for (std::size_t k = 0; k < at.size(); ++k)
      if (std::isfinite(value[k])) points.push_back({reading, at[k], value[k], "table"});
  };
  if (vary == ObliqueVary::angle) {
    add("angle", "tangential_restitution", Reading::tangential_restitution);
    add("angle", "spin", Reading::spin);
  } else {
    add("psi1", "psi2", Reading::psi);
  }
  return points;
}

}  // namespace

Measured RockHertzOblique::run(const CsvTable& reference) const {
  Measured out;
  std::vector<Point> points = points_of(reference, vary);
  if (!curve.empty()) {
    const std::optional<CsvTable> published = measured_table(curve);
    if (published)
      add_curve(points, *published, series, vary);
    else
      out.note = without_table(curve);
  }
  const ImpactSphere sphere{{"sphere", density, modulus, poisson}, radius, friction, restitution, tangential};
  const double sliding =
      friction * (1 + restitution);  // of the speed along the normal goes, if it slides throughout
  for (const Point& p : points) {
    const double angle = p.at * std::numbers::pi / 180;
    const double across = vary == ObliqueVary::angle ? speed * std::sin(angle) : p.at * friction * speed;
    const double down = vary == ObliqueVary::angle ? speed * std::cos(angle) : speed;
    const Impact impact = impact_of(sphere, {across, 0, -down}, ImpactAgainst::plane, steps_per_contact);
    out.particle_steps += impact.rock_steps;
    const double spin = -impact.w.y();
    switch (p.reading) {
      case Reading::tangential_restitution:
        out.values.push_back({fmt::format("tangential restitution at {:.4g} degrees, {}", p.at, p.source),
                              impact.v.x() / across, p.expected, 1});
        break;
      case Reading::spin:
        out.values.push_back({fmt::format("spin [rad/s] at {:.4g} degrees, {}", p.at, p.source), spin,
                              p.expected, 2.5 * sliding * speed / radius});
        break;
      case Reading::psi:
        out.values.push_back({fmt::format("psi2 at psi1 = {:.4g}, {}", p.at, p.source),
                              (impact.v.x() + radius * spin) / (friction * speed), p.expected,
                              3.5 * (1 + restitution)});
        break;
    }
  }
  return out;
}

}  // namespace sluice
