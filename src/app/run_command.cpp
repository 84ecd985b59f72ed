#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>

#include "app/commands.h"
#include "app/estimate.h"
#include "app/process_source.h"
#include "app/progress.h"
#include "app/recorder.h"
#include "app/summary.h"
#include "base/parallel.h"
#include "output/view.h"
#include "processes/build_parts.h"
#include "reports/run_page.h"

namespace sluice {

namespace {

volatile std::sig_atomic_t interrupted = 0;
void on_signal(int) {
  interrupted = 1;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Rock that left by the stop's exit over its averaging time, over what the feeds ask for.
class EarlyStop {
 public:
  EarlyStop(const ProcessConfig& config, double rock_rate) : config_(config.stop), rock_rate_(rock_rate) {}
  bool reached(const Simulation& simulation) const {
    if (!config_ || simulation.time() < config_->over) return false;
    for (const ExitTally& tally : simulation.parts().exits->tallies()) {
      if (tally.config().name != config_->exit) continue;
      const auto slots = static_cast<std::size_t>(std::lround(config_->over / tally.interval()));
      // Whole slots only: the one in progress would read low.
      const auto whole = static_cast<std::size_t>(simulation.time() / tally.interval() + 1e-9);
      if (slots == 0 || whole < slots) return false;
      double kg = 0;
      for (std::size_t slot = whole - slots; slot < std::min(whole, tally.slots()); ++slot)
        for (std::size_t bin = 0; bin < tally.bin_count(); ++bin) kg += tally.at(slot, bin).rock_kg;
      return kg / (static_cast<double>(slots) * tally.interval()) >= config_->rock_rate * rock_rate_;
    }
    return false;
  }

 private:
  std::optional<StopConfig> config_;
  double rock_rate_;
};

class Run {
 public:
  explicit Run(const RunOptions& options);
  int go();

 private:
  void exchange(StateArchive& archive);
  void save();
  void keep_in_memory();
  ProgressState progress_of(double end) const;
  int finish(Outcome outcome, const std::optional<RunManifest::Failure>& failure);

  RunOptions options_;
  ProcessSource source_;
  ProcessConfig config_;
  RunFolder folder_;
  BuiltProcess built_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Recorder> recorder_;
  std::vector<std::string> warnings_;
  MemoryArchive last_good_;
  double end_ = 0;          ///< [s]
  double wall_before_ = 0;  ///< seconds spent before this resume
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Run::Run(const RunOptions& options) : options_(options) {
  if (options.threads > 0) set_thread_count(options.threads);
  source_ = read_process_source(options.process, options.overrides);
  config_ = source_.config;
  if (options_.whole) config_.stop.reset();
  built_ = build_parts(config_);
  warnings_ = built_.warnings;
  end_ = end_of_run(config_, options_.until);
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("out") / options.process.stem() : options.out;
  if (options.resume && !std::filesystem::is_directory(out))
    throw EnvironmentError(
        fmt::format("{}: there is no run to resume; start it without --resume", out.string()));
  folder_ = open_run_folder(out, options.resume ? FolderUse::resume : FolderUse::fresh);
  simulation_ = std::make_unique<Simulation>(std::move(built_.parts));
  std::optional<double> resume_time;
  if (options.resume) {
    // The state is restored before the recorder opens its files at the right place.
    const auto found = find_checkpoint(folder_);
    if (!found)
      throw EnvironmentError(fmt::format("{}: there is no checkpoint to resume from; start without --resume",
                                         folder_.root.string()));
    // Before anything in the folder is touched.
    refuse_other_process(folder_, found->stamp, source_.sha256);
    resume_time = found->stamp.time;
    if (*resume_time > end_ + simulation_->time_step().dt)
      throw InputError(InputProblem{{options.until.empty() ? options.process.string() : "--until", 0, 0},
                                    options.until.empty() ? "duration" : "until",
                                    fmt::format("is {:.6g} s", end_),
                                    fmt::format("the run is at {:.6g} s already", *resume_time),
                                    "give a later time"});
    recorder_ = std::make_unique<Recorder>(config_, folder_, *simulation_, resume_time);
    const RestoredCheckpoint restored =
        load_checkpoint(folder_, source_.sha256, [&](StateArchive& a) { exchange(a); });
    warnings_.insert(warnings_.end(), restored.notes.begin(), restored.notes.end());
  } else {
    recorder_ = std::make_unique<Recorder>(config_, folder_, *simulation_, resume_time);
  }
}

void Run::exchange(StateArchive& a) {
  simulation_->exchange(a);
  a.enter("recorder");
  recorder_->exchange(a);
  a.leave();
  double wall = wall_before_ + seconds_since(start_);
  a.value("wall_seconds", wall);
  if (a.loading()) {
    wall_before_ = wall;
    start_ = std::chrono::steady_clock::now();
  }
}

void Run::save() {
  save_checkpoint(folder_, {source_.sha256, program_name(), simulation_->time()},
                  [&](StateArchive& a) { exchange(a); });
}

void Run::keep_in_memory() {
  last_good_.clear();
  exchange(last_good_);
}

ProgressState Run::progress_of(double end) const {
  const Parts& parts = simulation_->parts();
  ProgressState state;
  state.simulated = simulation_->time();
  state.until = end;
  state.wall = seconds_since(start_);
  if (parts.rocks) {
    state.rocks = parts.rocks->rocks().count();
    state.dt_rock = simulation_->time_step().dt_rock();
  }
  if (parts.water) {
    state.water_points = parts.water->count();
    state.dt_water = simulation_->time_step().dt_fluid();
  }
  return state;
}

int Run::finish(Outcome outcome, const std::optional<RunManifest::Failure>& failure) {
  save();
  recorder_->write_frame(*simulation_);
  const double wall = wall_before_ + seconds_since(start_);
  write_summary(folder_, {source_, *simulation_, end_, built_.rock_rate, wall, warnings_}, outcome, failure);
  const SceneView view = simulation_->view();
  write_view(folder_.view(),
             make_view(take_snapshot(view.t, config_.gravity, view.rocks, view.water, *view.walls),
                       view_marks(config_)));
  write_run_page(folder_.root);
  fmt::print("page: {}\n", folder_.report().string());
  return outcome == Outcome::completed ? 0 : outcome == Outcome::interrupted ? 130 : 3;
}

int Run::go() {
  const double end = end_;
  const EarlyStop early(config_, built_.rock_rate);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  fmt::print("{}\n", config_.title);
  print_parts(simulation_->parts());
  for (const std::string& warning : warnings_) fmt::print("warning: {}\n", warning);
  std::fflush(stdout);
  Progress progress(stderr);
  keep_in_memory();
  const double dt = simulation_->time_step().dt;
  bool stopped_early = false;
  try {
    // Half a step of slack: the end is the step nearest to it, whatever the rounding.
    while (simulation_->time() + 0.5 * dt < end && !interrupted) {
      simulation_->step();
      recorder_->after_step(*simulation_);
      if (recorder_->checkpoint_due(*simulation_)) {
        save();
        keep_in_memory();
        write_manifest(folder_.manifest(), make_manifest({source_, *simulation_, end_, built_.rock_rate,
                                                          wall_before_ + seconds_since(start_), warnings_},
                                                         Outcome::running, std::nullopt));
        if (early.reached(*simulation_)) {
          stopped_early = true;
          break;
        }
      }
      progress.update(progress_of(end));
    }
  } catch (const NumericalError& e) {
    progress.finish(progress_of(end));
    fmt::print(stderr, "{}\n", e.what());
    last_good_.rewind_to_load();
    exchange(last_good_);
    fmt::print(stderr, "last good state, t = {:.6g} s, saved in {}\n", simulation_->time(),
               folder_.checkpoint().string());
    return finish(Outcome::failed, RunManifest::Failure{e.stage(), e.time(), e.what()});
  }
  progress.finish(progress_of(end));
  if (interrupted) {
    fmt::print(stderr, "interrupted at t = {:.6g} s; `--resume` goes on from here\n", simulation_->time());
    return finish(Outcome::interrupted, std::nullopt);
  }
  if (stopped_early)
    warnings_.push_back(
        fmt::format("ended at {:.3g} s: rock leaves by '{}' at {:.0f} % of the feed rate or more",
                    simulation_->time(), config_.stop->exit, 100 * config_.stop->rock_rate));
  return finish(Outcome::completed, std::nullopt);
}

}  // namespace

int run_process(const RunOptions& options) {
  return Run(options).go();
}

}  // namespace sluice
