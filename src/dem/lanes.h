#pragma once
/// Doubles side by side, as wide as the processor's registers, for the kernels of contacts. Every lane's
/// result depends on that lane alone. The same functions take plain doubles, so that one source serves both.

#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include <cmath>

namespace sluice::lanes {

inline double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
inline double absolute(double x) {
  return std::fabs(x);
}
inline double root(double x) {
  return std::sqrt(x);
}
inline double reciprocal(double x) {
  return 1 / x;
}
inline double reciprocal_root(double x) {
  return 1 / std::sqrt(x);
}
inline double quick_root(double x) {
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
using LaneMask = decltype(Lanes{} < Lanes{});

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
/// 1/x and 1/sqrt(x) for normal x > 0 (and x < 0), to one or two units in the last place: two Newton steps
/// from the processor's 14 bits where it has them, since divisions are what these kernels would wait for.
inline Lanes reciprocal(Lanes x) {
#if defined(__AVX512F__)
  // The masked form: gcc 12 warns of its own header in the other.
  Lanes y = _mm512_maskz_rcp14_pd(0xff, x);
  y = y + y * (1.0 - x * y);
  return y + y * (1.0 - x * y);
#else
  return 1.0 / x;
#endif
}
inline Lanes reciprocal_root(Lanes x) {
#if defined(__AVX512F__)
  Lanes y = _mm512_maskz_rsqrt14_pd(0xff, x);
  y = y + 0.5 * y * (1.0 - x * y * y);
  return y + 0.5 * y * (1.0 - x * y * y);
#else
  return 1.0 / root(x);
#endif
}
/// sqrt(x) for x >= 0, to two units in the last place; below 1e-290 less than it is.
inline Lanes quick_root(Lanes x) {
#if defined(__AVX512F__)
  const Lanes least = Lanes{} + 1e-290;
  return x * reciprocal_root(x > least ? x : least);
#else
  return root(x);
#endif
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
struct Triple {
  Real x, y, z;
};
template <class Real>
Real dot(const Triple<Real>& a, const Triple<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
Triple<Real> operator+(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
Triple<Real> operator-(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
Triple<Real> operator*(const Real& s, const Triple<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Mask, class Real>
Triple<Real> select(const Mask& mask, const Triple<Real>& yes, const Triple<Real>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

template <class Real>
Real larger(const Real& a, const Real& b) {
  return select(a > b, a, b);
}
template <class Real>
Real smaller(const Real& a, const Real& b) {
  return select(a < b, a, b);
}

/// (1 + e)^p for |e| <= kNearOne, by the binomial series; to rounding.
inline constexpr double kNearOne = 1.0 / 64;
template <class Real>
Real power_near_one(const Real& e, const Real& p) {
  Real sum = Real{} + 1.0;
  for (int k = 9; k >= 0; --k) sum = 1.0 + (p - static_cast<double>(k)) * (e * (1.0 / (k + 1))) * sum;
  return sum;
}
/// f^p.
inline double power_of_sum(double f, double p) {
  return std::fabs(f - 1) <= kNearOne ? power_near_one(f - 1, p) : std::pow(f, p);
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

inline Lanes power_of_sum(Lanes f, Lanes p) {
  const Lanes series = power_near_one(f - 1.0, p);
  const LaneMask near = absolute(f - 1.0) <= kNearOne;
  if (!any(~near)) return series;
  return select(near, series, power(f, p));
}

/// u^(m-2) for whole m from 2 to 17, each lane its own.
class LaneWholePower {
 public:
  explicit LaneWholePower(Lanes m) : m_(m), root_(-1.0 / m) {
    const LaneMask exponent = __builtin_convertvector(m, LaneMask) - 2;
    one_ = (exponent & 1) != 0;
    two_ = (exponent & 2) != 0;
    four_ = (exponent & 4) != 0;
    eight_ = (exponent & 8) != 0;
    high_ = any((exponent & 12) != 0);
  }
  Lanes m() const { return m_; }
  Lanes root_exponent() const { return root_; }
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
  Lanes m_, root_;
  LaneMask one_, two_, four_, eight_;
  bool high_;
};

/// u^(m-2) for any m.
class LaneAnyPower {
 public:
  explicit LaneAnyPower(Lanes m) : m_(m), root_(-1.0 / m) {}
  Lanes m() const { return m_; }
  Lanes root_exponent() const { return root_; }
  Lanes operator()(Lanes u) const { return select(m_ == 2.0, all_lanes(1.0), power(u, m_ - 2.0)); }

 private:
  Lanes m_, root_;
};

}  // namespace sluice::lanes
