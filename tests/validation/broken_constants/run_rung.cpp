// One rung of a case against its gate: 0 where it passes, 5 where it does not.
#include <fmt/format.h>

#include <exception>

#include "validation/ladder.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: {} CASE_FOLDER SETTING\n", argv[0]);
    return 2;
  }
  try {
    sluice::LadderOptions options;
    options.only = argv[2];
    const sluice::ValidationCase ran = sluice::run_ladder(sluice::read_case(argv[1]), options);
    const sluice::ValidationRung& rung = ran.rungs.front();
    fmt::print("{} at {}: error {:.3g}, gate {:.3g} {}\n", ran.name, rung.setting, rung.error,
               rung.gate.value_or(0), rung.message);
    return rung.gate && rung.passed() ? 0 : 5;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
