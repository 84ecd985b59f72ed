#pragma once
/// Sixteen numbers of one grid node, handled as whole registers (one AVX-512 register in float).

#include "mpm/quads.h"

namespace sluice {

template <class Real>
struct Lanes {
  static constexpr int count = 16;
  typedef Real Register __attribute__((vector_size(64)));  // the attribute needs the typedef form
  static constexpr int registers = static_cast<int>(count * sizeof(Real) / 64);

  Register part[registers];

  Real* data() { return reinterpret_cast<Real*>(part); }
  const Real* data() const { return reinterpret_cast<const Real*>(part); }
  Real& operator[](int lane) { return data()[lane]; }
  const Real& operator[](int lane) const { return data()[lane]; }

  /// Lanes 8 n .. 8 n + 7.
  typedef Real Half __attribute__((vector_size(8 * sizeof(Real))));
  Half& half(int n) { return reinterpret_cast<Half*>(part)[n]; }
  const Half& half(int n) const { return reinterpret_cast<const Half*>(part)[n]; }
  /// Lanes 4 n .. 4 n + 3.
  Quad<Real>& quad(int n) { return reinterpret_cast<Quad<Real>*>(part)[n]; }
  const Quad<Real>& quad(int n) const { return reinterpret_cast<const Quad<Real>*>(part)[n]; }

  void clear() {
    for (Register& r : part) r = Register{};
  }
  void add(const Lanes& x) {
    for (int k = 0; k < registers; ++k) part[k] += x.part[k];
  }
  void add_scaled(Real s, const Lanes& x) {
    for (int k = 0; k < registers; ++k) part[k] += s * x.part[k];
  }
  /// this = a + s b
  void set_sum(const Lanes& a, Real s, const Lanes& b) {
    for (int k = 0; k < registers; ++k) part[k] = a.part[k] + s * b.part[k];
  }
};

}  // namespace sluice
