#include "validation/water_channel.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/water_scenes.h"

namespace sluice {

namespace {

/// Mean speed of the layers of points, of half a cell each.
struct Profile {
  std::vector<double> z, v;
};
Profile profile_of(const FluidSystem& water, double layer, std::size_t layers) {
  std::vector<double> mass(layers), height(layers), speed(layers);
  const WaterPoints p = water.points();
  for (std::size_t i = 0; i < p.count(); ++i) {
    const auto k =
        static_cast<std::size_t>(std::clamp(p.x[i].z() / layer, 0.0, static_cast<double>(layers) - 1));
    mass[k] += p.mass[i];
    height[k] += p.mass[i] * p.x[i].z();
    speed[k] += p.mass[i] * p.v[i].x();
  }
  Profile out;
  for (std::size_t k = 0; k < layers; ++k) {
    if (mass[k] <= 0) continue;
    out.z.push_back(height[k] / mass[k]);
    out.v.push_back(speed[k] / mass[k]);
  }
  return out;
}

}  // namespace

void WaterChannel::keys(Schema& s) {
  s.number("cells", cells, {.at_least = 4, .doc = "grid cells across the channel"});
  s.choice("drive", drive, {{"force", ChannelDrive::force}, {"plate", ChannelDrive::plate}},
           {.doc = "a body force along the channel (Poiseuille), or the upper plate (Couette)"});
  s.number("yield_stress", yield_stress, {.at_least = 0, .doc = "of the liquid, over rho F H"});
  s.number("yield_rate", yield_rate, {.above = 0, .doc = "of its regularisation, over F H / nu"});
  s.number("flow_index", flow_index, {.at_least = 0.1, .at_most = 1, .doc = "of the liquid"});
}

Measured WaterChannel::run(const CsvTable& reference) const {
  const std::vector<double> time = reference_numbers(reference, "time");
  const std::vector<double> place = reference_numbers(reference, "place");
  const std::vector<double> speed = reference_numbers(reference, "speed");
  constexpr double nu = 0.1;  // with H = 1 m and speeds over 1 m/s [m2/s]
  const double h = 1 / cells, width = 4 * h;
  WaterSetup setup;
  setup.config.spacing = h;
  setup.config.fastest_bulk_speed = 1;
  setup.config.wall_slip = WallSlip::no_slip;
  setup.config.keep_tension = true;
  setup.config.fluid.viscosity = nu * setup.config.fluid.density;
  if (yield_stress > 0 || flow_index < 1) {  // F = nu and H = 1: shear rates are in units of F H / nu
    FluidModel& liquid = setup.config.fluid;
    liquid.rheology = Rheology::herschel_bulkley;
    liquid.yield_stress = yield_stress * liquid.density * nu;
    liquid.yield_rate = yield_rate;
    liquid.flow_index = flow_index;
  }
  if (drive == ChannelDrive::force) setup.gravity = {nu, 0, 0};
  setup.domain = water_domain({Vec3(0, 0, -h), Vec3(width, width, 1 + h)}, {true, true, false});
  std::vector<Wall> plates;
  for (const double z : {0.0, 1.0})
    plates.push_back(sheet("plate", {Vec3(-width, -width, z), Vec3(2 * width, -width, z),
                                     Vec3(2 * width, 2 * width, z), Vec3(-width, 2 * width, z)}));
  if (drive == ChannelDrive::plate) plates[1].surface_velocity = {1, 0, 0};
  WaterScene scene(setup, std::move(plates));
  WaterFill fill;
  fill.box = {Vec3::Zero(), Vec3(width, width, 1)};
  scene.fill(fill);
  Measured out;
  Profile profile;
  for (std::size_t n = 0; n < time.size(); ++n) {
    if (n == 0 || time[n] != time[n - 1]) {
      scene.run_to(time[n] / nu);
      profile = profile_of(*scene.water, 0.5 * h, static_cast<std::size_t>(2 * cells));
    }
    out.values.push_back({fmt::format("speed at nu t/H2 = {}, y/H = {}", time[n], place[n]),
                          interpolated(profile.z, profile.v, place[n]), speed[n], 1});
  }
  out.particle_steps = scene.point_steps;
  return out;
}

}  // namespace sluice
