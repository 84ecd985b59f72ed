#include "base/random.h"

#include <cmath>
#include <numbers>

namespace sluice {

using std::numbers::pi;

Random::Random(std::uint64_t seed, std::uint64_t stream) {
  increment = (mix64(stream) << 1) | 1;
  state = mix64(seed) + increment;
  next();
}

std::uint32_t Random::next() {
  const std::uint64_t old = state;
  state = old * 6364136223846793005ULL + increment;
  const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
  const auto turn = static_cast<std::uint32_t>(old >> 59);
  return (shifted >> turn) | (shifted << ((32 - turn) & 31));
}

double Random::uniform() {
  const std::uint64_t high = next();
  const std::uint64_t low = next();
  return static_cast<double>(((high << 32) | low) >> 11) * 0x1.0p-53;
}

double Random::uniform(double lo, double hi) {
  return lo + (hi - lo) * uniform();
}

double Random::normal() {
  const double r = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return r * std::cos(2.0 * pi * uniform());
}

Vec3 Random::on_sphere() {
  const double z = uniform(-1.0, 1.0);
  const double phi = uniform(0.0, 2.0 * pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Quat Random::rotation() {
  const double u = uniform();
  const double a = 2.0 * pi * uniform();
  const double b = 2.0 * pi * uniform();
  return Quat(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a), std::sqrt(1.0 - u) * std::cos(a),
              std::sqrt(u) * std::sin(b));
}

}  // namespace sluice
