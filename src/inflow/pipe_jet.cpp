#include "inflow/pipe_jet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "inflow/water_emitter.h"

namespace sluice {

using std::numbers::pi;

namespace {

/// Random displacement of a point, of the spacing: breaks up rows without making holes.
constexpr double jitter = 0.1;
/// Turn from disc to disc [rad]: the golden angle never repeats.
const double golden_angle = pi * (3 - std::sqrt(5.0));

/// One place in a disc.
struct Slot {
  double radius = 0;  ///< [m]
  double angle = 0;   ///< [rad]
  double speed = 0;   ///< [m/s]
};

/// Rings of equal flux per point; neighbours in time lie apart in space.
std::vector<Slot> make_slots(const PipeJetConfig& c, double spacing) {
  const double R = 0.5 * c.bore;
  const auto n = std::max(1L, std::lround(pi * R * R / (spacing * spacing)));
  const auto rings = std::max(1L, std::lround(R / spacing));
  std::vector<Slot> in_rings;
  long inner = 0;
  for (long i = 1; i <= rings; ++i) {
    const auto outer = std::lround(static_cast<double>(n * i * i) / static_cast<double>(rings * rings));
    const double F = 0.5 * static_cast<double>(inner + outer) / static_cast<double>(n);
    const double r = outer - inner == 1 && inner == 0 ? 0 : flux_radius(c.profile, F);
    for (long k = inner; k < outer; ++k)
      in_rings.push_back(
          {r * R,
           2 * pi * (static_cast<double>(k - inner) + 0.5) / static_cast<double>(outer - inner) +
               golden_angle * static_cast<double>(i),
           c.speed() * profile_speed(c.profile, r)});
    inner = outer;
  }
  long stride = std::max(1L, std::lround(0.618 * static_cast<double>(n)));
  while (std::gcd(stride, n) != 1) ++stride;
  std::vector<Slot> slots;
  for (long k = 0; k < n; ++k) slots.push_back(in_rings[static_cast<std::size_t>(k * stride % n)]);
  return slots;
}

class PipeJet : public WaterEmitter {
 public:
  PipeJet(const PipeJetConfig& c, const InflowTarget& target)
      : WaterEmitter(c.name, c.outlets.open_outlets(),
                     c.outlets.flow_each() * static_cast<double>(c.outlets.open_outlets().size()),
                     c.outlets.start, c.outlets.stop.value_or(std::numeric_limits<double>::infinity()),
                     target),
        spacing_(std::cbrt(target.water->point_volume())),
        axis_(c.outlets.axis()),
        across_(tangent_frame(axis_)),
        slots_(make_slots(c, spacing_)) {}

  const char* kind() const override { return "pipe jet"; }

 protected:
  Placed place(std::size_t outlet, std::uint64_t k, double t_end) override {
    const std::uint64_t disc = k / slots_.size();
    const Slot& slot = slots_[k % slots_.size()];
    const double age = t_end - due(outlet, disc * slots_.size());
    const double angle = slot.angle + golden_angle * static_cast<double>(disc % 1000);
    const double step = slots_.size() > 1 ? jitter * spacing_ : 0;
    const Vec3 in_plane = (slot.radius * std::cos(angle) + random_.uniform(-step, step)) * across_[0] +
                          (slot.radius * std::sin(angle) + random_.uniform(-step, step)) * across_[1];
    return {in_plane + (slot.speed * age) * axis_, slot.speed * axis_};
  }

 private:
  double spacing_;
  Vec3 axis_;
  std::array<Vec3, 2> across_;
  std::vector<Slot> slots_;
};

/// Share of the flow of a 1/7 power profile inside r/R = 1 - y.
double turbulent_flux_inside(double y) {
  return 1 - 120.0 / 49 * (7.0 / 8 * std::pow(y, 8.0 / 7) - 7.0 / 15 * std::pow(y, 15.0 / 7));
}

}  // namespace

double profile_speed(JetProfile profile, double r) {
  return profile == JetProfile::flat ? 1 : 60.0 / 49 * std::pow(1 - r, 1.0 / 7);
}

double flux_radius(JetProfile profile, double F) {
  if (profile == JetProfile::flat) return std::sqrt(F);
  double lo = 0, hi = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lo + hi);
    (turbulent_flux_inside(1 - middle) < F ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

void PipeJetConfig::keys(Schema& s) {
  where = s.here();
  s.number("bore", bore,
           {.unit = "m", .required = true, .above = 0, .doc = "inner diameter", .example = "90 mm"});
  s.choice("profile", profile, {{"flat", JetProfile::flat}, {"turbulent", JetProfile::turbulent}},
           {.doc = "speed over the bore: one speed, or the 1/7 power law"});
  outlets.keys(s);
  if (!outlets.flow && !outlets.total_flow)
    s.problem("flow", "is missing", "a pipe needs its flow", "give 'flow' (of each pipe) or 'total_flow'");
}

double PipeJetConfig::speed() const {
  return outlets.flow_each() / (0.25 * pi * bore * bore);
}

std::unique_ptr<Inflow> make_pipe_jet(const PipeJetConfig& config, const InflowTarget& target) {
  fluid_of(target, config.name, config.where);
  return std::make_unique<PipeJet>(config, target);
}

}  // namespace sluice
