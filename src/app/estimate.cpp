#include "app/estimate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace sluice {

namespace {

// Measured in the demo feed box, 2 threads, inside their own stages.
constexpr double sphere_steps_per_s = 5e6;
constexpr double superquadric_steps_per_s = 1.8e6;
constexpr double point_steps_per_s = 1.1e6;
constexpr double wall_steps_per_s = 7e4;  ///< in a shaken pan of 0.1 m2 with 10 mm cells
constexpr double bytes_per_rock = 1500;   ///< neighbours and contacts included
constexpr double bytes_per_point = 250;

std::string duration_for_people(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

RunEstimate estimate_run(const ProcessConfig& config, const Simulation& simulation) {
  const Parts& parts = simulation.parts();
  RunEstimate e;
  const double g = config.gravity.norm();
  const double height = parts.domain.box.size().z();
  e.residence = g > 0 ? 1 + 2 * std::sqrt(2 * height / g) : config.duration;
  const double stay = std::min(e.residence, config.duration);
  bool spheres = true;
  if (parts.rocks) {
    e.rocks = static_cast<double>(parts.rocks->rocks().count());
    std::vector<RockShape> shapes;
    for (const ConveyorFeedConfig& feed : config.conveyors) {
      const SizeDistribution sizes(feed.sizes);
      const ShapeMix mix = make_shape_mix(feed.shapes, shapes);
      for (const Material& m : parts.rocks->materials().all)
        if (m.name == feed.material)
          e.rocks += feed.rate * (1 - sizes.fines_fraction()) /
                     (m.density * mix.mean_volume() * sizes.mean_cube()) * stay;
    }
    for (const RockShape& shape : parts.rocks->shapes()) spheres = spheres && shape.is_sphere();
    e.rock_steps = e.rocks * config.duration / simulation.time_step().dt_rock();
    e.rock_rate = spheres ? sphere_steps_per_s : superquadric_steps_per_s;
  }
  if (parts.water) {
    double flow = 0;  // m3/s
    for (const PipeJetConfig& pipe : config.pipes)
      flow += pipe.outlets.flow_each() * static_cast<double>(pipe.outlets.open_outlets().size());
    for (const ChannelInflowConfig& channel : config.channels)
      flow += channel.outlets.flow_each() * static_cast<double>(channel.outlets.open_outlets().size());
    for (const SprayNozzleConfig& spray : config.sprays)
      flow += spray.flow_each() * static_cast<double>(spray.outlets.open_outlets().size());
    for (const ConveyorFeedConfig& feed : config.conveyors)
      flow += feed.rate * feed.moisture / parts.water->model().density;
    e.water_points = static_cast<double>(parts.water->count()) + flow * stay / parts.water->point_volume();
    e.point_steps = e.water_points * config.duration / simulation.time_step().dt_fluid();
    e.point_rate = point_steps_per_s;
    const double spacing = parts.water->spacing();
    for (const Wall& wall : parts.walls->all()) {
      if (!wall.motion || wall.blocks == BlocksPhase::rocks_only) continue;
      double area = 0;
      for (std::size_t t = 0; t < wall.mesh.triangles.size(); ++t)
        area += wall.mesh.area(static_cast<int>(t));
      e.wall_steps += area / (spacing * spacing) * config.duration / simulation.time_step().dt_fluid();
      e.wall_rate = wall_steps_per_s;
    }
  }
  e.memory_bytes = e.rocks * bytes_per_rock + e.water_points * bytes_per_point +
                   (parts.rocks ? static_cast<double>(parts.rocks->memory_bytes()) : 0.0) +
                   (parts.water ? static_cast<double>(parts.water->memory_bytes()) : 0.0);
  if (e.rock_rate > 0) e.seconds += e.rock_steps / e.rock_rate;
  if (e.point_rate > 0) e.seconds += e.point_steps / e.point_rate;
  if (e.wall_rate > 0) e.seconds += e.wall_steps / e.wall_rate;
  return e;
}

void print_estimate(const RunEstimate& e) {
  fmt::print("\nestimate, if rock and water stay {:.1f} s:", e.residence);
  if (e.rock_rate > 0) fmt::print(" {:.0f} rocks,", e.rocks);
  if (e.point_rate > 0) fmt::print(" {:.0f} water points,", e.water_points);
  fmt::print(" {:.0f} MB, about {} of run time", e.memory_bytes / 1e6, duration_for_people(e.seconds));
  fmt::print(" (at");
  if (e.rock_rate > 0) fmt::print(" {:.2g} M rock-steps/s", e.rock_rate / 1e6);
  if (e.point_rate > 0) fmt::print(" {:.2g} M point-steps/s", e.point_rate / 1e6);
  if (e.wall_rate > 0) fmt::print(" {:.2g} M moving wall cells/s", e.wall_rate / 1e6);
  fmt::print(", measured on two cores)\n");
}

void print_parts(const Parts& parts) {
  fmt::print("parts: {}; left out: {}\n", fmt::join(parts.present(), ", "),
             parts.left_out().empty() ? std::string("nothing")
                                      : fmt::format("{}", fmt::join(parts.left_out(), ", ")));
}

}  // namespace sluice
