#pragma once
/// Saving and restoring state with one function for both ways:
///
///   void Thing::exchange(StateArchive& a) {
///     a.value("clock", clock_);
///     a.values("x", x_);
///   }
///
/// When saving, members are written; when loading, they are overwritten. Names are unique inside a
/// section. The implementation (HDF5) is output/checkpoint.cpp; memory_archive.h keeps it in memory.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/vec.h"

namespace sluice {

enum class Scalar { f32, f64, i32, i64, u8, u32, u64 };

/// How one element is stored: `count` numbers of one scalar type.
template <class T>
struct StateTraits;
#define SLUICE_STATE_SCALAR(T, tag)               \
  template <>                                     \
  struct StateTraits<T> {                         \
    static constexpr Scalar scalar = Scalar::tag; \
    static constexpr std::size_t count = 1;       \
  };
SLUICE_STATE_SCALAR(float, f32)
SLUICE_STATE_SCALAR(double, f64)
SLUICE_STATE_SCALAR(std::int32_t, i32)
SLUICE_STATE_SCALAR(std::int64_t, i64)
SLUICE_STATE_SCALAR(std::uint8_t, u8)
SLUICE_STATE_SCALAR(std::uint32_t, u32)
SLUICE_STATE_SCALAR(std::uint64_t, u64)
#undef SLUICE_STATE_SCALAR
template <class S, int R, int C, int O>
struct StateTraits<Eigen::Matrix<S, R, C, O>> {
  static constexpr Scalar scalar = StateTraits<S>::scalar;
  static constexpr std::size_t count = R * C;
};
template <>
struct StateTraits<Quat> {
  static constexpr Scalar scalar = Scalar::f64;
  static constexpr std::size_t count = 4;
};
template <class T, std::size_t N>
struct StateTraits<std::array<T, N>> {
  static constexpr Scalar scalar = StateTraits<T>::scalar;
  static constexpr std::size_t count = N * StateTraits<T>::count;
};

std::size_t size_of(Scalar scalar);  ///< bytes

class StateArchive {
 public:
  virtual ~StateArchive() = default;
  virtual bool loading() const = 0;
  virtual void enter(std::string_view section) = 0;
  virtual void leave() = 0;

  template <class T>
  void value(std::string_view name, T& v) {
    static_assert(sizeof(T) == sizeof_one<T>());
    if (!loading()) {
      write(name, StateTraits<T>::scalar, StateTraits<T>::count, 1, &v);
    } else {
      expect_rows(name, StateTraits<T>::scalar, StateTraits<T>::count, 1);
      read(name, &v);
    }
  }
  void value(std::string_view name, bool& v) {
    std::uint8_t byte = v ? 1 : 0;
    value(name, byte);
    v = byte != 0;
  }
  template <class T, class A>
  void values(std::string_view name, std::vector<T, A>& v) {
    static_assert(sizeof(T) == sizeof_one<T>());
    if (!loading()) {
      write(name, StateTraits<T>::scalar, StateTraits<T>::count, v.size(), v.data());
    } else {
      v.resize(rows(name, StateTraits<T>::scalar, StateTraits<T>::count));
      read(name, v.data());
    }
  }
  void text(std::string_view name, std::string& v) {
    std::vector<std::uint8_t> bytes(v.begin(), v.end());
    values(name, bytes);
    v.assign(bytes.begin(), bytes.end());
  }

 protected:
  /// `rows` rows of `columns` numbers.
  virtual void write(std::string_view name, Scalar scalar, std::size_t columns, std::size_t rows,
                     const void* data) = 0;
  /// Rows stored under this name; throws EnvironmentError if absent or of another type.
  virtual std::size_t rows(std::string_view name, Scalar scalar, std::size_t columns) = 0;
  virtual void read(std::string_view name, void* data) = 0;

 private:
  template <class T>
  static constexpr std::size_t sizeof_one() {
    return StateTraits<T>::count * sizeof_scalar(StateTraits<T>::scalar);
  }
  static constexpr std::size_t sizeof_scalar(Scalar s) {
    return s == Scalar::u8 ? 1 : (s == Scalar::f32 || s == Scalar::i32 || s == Scalar::u32) ? 4 : 8;
  }
  void expect_rows(std::string_view name, Scalar scalar, std::size_t columns, std::size_t wanted);
};

}  // namespace sluice
