#include "inflow/belt_slurry.h"

#include <cmath>

namespace sluice {

namespace {

/// Random displacement of a point, of the spacing.
constexpr double jitter = 0.1;
/// Keeps the stream apart from those of whole emitters.
constexpr std::uint64_t slurry_stream = 1ULL << 40;

}  // namespace

BeltSlurry::BeltSlurry(const BeltFrame& belt, const FeedClock& clock, double fines_share,
                       const InflowTarget& target)
    : belt_(belt),
      clock_(clock),
      fines_share_(fines_share),
      fluid_(target.water),
      random_(target.seed, slurry_stream + static_cast<std::uint64_t>(target.index)) {
  // Density of the mixture from the shares of mass.
  const FluidModel& model = fluid_->model();
  const double volume = fines_share / model.fines_density + (1 - fines_share) / model.density;
  const double density = slurry_density(model, fines_share / model.fines_density / volume);
  spacing_ = std::cbrt(fluid_->point_volume());
  point_mass_ = stored_mass(density * fluid_->point_volume());

  // A cross-section of rows x layers, so that points lie about one spacing apart along the belt.
  const double thickness = clock.rate / density / (belt.speed * belt.width);
  layers_ = static_cast<std::uint64_t>(std::max(1L, std::lround(thickness / spacing_)));
  const double per_section = belt.width * thickness / (spacing_ * spacing_);
  rows_ = static_cast<std::uint64_t>(std::max(1L, std::lround(per_section / static_cast<double>(layers_))));
  layer_ = std::max(thickness / static_cast<double>(layers_), spacing_);
}

void BeltSlurry::advance(double t_end) {
  requested_ = clock_.requested(t_end);
  const std::uint64_t per_section = rows_ * layers_;
  while (requested_ >= static_cast<double>(points_ + 1) * point_mass_) {
    const std::uint64_t slot = points_ % per_section;
    const double age = t_end - clock_.time_of(static_cast<double>(points_ - slot + 1) * point_mass_);
    const double step = jitter * spacing_;
    const double b =
        ((static_cast<double>(slot % rows_) + 0.5) / static_cast<double>(rows_) - 0.5) * belt_.width;
    const double c = (static_cast<double>(slot / rows_) + 0.5) * layer_;
    // Fines make up what earlier roundings left, so that their sum keeps to the share.
    const double fines =
        stored_mass(fines_share_ * static_cast<double>(points_ + 1) * point_mass_ - fines_entered_);
    fluid_->add({.x = belt_.at(belt_.length - belt_.speed * age + random_.uniform(-step, step),
                               b + random_.uniform(-step, step), c + random_.uniform(-step, step)),
                 .v = belt_.speed * belt_.along,
                 .mass = point_mass_,
                 .fines_mass = fines});
    fines_entered_ += fines;
    ++points_;
  }
}

InflowBudget BeltSlurry::slurry() const {
  const double entered = static_cast<double>(points_) * point_mass_;
  return {requested_, entered, requested_ - entered, (entered * belt_.speed) * belt_.along};
}

InflowBudget BeltSlurry::fines() const {
  const double requested = fines_share_ * requested_;
  return {requested, fines_entered_, requested - fines_entered_,
          (fines_entered_ * belt_.speed) * belt_.along};
}

void BeltSlurry::exchange(StateArchive& archive) {
  archive.value("points", points_);
  archive.value("requested", requested_);
  archive.value("fines_entered", fines_entered_);
  archive.value("random", random_.state);
}

}  // namespace sluice
