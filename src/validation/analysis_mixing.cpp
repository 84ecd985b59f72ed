#include "validation/analysis_mixing.h"

#include <fmt/format.h>

#include "analysis/mixing.h"
#include "base/random.h"

namespace sluice {

void AnalysisMixing::keys(Schema& s) {
  s.integer("cells", cells, {.at_least = 2, .doc = "cells of the mixture"});
}

Measured AnalysisMixing::run(const CsvTable& reference) const {
  const std::vector<double> share = reference_numbers(reference, "share");
  const std::vector<double> grains = reference_numbers(reference, "grains");
  const std::vector<double> lacey = reference_numbers(reference, "lacey");
  Measured out;
  for (std::size_t k = 0; k < share.size(); ++k) {
    Random random(17, k);
    std::vector<MixCell> all(static_cast<std::size_t>(cells));
    for (MixCell& cell : all)
      for (int n = 0; n < static_cast<int>(grains[k]); ++n)
        (random.uniform() < share[k] ? cell.a : cell.b) += 1;
    out.values.push_back({fmt::format("Lacey's index, share {}, {} grains a cell", share[k], grains[k]),
                          mix_indices(all, 1, 1).lacey, lacey[k], 1});
    out.particle_steps += static_cast<double>(cells) * grains[k];
  }
  return out;
}

}  // namespace sluice
