#pragma once
/// What a validation case measures: a scene built with the library, run at one setting, and compared
/// with a reference that is not ours.
///
/// A new kind of case is one header that derives from Measure, one line in measures.cpp, and a folder
/// under `validation/`.

#include <string>
#include <vector>

#include "base/schema.h"
#include "output/csv.h"

namespace sluice {

/// One number beside its reference, in any unit; `scale` is what the difference is measured against.
struct Compared {
  std::string what;
  double measured = 0, reference = 0;
  double scale = 1;
};

struct Measured {
  std::vector<Compared> values;
  double particle_steps = 0;  ///< rocks, points or samples times steps
  std::string note;           ///< what had to be left out; empty: nothing
};

class Measure {
 public:
  virtual ~Measure() = default;
  /// Keys under `scene:`; the one that the ladder varies has a default.
  virtual void keys(Schema& s) = 0;
  /// @throws NumericalError where the scene does not run to its end
  virtual Measured run(const CsvTable& reference) const = 0;
};

enum class ErrorNorm {
  largest,      ///< largest |measured - reference| / scale
  rms,          ///< root mean square of the same
  relative_l2,  ///< sqrt(sum (measured - reference)^2 / sum reference^2)
};
const char* norm_words(ErrorNorm norm);
/// NaN for no values.
double error_of(const std::vector<Compared>& values, ErrorNorm norm);

/// Column of a case's reference table. @throws InputError if it is not there
std::vector<double> reference_numbers(const CsvTable& reference, const char* column);
std::vector<std::string> reference_texts(const CsvTable& reference, const char* column);
/// The same, of words that the measure knows. @throws InputError for another
std::vector<std::string> reference_words(const CsvTable& reference, const char* column,
                                         const std::vector<std::string>& known);

/// Straight line between neighbours; ascending x. @pre x is not empty
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace sluice
