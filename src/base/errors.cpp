#include "base/errors.h"

#include <fmt/format.h>

namespace sluice {

namespace {
std::string join(const std::vector<InputProblem>& problems) {
  std::string all;
  for (const InputProblem& p : problems) {
    if (!all.empty()) all += '\n';
    all += p.text();
  }
  return all;
}
}  // namespace

std::string Location::text() const {
  return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file;
}

std::string InputProblem::text() const {
  std::string s = where.text();
  if (!s.empty()) s += ": ";
  if (!key.empty()) s += fmt::format("'{}' ", key);
  s += problem;
  if (!reason.empty()) s += fmt::format(" ({})", reason);
  if (!suggestion.empty()) s += " " + suggestion;
  return s;
}

InputError::InputError(std::vector<InputProblem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

InputError::InputError(InputProblem problem) : InputError(std::vector<InputProblem>{std::move(problem)}) {}

NumericalError::NumericalError(std::string stage, double time, const std::string& problem,
                               const std::string& remedy)
    : std::runtime_error(fmt::format("{} t={:.6g} s: {}; {}", stage, time, problem, remedy)),
      stage_(std::move(stage)),
      time_(time) {}

}  // namespace sluice
