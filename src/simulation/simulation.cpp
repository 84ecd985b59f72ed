#include "simulation/simulation.h"

#include <chrono>

namespace sluice {

namespace {

template <class Run>
double seconds_of(const Run& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Simulation::Simulation(Parts parts, const std::optional<TimeStep>& step)
    : parts_(std::make_unique<Parts>(std::move(parts))),
      time_step_(step ? *step : choose_time_step(*parts_)),
      stages_(build_stages(*parts_, time_step_)),
      watch_(*parts_, time_step_) {}

void Simulation::step() {
  const StepSpan now{time(), time_step_.dt};
  for (Stage& stage : stages_) {
    stage.seconds += seconds_of([&] { stage.run(now); });
    ++stage.calls;
  }
  ++steps_;
  if (parts_->rocks) {
    rocks_max_ = std::max(rocks_max_, parts_->rocks->rocks().count());
    rock_steps_ += static_cast<double>(parts_->rocks->rocks().count()) * time_step_.rock_substeps;
  }
  if (parts_->water) {
    points_max_ = std::max(points_max_, parts_->water->count());
    point_steps_ += static_cast<double>(parts_->water->count()) * time_step_.fluid_substeps;
  }
  watch_.look(time(), steps_);
}

std::uint64_t Simulation::state_hash() const {
  std::uint64_t hash = 0;
  if (parts_->rocks) hash += parts_->rocks->state_hash();
  if (parts_->water) hash += parts_->water->state_hash();
  return hash;
}

SceneView Simulation::view() const {
  SceneView view;
  view.t = time();
  view.dt = time_step_.dt;
  view.rocks = parts_->rocks.get();
  view.water = parts_->water.get();
  view.walls = parts_->walls.get();
  return view;
}

void Simulation::exchange(StateArchive& a) {
  a.enter("simulation");
  a.value("steps", steps_);
  std::uint64_t rocks_max = rocks_max_, points_max = points_max_;
  a.value("rocks_max", rocks_max);
  a.value("points_max", points_max);
  rocks_max_ = rocks_max;
  points_max_ = points_max;
  a.value("rock_steps", rock_steps_);
  a.value("point_steps", point_steps_);
  for (Stage& stage : stages_) {
    a.enter("stage." + std::to_string(&stage - stages_.data()));
    a.value("seconds", stage.seconds);
    a.value("calls", stage.calls);
    a.leave();
  }
  a.leave();
  const auto section = [&](const std::string& name, auto& part) {
    a.enter(name);
    part.exchange(a);
    a.leave();
  };
  if (parts_->rocks) section("rocks", *parts_->rocks);
  if (parts_->water) section("water", *parts_->water);
  if (parts_->coupling) section("coupling", *parts_->coupling);
  if (parts_->exits) section("exits", *parts_->exits);
  section("watch", watch_);
  for (std::size_t i = 0; i < parts_->inflows.size(); ++i)
    section("inflow." + std::to_string(i), *parts_->inflows[i]);
  for (std::size_t i = 0; i < parts_->probes.size(); ++i)
    section("probe." + std::to_string(i), *parts_->probes[i]);
}

}  // namespace sluice
