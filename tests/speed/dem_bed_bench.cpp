#include "speed/dem_bed_bench.h"

#include <fmt/format.h>

namespace sluice::speed {

namespace {
constexpr int followed_steps = 5;
constexpr int steps_in_a_row = 10;  // a run takes as many between two looks at its exits
constexpr int warm_steps = 100;     // contacts find their springs
}  // namespace

void BedBench::step() {
  dem_->step(t_, dem_->step_size());
  t_ += dem_->step_size();
}

void BedBench::steps_of_a_run() {
  dem_->steps(t_, dem_->step_size(), steps_in_a_row);
  t_ += steps_in_a_row * dem_->step_size();
}

void BedBench::follow() {
  PlainRocks reference(*dem_, restitution, friction);
  for (int k = 0; k < followed_steps && wrong_.empty(); ++k) {
    step();
    const Departure d = reference.follow(*dem_, dem_->step_size(), tolerance_.step);
    const double contacts = static_cast<double>(d.contacts);
    const double missing = std::fabs(static_cast<double>(dem_->contact_count()) - contacts);
    if (d.wrong_share <= tolerance_.wrong_share) worst_ = std::max({worst_, d.velocity, d.turning});
    // A step of 1e-5 s is seen as a difference of positions of 1 m.
    if (d.position > 1e-9 && tolerance_.wrong_share == 0)
      wrong_ = fmt::format("positions depart by {:.2g} of a move", d.position);
    if (d.wrong_share > tolerance_.wrong_share)
      wrong_ = fmt::format("{:.2g} of the rocks depart from the reference, by up to {:.2g}", d.wrong_share,
                           std::max(d.velocity, d.turning));
    if (missing > tolerance_.contact_share * contacts)
      wrong_ = fmt::format("{} contacts, reference {}", dem_->contact_count(), d.contacts);
    if (static_cast<double>(d.unproved) > tolerance_.contact_share * contacts)
      wrong_ = fmt::format("{} contacts without a proved normal", d.unproved);
  }
}

void BedBench::set_up() {
  const Bed bed = make_bed(recipe_);
  DemConfig config = config_of_beds();
  config.overlap_limit = recipe_.overlap_limit;
  dem_ = std::make_unique<DemSystem>(config, scene_of(bed), none_);
  add_rocks(bed, *dem_);
  follow();
  for (int k = followed_steps; k < warm_steps; ++k) step();
  momentum_ = dem_->momentum();
  for (const double m : dem_->rocks().mass) scale_ += m * shear_speed;
}

std::string BedBench::final_check() const {
  const Rocks& rocks = dem_->rocks();
  if (!((dem_->momentum() - momentum_).norm() < 1e-11 * scale_)) return "momentum is not kept";
  if (recipe_.shape.is_sphere()) {
    const std::size_t touching = overlapping_spheres(rocks.x, rocks.radius, dem_->scene().domain).size();
    if (touching != dem_->contact_count())
      return fmt::format("{} contacts, by search {}", dem_->contact_count(), touching);
  }
  return "";
}

void BedBench::operator()(benchmark::State& state) {
  if (!dem_) set_up();
  const double seconds = time_steps(state, [&] { steps_of_a_run(); });
  if (wrong_.empty()) wrong_ = final_check();
  if (!wrong_.empty()) return state.SkipWithError(wrong_.c_str());
  const double rocks = static_cast<double>(dem_->rocks().count());
  const double contacts = static_cast<double>(dem_->contact_count());
  state.counters["rock_steps_per_s"] = rate(state, steps_in_a_row * rocks, seconds);
  state.counters["contacts_per_s"] = rate(state, steps_in_a_row * contacts, seconds);
  state.counters["coordination"] = 2 * contacts / rocks;
  state.counters["worst_departure"] = worst_;
}

}  // namespace sluice::speed
