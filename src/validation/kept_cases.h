#pragma once
/// Cases of an earlier record, so that a part of it can be renewed.

#include <filesystem>
#include <vector>

#include "output/validation_record.h"

namespace sluice {

/// Reads the cases of a validation.json that are still among `folders`, in its order; none where there is no
/// such file. A case without `made_by` was made as the record says.
/// @throws InputError  unless it is one
std::vector<ValidationCase> kept_cases(const std::filesystem::path& file,
                                       const std::vector<std::filesystem::path>& folders);

}  // namespace sluice
