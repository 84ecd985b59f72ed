#include "base/state_archive.h"

#include <fmt/format.h>

#include "base/errors.h"

namespace sluice {

std::size_t size_of(Scalar s) {
  switch (s) {
    case Scalar::u8:
      return 1;
    case Scalar::f32:
    case Scalar::i32:
    case Scalar::u32:
      return 4;
    case Scalar::f64:
    case Scalar::i64:
    case Scalar::u64:
      return 8;
  }
  return 0;
}

void StateArchive::expect_rows(std::string_view name, Scalar scalar, std::size_t columns,
                               std::size_t wanted) {
  const std::size_t found = rows(name, scalar, columns);
  if (found != wanted)
    throw EnvironmentError(fmt::format("saved state: '{}' has {} rows, {} expected", name, found, wanted));
}

}  // namespace sluice
