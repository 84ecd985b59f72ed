#include "analysis/claim.h"

#include <cmath>

#include "base/statistics.h"

namespace sluice {

const char* word_of(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::holds:
      return "holds";
    case ClaimVerdict::does_not_hold:
      return "does not hold";
    case ClaimVerdict::not_shown:
      return "is not shown";
    case ClaimVerdict::too_few_values:
      return "has too few seeds";
  }
  return "";
}

ClaimResult judge_claim(ClaimKind kind, const std::vector<double>& first, const std::vector<double>& other,
                        double margin) {
  std::vector<double> differences, references;
  for (std::size_t i = 0; i < std::min(first.size(), other.size()); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(other[i])) continue;
    differences.push_back(first[i] - other[i]);
    references.push_back(other[i]);
  }
  ClaimResult r;
  r.difference = replicate_mean(differences);
  r.reference = references.empty() ? std::nan("") : mean(references);
  if (differences.size() < fewest_seeds) return r;
  const double low = r.difference.value - r.difference.half_width,
               high = r.difference.value + r.difference.half_width;
  if (kind == ClaimKind::lower) {
    r.verdict = high < 0   ? ClaimVerdict::holds
                : low >= 0 ? ClaimVerdict::does_not_hold
                           : ClaimVerdict::not_shown;
  } else {
    const double most = margin * std::abs(r.reference);
    r.verdict = low > -most && high < most     ? ClaimVerdict::holds
                : low >= most || high <= -most ? ClaimVerdict::does_not_hold
                                               : ClaimVerdict::not_shown;
  }
  return r;
}

}  // namespace sluice
