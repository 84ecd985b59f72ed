#pragma once
/// The kinds of validation case, one line each.

#include <memory>
#include <string>
#include <vector>

#include "validation/measure.h"

namespace sluice {

struct MeasureKind {
  const char* word;      ///< as `measure:` names it
  const char* particle;  ///< whose steps are counted: "rock", "point" or "sample"
  std::unique_ptr<Measure> (*make)();
};

const std::vector<MeasureKind>& measure_kinds();
/// Null where there is none of this name.
const MeasureKind* find_measure(const std::string& word);

}  // namespace sluice
