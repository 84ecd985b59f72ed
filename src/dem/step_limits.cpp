#include "dem/step_limits.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "dem/faces.h"
#include "dem/hertz_mindlin.h"

namespace sluice {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double solid_fraction = 0.6;  // random packing
constexpr double coordination = 6;      // isostatic, frictionless (Rumpf's formula, risk 10)
constexpr int directions = 4000;        // Fibonacci points on the sphere, 0.03 rad apart

double mobility_at(const RockShape& shape, double root_ratio, const Vec3& arm, const Vec3& n) {
  Mat3 cross;
  cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  const Mat3 mobility = Mat3::Identity() - cross * shape.inertia.cwiseInverse().asDiagonal() * cross;
  const Mat3 root = root_ratio * Mat3::Identity() + (1 - root_ratio) * n * n.transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(root * mobility * root, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

double volume_most(const DemScene& scene) {
  double most = 0;
  for (const RockShape& shape : scene.shapes) most = std::max(most, shape.volume);
  return most;
}

double volume_per_mobility(const DemScene& scene, double tangential_ratio) {
  double least = std::numeric_limits<double>::infinity();
  for (const RockShape& shape : scene.shapes)
    least = std::min(least, shape.volume / contact_mobility(shape, tangential_ratio));
  return least;
}

/// Mean force between rocks of size d below `bed_depth` (Rumpf) [N].
double bed_force(const DemConfig& config, const DemScene& scene, double d) {
  const double pressure = solid_fraction * scene.densest * scene.gravity.norm() * config.bed_depth;
  return pi * d * d * pressure / (solid_fraction * coordination);
}

double lagged_dashpot(double zeta) {
  return std::sqrt(1 + zeta * zeta) - zeta;
}

/// Takes the shorter of the network limit and of the step by contact time.
void take_shorter(const DemConfig& config, double network, double contact_time, const std::string& contact,
                  DemStepLimits& limits) {
  limits.network = std::min(limits.network, network);
  limits.contact_time = std::min(limits.contact_time, contact_time);
  const double by_network = config.network_fraction * network;
  const double by_contact = contact_time / config.steps_per_contact;
  const double step = std::min(by_network, by_contact);
  if (!(step < limits.step)) return;
  limits.step = step;
  limits.governed_by = by_network < by_contact ? "network_fraction" : "steps_per_contact";
  limits.contact = contact;
}

void limit_linear(const DemConfig& config, const DemScene& scene, DemStepLimits& limits) {
  const double least_mass_per_mobility = volume_per_mobility(scene, config.tangential_ratio);
  double lightest = scene.densest;
  for (const Material& material : scene.materials.all)
    if (material.density > 0) lightest = std::min(lightest, material.density);
  double zeta_most = 0, phase_least = std::numeric_limits<double>::infinity();
  for (const PairProperties& pair : scene.materials.pairs) {
    if (pair.law != ForceLaw::linear) continue;
    const double zeta = damping_ratio(pair.restitution, config.end_of_contact);
    zeta_most = std::max(zeta_most, zeta);
    phase_least = std::min(phase_least, contact_phase(zeta, config.end_of_contact));
  }

  const double radius_overlap = 0.5 * config.impact_overlap;
  const double impact = scene.densest * volume_most(scene) * config.impact_speed * config.impact_speed /
                        (radius_overlap * radius_overlap);
  const double pressure = solid_fraction * scene.densest * scene.gravity.norm() * config.bed_depth;
  const double bed = pi / (solid_fraction * coordination) * pressure / (0.5 * config.bed_overlap);
  limits.stiffness_per_size = config.stiffness_per_size.value_or(std::max(impact, bed));
  limits.stiffness_from = config.stiffness_per_size ? "stiffness_per_size"
                          : impact >= bed           ? "impact_overlap"
                                                    : "bed_overlap";

  const double d = scene.smallest_size;
  const double mass = lightest * least_mass_per_mobility * d * d * d;
  const double k = limits.stiffness_per_size * d;
  const double k_most = k * 2 * scene.largest_size / (d + scene.largest_size);
  const double network = (4 + 8 * config.tangential_ratio) * k_most;
  take_shorter(config, 2 * std::sqrt(mass / network) * lagged_dashpot(zeta_most),
               phase_least * std::sqrt(mass / (2 * k)), "", limits);
}

/// A rock of material `rock` and the smallest size on material `other`.
void limit_hertz(const DemConfig& config, const DemScene& scene, int rock, int other, DemStepLimits& limits) {
  const auto density = [&](int material) {
    return scene.materials.all[static_cast<std::size_t>(material)].density;
  };
  const ContactLaw law = contact_law(scene.materials, rock, other, config.end_of_contact);
  const bool on_wall = !(density(other) > 0);
  const double d = scene.smallest_size, largest = scene.largest_size;

  // Shortest on an equal, where both yield, or on a wall; lever arms along the normal included.
  Indentation at;
  at.radius_effective = on_wall ? 0.5 * d : 0.25 * d;
  at.mass_effective =
      volume_per_mobility(scene, 0) * d * d * d *
      (on_wall ? density(rock) : density(rock) * density(other) / (density(rock) + density(other)));
  const double contact_time = hertz_contact_time(law, at, config.impact_speed, config.end_of_contact);

  // Stiffest where it is pressed deepest: on the largest partner, by the impact or by the bed.
  const double mass = density(rock) * volume_most(scene) * d * d * d;
  const double partner = density(other) * volume_most(scene) * largest * largest * largest;
  at.radius_effective = on_wall ? 0.5 * d : 0.5 * d * largest / (d + largest);
  at.mass_effective = on_wall ? mass : mass * partner / (mass + partner);
  const double pull = law.adhesion * at.radius_effective;
  const double impact =
      hertz_impact_overlap(law.modulus, at.radius_effective, at.mass_effective, config.impact_speed, pull);
  const double pressed = 0.75 * (bed_force(config, scene, d) + pull) / law.modulus;
  at.overlap = std::max(impact, std::cbrt(pressed * pressed / at.radius_effective));
  limits.hertz_overlap = std::max(limits.hertz_overlap, 2 * at.overlap / d);
  const double network = (4 + 8 * law.shear_ratio) * tangent_stiffness(law, at);
  const double nimble = density(rock) * volume_per_mobility(scene, law.shear_ratio) * d * d * d;
  // c_n over 2 sqrt(m S) is sqrt(5/6) zeta
  take_shorter(
      config, 2 * std::sqrt(nimble / network) * lagged_dashpot(std::sqrt(5.0 / 6) * law.zeta), contact_time,
      fmt::format("hertz_mindlin, {} on {}", scene.materials.all[static_cast<std::size_t>(rock)].name,
                  scene.materials.all[static_cast<std::size_t>(other)].name),
      limits);
}
}  // namespace

bool linear_law_used(const Materials& materials) {
  const int n = static_cast<int>(materials.all.size());
  const auto rock = [&](int a) { return materials.all[static_cast<std::size_t>(a)].density > 0; };
  bool hertz = false;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (!materials.pair(a, b).meets || (!rock(a) && !rock(b))) continue;
      if (materials.pair(a, b).law == ForceLaw::linear) return true;
      hertz = true;
    }
  return !hertz;
}

double contact_mobility(const RockShape& shape, double tangential_ratio) {
  if (shape.is_sphere()) return std::max(1.0, 3.5 * tangential_ratio);
  const double root = std::sqrt(tangential_ratio);
  std::optional<FaceCopies> copies;
  if (has_faces(shape.blockiness)) copies = make_face_copies(shape.semi_axes, shape.blockiness);
  double most = 1;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / directions;
    const double angle = i * pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    const Vec3 n(r * std::cos(angle), r * std::sin(angle), z);
    most = std::max(most, mobility_at(shape, root, support_point(shape.semi_axes, shape.blockiness, n), n));
    if (!copies) continue;
    // The contacts of four copies together are at most as mobile as the most mobile of them.
    for (const Quat& turn : copies->turns) {
      const Vec3 arm = turn * support_point(copies->semi_axes, shape.blockiness, turn.conjugate() * n);
      most = std::max(most, mobility_at(shape, root, arm, n));
    }
  }
  return most;
}

DemStepLimits choose_limits(const DemConfig& config, const DemScene& scene) {
  constexpr double none = std::numeric_limits<double>::infinity();
  DemStepLimits limits;
  limits.network = limits.contact_time = limits.step = none;
  limits.stiffness_from = "youngs_modulus";
  if (linear_law_used(scene.materials)) limit_linear(config, scene, limits);
  const int n = static_cast<int>(scene.materials.all.size());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      if (scene.materials.pair(a, b).law == ForceLaw::hertz_mindlin &&
          scene.materials.all[static_cast<std::size_t>(a)].density > 0)
        limit_hertz(config, scene, a, b, limits);
  return limits;
}

}  // namespace sluice
