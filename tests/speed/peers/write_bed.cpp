/// Writes a bed of spheres for the peers: write_bed dense_200k DIR
///   DIR/bed.data      positions, velocities, diameters as a LAMMPS data file (LIGGGHTS reads the same)
///   DIR/constants.in  stiffness, damping, friction and time step of the same contacts as variables
///
/// The peers have one stiffness for all pairs; here it is that of two of the smallest rocks, which set the
/// time step.

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <numbers>

#include "dem/contact_law.h"
#include "speed/dem_scenes.h"

namespace sluice::speed {
namespace {

void write_data(const Bed& bed, const std::string& path) {
  std::ofstream out(path);
  out << "sluice bed\n\n" << bed.rocks.size() << " atoms\n1 atom types\n\n";
  for (int k = 0; k < 3; ++k)
    out << fmt::format("{:.17g} {:.17g} {}lo {}hi\n", bed.domain.box.lo[k], bed.domain.box.hi[k], "xyz"[k],
                       "xyz"[k]);
  out << "\nAtoms\n\n";
  for (std::size_t i = 0; i < bed.rocks.size(); ++i) {
    const Vec3 x = bed.domain.wrapped(bed.rocks[i].x);
    out << fmt::format("{} 1 {:.17g} {} {:.17g} {:.17g} {:.17g}\n", i + 1, bed.rocks[i].size, density, x.x(),
                       x.y(), x.z());
  }
  out << "\nVelocities\n\n";
  for (std::size_t i = 0; i < bed.rocks.size(); ++i) {
    const Vec3& v = bed.rocks[i].v;
    out << fmt::format("{} {:.17g} {:.17g} {:.17g} 0 0 0\n", i + 1, v.x(), v.y(), v.z());
  }
}

void write_constants(const Bed& bed, const std::string& path) {
  const Walls none;
  const DemSystem dem(config_of_beds(), scene_of(bed), none);
  const double d = bed.smallest, k_n = stiffness_per_size * d;
  const double mass = 0.5 * density * std::numbers::pi / 6 * d * d * d;  // of two, reduced
  const double zeta = damping_ratio(restitution, EndOfContact::no_tension);
  const double gamma_n = 2 * zeta * std::sqrt(k_n / mass);  // the peers multiply by the reduced mass
  std::ofstream out(path);
  const auto variable = [&](const char* name, double value) {
    out << fmt::format("variable {} equal {:.17g}\n", name, value);
  };
  variable("kn", k_n);
  variable("kt", tangential_ratio * k_n);
  variable("gamman", gamma_n);
  variable("gammat", std::sqrt(tangential_ratio) * gamma_n);
  variable("mu", friction);
  variable("dt", dem.step_size());
  variable("smallest", bed.smallest);
}

int run(const std::string& name, const std::string& folder) {
  const std::map<std::string, BedRecipe (*)()> recipes{
      {"dense_200k", dense_200k}, {"poly5_50k", poly5_50k}, {"poly50_50k", poly50_50k}};
  const auto recipe = recipes.find(name);
  if (recipe == recipes.end()) {
    fmt::print(stderr, "write_bed: no bed is called '{}'\n", name);
    return 2;
  }
  const Bed bed = make_bed(recipe->second());
  write_data(bed, folder + "/bed.data");
  write_constants(bed, folder + "/constants.in");
  return 0;
}

}  // namespace
}  // namespace sluice::speed

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: write_bed BED FOLDER\n");
    return 2;
  }
  return sluice::speed::run(argv[1], argv[2]);
}
