#include "inflow/spray_nozzle.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "inflow/water_emitter.h"

namespace sluice {

using std::numbers::pi;

namespace {

/// Steps of Roberts' R2 sequence: 1/g and 1/g^2 with g^3 = g + 1.
constexpr double r2_first = 0.7548776662466927;
constexpr double r2_second = 0.5698402909980532;

double fraction(double x) {
  return x - std::floor(x);
}

/// The level direction across the nozzle's axis; x where the axis is upright.
Vec3 level_across(const Vec3& axis) {
  const Vec3 across = Vec3::UnitZ().cross(axis);
  return across.norm() > 1e-9 ? across.normalized() : Vec3::UnitX();
}

class SprayNozzle : public WaterEmitter {
 public:
  SprayNozzle(const SprayNozzleConfig& c, const InflowTarget& target)
      : WaterEmitter(c.name, c.outlets.open_outlets(),
                     c.flow_each() * static_cast<double>(c.outlets.open_outlets().size()), c.outlets.start,
                     c.outlets.stop.value_or(std::numeric_limits<double>::infinity()), target),
        pattern_(c.pattern),
        angle_(c.angle),
        thickness_(c.thickness),
        speed_(c.speed(target.water->model().density)),
        axis_(c.outlets.axis()),
        wide_(Eigen::AngleAxisd(c.roll, axis_) * level_across(axis_)),
        thin_(axis_.cross(wide_)) {
    for (std::size_t i = 0; i < c.outlets.open_outlets().size(); ++i) {
      first_.push_back(random_.uniform());
      second_.push_back(random_.uniform());
    }
  }

  const char* kind() const override { return "spray nozzle"; }

 protected:
  Placed place(std::size_t outlet, std::uint64_t k, double t_end) override {
    const double u = fraction(first_[outlet] + r2_first * static_cast<double>(k % (1ULL << 32)));
    const double v = fraction(second_[outlet] + r2_second * static_cast<double>(k % (1ULL << 32)));
    const Vec3 velocity = speed_ * direction(u, v);
    return {velocity * (t_end - due(outlet, k)), velocity};
  }

 private:
  /// Direction for a place (u, v) of the unit square.
  Vec3 direction(double u, double v) const {
    if (pattern_ == SprayPattern::full_cone) {
      const double cosine = 1 - u * (1 - std::cos(0.5 * angle_));
      const double sine = std::sqrt(1 - cosine * cosine);
      return cosine * axis_ + sine * (std::cos(2 * pi * v) * wide_ + std::sin(2 * pi * v) * thin_);
    }
    const double along = (u - 0.5) * angle_, across = (v - 0.5) * thickness_;
    return std::cos(across) * (std::cos(along) * axis_ + std::sin(along) * wide_) + std::sin(across) * thin_;
  }

  SprayPattern pattern_;
  double angle_, thickness_, speed_;
  Vec3 axis_, wide_, thin_;
  std::vector<double> first_, second_;  ///< where each nozzle's sequence begins
};

}  // namespace

void SprayNozzleConfig::keys(Schema& s) {
  where = s.here();
  s.number("rated_flow", rated_flow,
           {.unit = "m3/s",
            .required = true,
            .above = 0,
            .doc = "flow of one nozzle at the rated pressure, from its catalogue",
            .example = "120 l/min"});
  s.number("rated_pressure", rated_pressure,
           {.unit = "Pa",
            .required = true,
            .above = 0,
            .doc = "pressure at which the catalogue gives the flow",
            .example = "2 bar"});
  s.choice("pattern", pattern, {{"flat_fan", SprayPattern::flat_fan}, {"full_cone", SprayPattern::full_cone}},
           {.doc = "a flat fan, or a full cone"});
  s.number("angle", angle,
           {.unit = "rad",
            .required = true,
            .above = 0,
            .at_most = 3.1,
            .doc = "full opening angle",
            .example = "90 deg"});
  s.number("thickness", thickness,
           {.unit = "rad",
            .at_least = 0,
            .at_most = 1.6,
            .doc = "full angle across the fan",
            .applies = pattern == SprayPattern::flat_fan,
            .applies_to = "pattern: flat_fan"});
  s.number("pressure", pressure,
           {.unit = "Pa",
            .above = 0,
            .doc = "operating pressure before the nozzle, over ambient; or give a flow"});
  s.number("velocity_coefficient", velocity_coefficient,
           {.above = 0, .at_most = 1, .doc = "droplet speed over sqrt(2 p / density)"});
  s.number("roll", roll,
           {.unit = "rad",
            .doc = "turn of the fan about its direction; at 0 its width lies level (along x for an "
                   "upright nozzle)"});
  outlets.keys(s);
  const int ways = (pressure ? 1 : 0) + (outlets.flow ? 1 : 0) + (outlets.total_flow ? 1 : 0);
  if (ways == 0)
    s.problem("pressure", "is missing", "a nozzle needs its operating point",
              "give 'pressure', 'flow' (of each nozzle) or 'total_flow'");
  if (pressure && ways > 1)
    s.problem("pressure", "is given beside a flow", "one follows from the other", "keep one of the two");
}

double SprayNozzleConfig::flow_each() const {
  if (outlets.flow) return *outlets.flow;
  if (outlets.total_flow) return *outlets.total_flow / static_cast<double>(outlets.open_outlets().size());
  return rated_flow * std::sqrt(pressure.value_or(rated_pressure) / rated_pressure);
}

double SprayNozzleConfig::operating_pressure() const {
  if (pressure) return *pressure;
  const double ratio = flow_each() / rated_flow;
  return rated_pressure * ratio * ratio;
}

double SprayNozzleConfig::speed(double density) const {
  return velocity_coefficient * std::sqrt(2 * operating_pressure() / density);
}

std::unique_ptr<Inflow> make_spray_nozzle(const SprayNozzleConfig& config, const InflowTarget& target) {
  fluid_of(target, config.name, config.where);
  return std::make_unique<SprayNozzle>(config, target);
}

}  // namespace sluice
