#pragma once
/// Three numbers in little memory, for what need not be known well: of a float its sign, its exponent and
/// seven binary digits, rounded to nearest. Doubles stay whole, so that the reference path does not round.

#include <array>
#include <bit>
#include <cstdint>

#include "base/state_archive.h"
#include "mpm/quads.h"

namespace sluice {

template <class Real>
struct BriefVector {
  std::array<Real, 3> x{};

  BriefVector() = default;
  explicit BriefVector(const Quad<Real>& v) : x{v[0], v[1], v[2]} {}
  /// The fourth is 0.
  Quad<Real> quad() const {
    const Quad<Real> q = {x[0], x[1], x[2], 0};
    return q;
  }
};

template <>
struct BriefVector<float> {
  std::array<std::uint16_t, 3> x{};  ///< upper halves

  BriefVector() = default;
  /// @pre finite and below 3e38
  explicit BriefVector(const Quad<float>& v) {
    for (int r = 0; r < 3; ++r)
      x[static_cast<std::size_t>(r)] =
          static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(v[r]) + 0x8000U) >> 16);
  }
  Quad<float> quad() const {
    const Quad<float> q = {whole(x[0]), whole(x[1]), whole(x[2]), 0};
    return q;
  }

 private:
  static float whole(std::uint16_t upper) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(upper) << 16);
  }
};

template <>
struct StateTraits<BriefVector<float>> {
  static constexpr Scalar scalar = Scalar::u8;
  static constexpr std::size_t count = 6;
};
template <>
struct StateTraits<BriefVector<double>> {
  static constexpr Scalar scalar = Scalar::f64;
  static constexpr std::size_t count = 3;
};

}  // namespace sluice
