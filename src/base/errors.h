#pragma once
/// The three kinds of error, and how each reads.
///
///   InputError        feedbox.yaml:12:9: 'bore' has unit 'kg' (a length is needed) use m, mm or in     exit
///   2 NumericalError    rocks.substeps t=1.3204 s: rock 5121 overlap is 0.31 radius (limit 0.05); raise
///                     'stiffness' or lower 'time_step_fraction' exit 3
///   EnvironmentError  disk, permission, a process file that is not there exit 4
///
/// `expect` is for the programmer: a broken precondition, checked in debug builds.

#include <cassert>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace sluice {

/// Where in a file something stands; line and column count from 1, 0 = unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  std::string text() const;  ///< "file:line:col", or "file" where the line is unknown
};

/// One thing wrong with the input: 'key' problem (reason) suggestion.
struct InputProblem {
  Location where;
  std::string key;
  std::string problem;
  std::string reason;
  std::string suggestion;
  std::string text() const;
};

/// Bad input: every problem found, in the order in which it is to be read.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<InputProblem> problems);
  explicit InputError(InputProblem problem);
  const std::vector<InputProblem>& problems() const { return problems_; }

 private:
  std::vector<InputProblem> problems_;
};

/// The simulation cannot go on. `what()` is the whole sentence.
class NumericalError : public std::runtime_error {
 public:
  /// @param stage  stage name, as in the step ("rocks.substeps")
  /// @param time   simulated time [s]
  /// @param problem  what, which particle, which quantity, which limit
  /// @param remedy  the knob to turn
  NumericalError(std::string stage, double time, const std::string& problem, const std::string& remedy);
  const std::string& stage() const { return stage_; }
  double time() const { return time_; }

 private:
  std::string stage_;
  double time_;
};

class EnvironmentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sluice
