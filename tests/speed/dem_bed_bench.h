#pragma once
/// A bed as a benchmark: made once, checked against the plain reference in its first steps, then timed.

#include <memory>
#include <string>

#include "speed/dem_reference.h"
#include "speed/dem_scenes.h"
#include "speed/speed.h"

namespace sluice::speed {

/// What the system may depart from the reference by.
struct BedTolerance {
  double step = 1e-9;        ///< of a step's mean kick by contacts
  double wrong_share = 0;    ///< of rocks that may depart by more: flat faces have more than one normal
  double contact_share = 0;  ///< by which the number of contacts may differ
};

class BedBench {
 public:
  BedBench(BedRecipe recipe, BedTolerance tolerance) : recipe_(std::move(recipe)), tolerance_(tolerance) {}

  void operator()(benchmark::State& state);

 private:
  void set_up();
  void follow();
  void step();
  void steps_of_a_run();
  std::string final_check() const;

  BedRecipe recipe_;
  BedTolerance tolerance_;
  Walls none_;
  std::unique_ptr<DemSystem> dem_;
  Vec3 momentum_ = Vec3::Zero();
  double scale_ = 0;  ///< of the momentum [N s]
  double t_ = 0, worst_ = 0;
  std::string wrong_;  ///< what the check found
};

}  // namespace sluice::speed
