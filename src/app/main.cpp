/// sluice: run | check | explain | report | converge | study | validate. What each does is in its own file;
/// here are the command line and the exit codes: 0 done, 1 a bug, 2 bad input, 3 numerical failure, 4
/// environment, 5 a validation case missed its gate, 130 interrupted.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "app/brief_waits.h"
#include "app/commands.h"
#include "base/errors.h"
#include "base/parallel.h"
#include "sluice_version.h"

namespace {

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const sluice::InputError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const sluice::NumericalError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  } catch (const sluice::EnvironmentError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 4;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "out of memory: `sluice check` estimates what a process needs\n");
    return 4;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "internal error, please report it: %s\n", e.what());
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  sluice::wait_briefly(argv);
  CLI::App app("Sluice: rock and water through feed boxes, chutes and screens");
  app.set_version_flag(
      "--version", std::string("sluice ") + sluice::program_version + " (" + sluice::program_commit + ")");
  app.require_subcommand(1);

  sluice::RunOptions run;
  CLI::App* run_command = app.add_subcommand("run", "simulate a process");
  run_command->add_option("process", run.process, "process file (YAML)")->required();
  run_command->add_option("--out", run.out, "run folder [out/NAME]");
  run_command->add_option("--threads", run.threads, "threads [all]")->check(CLI::Range(1, 1024));
  run_command->add_option("--until", run.until, "end at this simulated time, such as '2 s'");
  run_command->add_flag("--resume", run.resume, "go on from the run folder's checkpoint");
  run_command->add_flag("--no-stop", run.whole, "run to the end, whatever 'stop' says");
  run_command->add_option("--set", run.overrides, "key=value, over the process file; may be repeated");

  sluice::CheckOptions check;
  CLI::App* check_command = app.add_subcommand(
      "check", "read a process, audit its CAD, list parts and estimates; simulate nothing");
  check_command->add_option("process", check.process, "process file (YAML)")->required();
  check_command->add_option("--set", check.overrides, "key=value, over the process file; may be repeated");

  sluice::ExplainOptions explain;
  CLI::App* explain_command = app.add_subcommand("explain", "every key: meaning, unit, range, default");
  explain_command->add_option("key", explain.key, "one key, such as water.spacing");
  explain_command->add_flag("--study", explain.study, "the keys of a study file");
  explain_command->add_flag("--schema", explain.schema, "print the JSON Schema for editors");

  sluice::ReportOptions report;
  CLI::App* report_command = app.add_subcommand("report", "page of one run; comparison of several");
  report_command->add_option("runs", report.runs, "run folders")->required();
  report_command->add_option("--out", report.out, "comparison page [comparison.html]");

  sluice::ConvergeOptions converge;
  CLI::App* converge_command = app.add_subcommand(
      "converge", "run a process over a ladder of one key; what a finer setting changes, and what it costs");
  converge_command->add_option("process", converge.process, "process file (YAML)")->required();
  converge_command->add_option("--vary", converge.vary, "key, such as water.spacing")->required();
  converge_command->add_option("--over", converge.over, "settings, coarse to fine: '40 mm, 20 mm'")
      ->required();
  converge_command->add_option("--out", converge.out, "folder of the runs and the page [out/NAME-KEY]");
  converge_command->add_option("--threads", converge.threads, "threads [all]")->check(CLI::Range(1, 1024));
  converge_command->add_option("--until", converge.until, "end every run at this simulated time");
  converge_command->add_option("--set", converge.overrides,
                               "key=value, over the process file; may be repeated");

  sluice::StudyOptions study;
  CLI::App* study_command = app.add_subcommand("study", "a process x variations: run them, compare them");
  study_command->add_option("study", study.study, "study file (YAML)")->required();
  study_command->add_option("--out", study.out, "folder of the runs and the page [out/NAME]");
  study_command->add_option("--threads", study.threads, "threads [all]")->check(CLI::Range(1, 1024));
  study_command->add_option("--until", study.until, "end every run at this simulated time");
  study_command->add_option("--set", study.overrides, "key=value, over all variations; may be repeated");

  sluice::ValidateOptions validate;
  CLI::App* validate_command =
      app.add_subcommand("validate", "error against run time of the cases in validation/, and their gates");
  validate_command->add_option("cases", validate.names, "names of cases [all]");
  validate_command->add_flag("--quick", validate.quick, "first rungs only");
  validate_command->add_flag("--update", validate.update,
                             "renew these cases in the record of reports/ (or --out), keep the others");
  validate_command->add_flag("--extremes", validate.extremes,
                             "how far hard settings go: the cases in validation/extremes/");
  validate_command->add_flag("--list", validate.list, "one case a line; run nothing");
  validate_command->add_option("--rung", validate.rung, "one rung of one case, by its setting");
  validate_command->add_option("--set", validate.scene_keys,
                               "key=value of the case's scene; may be repeated");
  validate_command->add_option("--out", validate.out,
                               "folder of the page [reports for all cases, else out/validation]");
  validate_command->add_option("--cases", validate.cases, "folder of the cases [validation]");
  validate_command->add_option("--threads", validate.threads, "threads [all]")->check(CLI::Range(1, 1024));

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::RequiredError& e) {
    // CLI11 says only that a command is required, also where one was misspelt.
    if (argc > 1 && app.get_subcommands().empty())
      std::fprintf(
          stderr,
          "'%s' is not a command (there are run, check, explain, report, converge, study and validate)\n",
          argv[1]);
    app.exit(e);
    return 2;
  } catch (const CLI::ParseError& e) {
    app.exit(e);
    return 2;
  }

  return guarded([&] {
    if (run_command->parsed()) return sluice::run_process(run);
    if (check_command->parsed()) return sluice::check_process(check);
    if (explain_command->parsed()) return sluice::explain_keys(explain);
    if (converge_command->parsed()) return sluice::converge_process(converge);
    if (study_command->parsed()) return sluice::run_study(study);
    if (validate_command->parsed())
      return validate.extremes ? sluice::validate_extremes(validate) : sluice::validate_cases(validate);
    return sluice::report_runs(report);
  });
}
