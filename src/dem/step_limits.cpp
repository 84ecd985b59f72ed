#include "dem/step_limits.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sluice {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double solid_fraction = 0.6;  // random packing
constexpr double coordination = 6;      // isostatic, frictionless (Rumpf's formula, risk 10)
constexpr int directions = 4000;        // Fibonacci points on the sphere, 0.03 rad apart

double mobility_at(const RockShape& shape, double root_ratio, const Vec3& n) {
  const Vec3 arm = support_point(shape.semi_axes, shape.blockiness, n);
  Mat3 cross;
  cross << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  const Mat3 mobility = Mat3::Identity() - cross * shape.inertia.cwiseInverse().asDiagonal() * cross;
  const Mat3 root = root_ratio * Mat3::Identity() + (1 - root_ratio) * n * n.transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(root * mobility * root, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}
}  // namespace

double contact_mobility(const RockShape& shape, double tangential_ratio) {
  if (shape.is_sphere()) return std::max(1.0, 3.5 * tangential_ratio);
  const double root = std::sqrt(tangential_ratio);
  double most = 1;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / directions;
    const double angle = i * pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    most = std::max(most, mobility_at(shape, root, Vec3(r * std::cos(angle), r * std::sin(angle), z)));
  }
  return most;
}

DemStepLimits choose_limits(const DemConfig& config, const DemScene& scene) {
  double volume_most = 0, least_mass_per_mobility = std::numeric_limits<double>::infinity();
  for (const RockShape& shape : scene.shapes) {
    volume_most = std::max(volume_most, shape.volume);
    least_mass_per_mobility =
        std::min(least_mass_per_mobility, shape.volume / contact_mobility(shape, config.tangential_ratio));
  }
  double lightest = scene.densest;
  for (const Material& material : scene.materials.all)
    if (material.density > 0) lightest = std::min(lightest, material.density);
  double zeta_most = 0, phase_least = std::numeric_limits<double>::infinity();
  for (const PairProperties& pair : scene.materials.pairs) {
    const double zeta = damping_ratio(pair.restitution, config.end_of_contact);
    zeta_most = std::max(zeta_most, zeta);
    phase_least = std::min(phase_least, contact_phase(zeta, config.end_of_contact));
  }

  DemStepLimits limits;
  const double radius_overlap = 0.5 * config.impact_overlap;
  const double impact = scene.densest * volume_most * config.impact_speed * config.impact_speed /
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
  limits.network = 2 * std::sqrt(mass / network) * (std::sqrt(1 + zeta_most * zeta_most) - zeta_most);
  limits.contact_time = phase_least * std::sqrt(mass / (2 * k));
  const double by_network = config.network_fraction * limits.network;
  const double by_contact = limits.contact_time / config.steps_per_contact;
  limits.step = std::min(by_network, by_contact);
  limits.governed_by = by_network < by_contact ? "network_fraction" : "steps_per_contact";
  return limits;
}

}  // namespace sluice
