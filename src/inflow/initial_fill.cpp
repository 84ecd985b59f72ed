#include "inflow/initial_fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/dem_system.h"
#include "fluid/fluid_system.h"
#include "geometry/audit_mesh.h"
#include "inflow/feed_clock.h"

namespace sluice {

namespace {

/// Places tried for a rock before the box counts as full. Random places hold spheres up to about 38 % of the
/// volume (Widom 1966); at 30 % about one place in 30 is free.
constexpr int places_per_rock = 20000;
/// Largest g H / c^2 of a fill. Weakly compressible water is meant for 0.01; beyond this it is a gas.
constexpr double largest_squeeze = 0.2;
/// Keeps the streams of fills apart from those of feeds.
constexpr std::uint64_t water_fill_stream = 1ULL << 42, rock_fill_stream = 1ULL << 43;

/// Volume [m3] of a sphere of this radius [m].
double bounding_sphere(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

void check_inside(const Location& where, const Vec3& low, const Vec3& high, const Domain& domain) {
  if (domain.outside(low) || domain.outside(high))
    throw InputError(InputProblem{where, domain.outside(high) ? "high" : "low", "lies outside the domain",
                                  "what begins there would be lost at once",
                                  "move the corner inside or enlarge the domain"});
}

}  // namespace

FilledMass fill_water(const WaterFillConfig& c, const Walls& walls, const InflowTarget& target) {
  if (target.water == nullptr)
    throw InputError(InputProblem{c.where, c.name, "fills in water", "the process has no 'water' section",
                                  "add 'water' or take the entry out"});
  check_inside(c.where, c.low, c.high, target.domain);
  FluidSystem& fluid = *target.water;
  const FluidModel& model = fluid.model();
  if (c.fines >= model.packing)
    throw InputError(InputProblem{c.where, "fines", fmt::format("is {:.3g} %", 100 * c.fines),
                                  fmt::format("the slurry stops flowing at {:.3g} %", 100 * model.packing),
                                  "lower it"});
  const Wall* part = nullptr;
  for (const Wall& wall : walls.all())
    if (!c.inside.empty() && wall.name == c.inside) part = &wall;
  if (!c.inside.empty() && part == nullptr)
    throw InputError(InputProblem{c.where, "inside", fmt::format("names '{}'", c.inside),
                                  "there is no such part", "use the name of a closed part under 'parts'"});
  if (part != nullptr && !std::ranges::all_of(audit_mesh(part->mesh), &PartAudit::closed))
    throw InputError(InputProblem{c.where, "inside", fmt::format("names '{}', which is not closed", c.inside),
                                  "an open sheet has no inside", "name a closed part or give a box only"});
  std::optional<SurfaceQuery> closed;
  if (part != nullptr) closed.emplace(part->mesh);

  // A lattice that fills the box: whole rows in each direction.
  const double top = c.level.value_or(c.high.z());
  const Vec3 size = Vec3(c.high.x(), c.high.y(), top) - c.low;
  const double spacing = std::cbrt(fluid.point_volume());
  std::array<long, 3> rows;
  Vec3 step;
  for (int k = 0; k < 3; ++k) {
    rows[static_cast<std::size_t>(k)] = std::max(1L, std::lround(size[k] / spacing));
    step[k] = size[k] / static_cast<double>(rows[static_cast<std::size_t>(k)]);
  }
  const double cell = step.prod();
  const double clear = model.density * (1 - c.fines), grains = model.fines_density * c.fines;
  const double c_squared = std::pow(fluid.limits().sound_speed, 2);
  const double weight = std::max(0.0, -target.gravity.z());
  if (const double squeeze = weight * size.z() / c_squared; c.hydrostatic && squeeze > largest_squeeze)
    throw InputError(InputProblem{
        c.where, c.name, fmt::format("would be {:.3g} % denser at its bottom", 100 * std::expm1(squeeze)),
        fmt::format("under {:.3g} m of water, at a sound speed of {:.3g} m/s", size.z(),
                    fluid.limits().sound_speed),
        "set 'water.deepest' to the depth, or raise 'water.fastest_bulk_speed' or 'water.sound_speed'"});

  Random random(target.seed, water_fill_stream + static_cast<std::uint64_t>(target.index));
  FilledMass filled;
  for (long k = 0; k < rows[2]; ++k)
    for (long j = 0; j < rows[1]; ++j)
      for (long i = 0; i < rows[0]; ++i) {
        Vec3 x = c.low + step.cwiseProduct(Vec3(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5,
                                                static_cast<double>(k) + 0.5));
        const double depth = top - x.z();
        if (closed && !closed->inside(x)) continue;
        if (c.jitter > 0)
          for (int axis = 0; axis < 3; ++axis) x[axis] += c.jitter * step[axis] * random.uniform(-1, 1);
        const double J = c.hydrostatic ? std::exp(-weight * depth / c_squared) : 1.0;
        const NewPoint point{.x = x,
                             .v = c.velocity,
                             .mass = stored_mass((clear + grains) * cell / J),
                             .fines_mass = stored_mass(grains * cell / J),
                             .J = J};
        fluid.add(point);
        filled.mass += point.mass;
        filled.fines += point.fines_mass;
        ++filled.count;
      }
  filled.momentum = filled.mass * c.velocity;
  return filled;
}

FilledMass fill_rocks(const RockFillConfig& c, const ShapeMix& mix, const InflowTarget& target) {
  if (target.rocks == nullptr)
    throw InputError(InputProblem{c.where, c.name, "fills in rocks", "the process has no 'rocks' section",
                                  "add 'rocks' or take the entry out"});
  check_inside(c.where, c.low, c.high, target.domain);
  DemSystem& rocks = *target.rocks;
  const auto& materials = rocks.materials().all;
  const auto found = std::find_if(materials.begin(), materials.end(),
                                  [&](const Material& m) { return m.name == c.material; });
  if (found == materials.end())
    throw InputError(InputProblem{c.where, "material", fmt::format("names '{}'", c.material),
                                  "there is no such material", "list it under 'materials'"});
  const int material = static_cast<int>(found - materials.begin());

  // Draw all, then place the largest first: the small ones find room between them.
  struct Drawn {
    double size, mass;
    int shape;
  };
  Random random(target.seed, rock_fill_stream + static_cast<std::uint64_t>(target.index));
  const SizeDistribution sizes(c.sizes);
  const std::vector<RockShape>& shapes = rocks.shapes();
  std::vector<Drawn> drawn;
  double total = 0, spheres = 0;
  const double room = (c.high - c.low).prod();
  while (c.mass ? total < *c.mass : static_cast<std::int64_t>(drawn.size()) < c.count) {
    const double size = sizes.draw(random);
    const int shape = mix.draw(random);
    const double mass = rocks.mass_of(shape, material, size);
    if (c.mass && !drawn.empty() && total + 0.5 * mass > *c.mass) break;
    drawn.push_back({size, mass, shape});
    total += mass;
    spheres += bounding_sphere(shapes[static_cast<std::size_t>(shape)].bounding_radius * size);
    if (spheres > room)
      throw InputError(InputProblem{
          c.where, c.mass ? "mass" : "count",
          c.mass ? fmt::format("is {:.4g} kg", *c.mass) : fmt::format("asks for {} rocks", c.count),
          fmt::format("the bounding spheres of the first {} rocks fill the box, with {:.3g} kg", drawn.size(),
                      total),
          "enlarge the box (rocks fall into place) or ask for less"});
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Drawn& a, const Drawn& b) { return a.size > b.size; });

  FilledMass filled;
  spheres = 0;
  for (const Drawn& d : drawn) {
    const double R = shapes[static_cast<std::size_t>(d.shape)].bounding_radius * d.size;
    const Vec3 lo = c.low + Vec3::Constant(R), hi = c.high - Vec3::Constant(R);
    bool placed = false;
    for (int i = 0; i < places_per_rock && !placed && (lo.array() <= hi.array()).all(); ++i) {
      const Vec3 x(random.uniform(lo.x(), hi.x()), random.uniform(lo.y(), hi.y()),
                   random.uniform(lo.z(), hi.z()));
      if (!rocks.has_room(x, R, true)) continue;
      rocks.add({.x = x,
                 .v = c.velocity,
                 .q = random.rotation(),
                 .shape = d.shape,
                 .material = material,
                 .source = target.index,
                 .size = d.size});
      placed = true;
    }
    if (!placed)
      throw InputError(
          InputProblem{c.where, c.mass ? "mass" : "count", fmt::format("asks for {} rocks", drawn.size()),
                       fmt::format("{} found room; their bounding spheres fill {:.0f} % of the box",
                                   filled.count, 100 * spheres / room),
                       "enlarge the box (rocks fall into place) or ask for fewer"});
    spheres += bounding_sphere(R);
    filled.mass += d.mass;
    ++filled.count;
  }
  filled.momentum = filled.mass * c.velocity;
  return filled;
}

}  // namespace sluice
