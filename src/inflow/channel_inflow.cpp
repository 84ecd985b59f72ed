#include "inflow/channel_inflow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/errors.h"
#include "inflow/water_emitter.h"

namespace sluice {

namespace {

/// Random displacement of a point, of the spacing: breaks up rows without making holes.
constexpr double jitter = 0.1;
/// Sine of the angle between the way of the water and gravity, below which no side of a section is up.
constexpr double steepest = 0.1;

/// One place in a sheet.
struct Slot {
  double across = 0, height = 0;  ///< from the middle of the bed [m]
  double speed = 0;               ///< [m/s]
};

/// Rows of equal flux; neighbours in time lie apart in space.
std::vector<Slot> make_slots(const ChannelInflowConfig& c, double spacing) {
  const long rows = std::max(1L, std::lround(c.depth / spacing));
  const long in_row = std::max(1L, std::lround(c.width / spacing));
  const long n = rows * in_row;
  long stride = std::max(1L, std::lround(0.618 * static_cast<double>(n)));
  while (std::gcd(stride, n) != 1) ++stride;
  std::vector<Slot> slots;
  for (long k = 0; k < n; ++k) {
    const long place = k * stride % n;
    const double z =
        flux_height(c.profile, (static_cast<double>(place / in_row) + 0.5) / static_cast<double>(rows));
    const double y = (static_cast<double>(place % in_row) + 0.5) / static_cast<double>(in_row) - 0.5;
    slots.push_back({y * c.width, z * c.depth, c.speed() * profile_speed(c.profile, z)});
  }
  return slots;
}

class ChannelInflow : public WaterEmitter {
 public:
  ChannelInflow(const ChannelInflowConfig& c, const InflowTarget& target)
      : WaterEmitter(c.name, c.outlets.open_outlets(),
                     c.outlets.flow_each() * static_cast<double>(c.outlets.open_outlets().size()),
                     c.outlets.start, c.outlets.stop.value_or(std::numeric_limits<double>::infinity()),
                     target),
        depth_(c.depth),
        spacing_(std::cbrt(target.water->point_volume())),
        axis_(c.outlets.axis()),
        slots_(make_slots(c, spacing_)) {
    const Vec3 upward = -target.gravity + target.gravity.dot(axis_) * axis_;
    up_ = upward.normalized();
    const double sound_speed = target.water->limits().sound_speed;
    squeeze_ = upward.norm() / (sound_speed * sound_speed);
    if (is_rapid(c, upward.norm())) thrust_ = upward.norm();
  }

  const char* kind() const override { return "channel"; }

 protected:
  Placed place(std::size_t outlet, std::uint64_t k, double t_end) override {
    const std::uint64_t sheet = k / slots_.size();
    const Slot& slot = slots_[k % slots_.size()];
    const double age = t_end - due(outlet, sheet * slots_.size());
    const double step = jitter * spacing_;
    const double height = std::clamp(slot.height + random_.uniform(-step, step), 0.0, depth_);
    const Vec3 in_section =
        (slot.across + random_.uniform(-step, step)) * axis_.cross(up_) + (height - 0.5 * depth_) * up_;
    // Pressure over what passes: the push of the water behind, which is not simulated.
    const double pushed = thrust_ * (depth_ - slot.height) / slot.speed;
    return {in_section + (slot.speed * age) * axis_, (slot.speed + pushed) * axis_,
            1 / (1 + squeeze_ * (depth_ - height))};
  }

 private:
  double depth_, spacing_;
  Vec3 axis_, up_;
  double squeeze_;     ///< 1/J - 1 under a metre of water [1/m]
  double thrust_ = 0;  ///< gravity across the flow, where the water behind pushes [m/s2]
  std::vector<Slot> slots_;
};

}  // namespace

bool is_rapid(const ChannelInflowConfig& config, double gravity) {
  return config.speed() * config.speed() > gravity * config.depth;
}

double fastest_speed(const ChannelInflowConfig& config, double gravity) {
  const double thrust = is_rapid(config, gravity) ? gravity : 0;
  double fastest = 0;
  for (const double z : {0.05, 1.0}) {  // pushed most at the bed, flowing fastest at the surface
    const double speed = config.speed() * profile_speed(config.profile, z);
    fastest = std::max(fastest, speed + thrust * (1 - z) * config.depth / speed);
  }
  return fastest;
}

double profile_speed(ChannelProfile profile, double z) {
  return profile == ChannelProfile::flat ? 1 : 8.0 / 7 * std::pow(z, 1.0 / 7);
}

double flux_height(ChannelProfile profile, double F) {
  return profile == ChannelProfile::flat ? F : std::pow(F, 7.0 / 8);
}

void ChannelInflowConfig::keys(Schema& s) {
  where = s.here();
  s.number("width", width,
           {.unit = "m", .required = true, .above = 0, .doc = "of the channel", .example = "600 mm"});
  s.number("depth", depth,
           {.unit = "m", .required = true, .above = 0, .doc = "of the water in it", .example = "120 mm"});
  s.choice("profile", profile, {{"flat", ChannelProfile::flat}, {"turbulent", ChannelProfile::turbulent}},
           {.doc = "speed over the depth: one speed, or the 1/7 power law"});
  outlets.keys(s);
  if (!outlets.flow && !outlets.total_flow)
    s.problem("flow", "is missing", "a channel needs its flow",
              "give 'flow' (of each channel) or 'total_flow'");
}

double ChannelInflowConfig::speed() const {
  return outlets.flow_each() / (width * depth);
}

std::unique_ptr<Inflow> make_channel_inflow(const ChannelInflowConfig& config, const InflowTarget& target) {
  fluid_of(target, config.name, config.where);
  const double g = target.gravity.norm();
  const double across = target.gravity.cross(config.outlets.axis()).norm();
  if (g > 0 && across < steepest * g)
    throw InputError(InputProblem{config.where, "direction", "runs straight up or down",
                                  "a channel has its water on a bed", "use 'pipes', or a flatter direction"});
  if (!(g > 0))
    throw InputError(InputProblem{config.where, config.name, "is a channel without gravity",
                                  "which side of it is up is not known", "use 'pipes'"});
  return std::make_unique<ChannelInflow>(config, target);
}

}  // namespace sluice
