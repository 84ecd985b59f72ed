#pragma once
/// Doubles side by side, as wide as the processor's registers, for the kernels of superquadric_newton.h.
/// Every lane's result depends on that lane alone.

#include <cmath>

namespace sluice::newton {

inline double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
inline double absolute(double x) {
  return std::fabs(x);
}
inline double root(double x) {
  return std::sqrt(x);
}
inline bool any(bool mask) {
  return mask;
}

#if defined(__AVX512F__)
inline constexpr int kLanes = 8;
#elif defined(__AVX__)
inline constexpr int kLanes = 4;
#else
inline constexpr int kLanes = 2;
#endif

using Lanes = double __attribute__((vector_size(8 * kLanes)));
using LaneMask = long long __attribute__((vector_size(8 * kLanes)));

inline Lanes select(LaneMask mask, Lanes yes, Lanes no) {
  return mask ? yes : no;
}
inline Lanes absolute(Lanes x) {
  return reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(x) & 0x7fffffffffffffffLL);
}
inline Lanes root(Lanes x) {
  Lanes r;
  for (int k = 0; k < kLanes; ++k) r[k] = std::sqrt(x[k]);
  return r;
}
inline bool any(LaneMask mask) {
  long long joined = 0;
  for (int k = 0; k < kLanes; ++k) joined |= mask[k];
  return joined != 0;
}
inline Lanes all_lanes(double value) {
  return Lanes{} + value;
}

template <class Real>
Real larger(const Real& a, const Real& b) {
  return select(a > b, a, b);
}
template <class Real>
Real smaller(const Real& a, const Real& b) {
  return select(a < b, a, b);
}

/// f^(-1/m) for |f - 1| <= kNearOne, by the series of log (through atanh) and exp; to rounding.
inline constexpr double kNearOne = 1.0 / 16;
template <class Real>
Real inverse_root_near_one(const Real& f, const Real& m) {
  const Real z = (f - 1.0) / (f + 1.0);
  const Real q = z * z;
  const Real log =
      2.0 * z * (1.0 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7 + q * (1.0 / 9 + q * (1.0 / 11))))));
  const Real t = -log / m;
  return 1.0 + t * (1.0 + t * (1.0 / 2 +
                               t * (1.0 / 6 +
                                    t * (1.0 / 24 + t * (1.0 / 120 + t * (1.0 / 720 + t * (1.0 / 5040)))))));
}
inline double inverse_root(double f, double m) {
  return std::fabs(f - 1) <= kNearOne ? inverse_root_near_one(f, m) : std::pow(f, -1 / m);
}

/// x^y for x >= 1e-300 (smaller x count as that), |y log2 x| < 1000; relative error below 1e-15 times
/// 1 + |y log2 x|. Mantissa and exponent split, atanh series for log2, Taylor series for exp2.
inline Lanes power(Lanes x, Lanes y) {
  x = larger(x, all_lanes(1e-300));
  const LaneMask bits = reinterpret_cast<LaneMask>(x);
  // Exponent such that the mantissa lies in [sqrt(1/2), sqrt(2)).
  const LaneMask shifted = bits - 0x3fe6a09e667f3bcdLL;
  const LaneMask whole = shifted >> 52;
  const Lanes mantissa = reinterpret_cast<Lanes>(bits - (whole << 52));
  const Lanes z = (mantissa - 1.0) / (mantissa + 1.0);
  const Lanes q = z * z;
  Lanes series = all_lanes(1.0 / 21);
  for (int k = 19; k >= 1; k -= 2) series = series * q + 1.0 / k;
  constexpr double log2_e = 1.4426950408889634;
  const Lanes log2 = __builtin_convertvector(whole, Lanes) + (2 * log2_e) * z * series;
  const Lanes t = y * log2;
  // Nearest whole number by adding and taking off 1.5 * 2^52.
  constexpr double shift = 6755399441055744.0;
  const Lanes shifted_t = t + shift;
  const Lanes nearest = shifted_t - shift;
  const LaneMask scale = (reinterpret_cast<LaneMask>(shifted_t) - 0x4338000000000000LL + 1023) << 52;
  const Lanes f = (t - nearest) * 0.6931471805599453;
  Lanes exp = all_lanes(1.0 / 6227020800.0);
  constexpr double factorial[] = {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0, 720.0,
                                  120.0,       24.0,       6.0,       2.0,      1.0,     1.0};
  for (const double k : factorial) exp = exp * f + 1.0 / k;
  return exp * reinterpret_cast<Lanes>(scale);
}

inline Lanes inverse_root(Lanes f, Lanes m) {
  const Lanes series = inverse_root_near_one(f, m);
  const LaneMask near = absolute(f - 1.0) <= kNearOne;
  if (!any(~near)) return series;
  return select(near, series, power(f, -1.0 / m));
}

/// u^(m-2) for whole m from 2 to 17, each lane its own.
class LaneWholePower {
 public:
  explicit LaneWholePower(Lanes m) : m_(m) {
    const LaneMask exponent = __builtin_convertvector(m, LaneMask) - 2;
    one_ = (exponent & 1) != 0;
    two_ = (exponent & 2) != 0;
    four_ = (exponent & 4) != 0;
    eight_ = (exponent & 8) != 0;
    high_ = any((exponent & 12) != 0);
  }
  Lanes m() const { return m_; }
  Lanes operator()(Lanes u) const {
    const Lanes one = all_lanes(1.0);
    Lanes square = u * u;
    Lanes product = select(one_, u, one) * select(two_, square, one);
    if (!high_) return product;
    square *= square;
    product *= select(four_, square, one);
    square *= square;
    return product * select(eight_, square, one);
  }

 private:
  Lanes m_;
  LaneMask one_, two_, four_, eight_;
  bool high_;
};

/// u^(m-2) for any m.
class LaneAnyPower {
 public:
  explicit LaneAnyPower(Lanes m) : m_(m) {}
  Lanes m() const { return m_; }
  Lanes operator()(Lanes u) const { return select(m_ == 2.0, all_lanes(1.0), power(u, m_ - 2.0)); }

 private:
  Lanes m_;
};

}  // namespace sluice::newton
