// A run in a process of its own.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "app/run_series.h"
#include "base/errors.h"

namespace sluice {

namespace {

volatile std::sig_atomic_t child = 0;
void pass_on(int signal) {
  if (child > 0) ::kill(static_cast<pid_t>(child), signal);
}

std::vector<std::string> words_of(const RunOptions& o) {
  std::vector<std::string> words = {"sluice", "run", o.process.string(), "--out", o.out.string()};
  if (o.threads > 0) words.insert(words.end(), {"--threads", std::to_string(o.threads)});
  if (!o.until.empty()) words.insert(words.end(), {"--until", o.until});
  if (o.resume) words.emplace_back("--resume");
  if (o.whole) words.emplace_back("--no-stop");
  for (const std::string& set : o.overrides) words.insert(words.end(), {"--set", set});
  return words;
}

}  // namespace

int run_apart(const RunOptions& options) {
  std::vector<std::string> words = words_of(options);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  // The handlers stand before the child does: a signal in between reaches it through its group, or not at
  // all.
  std::signal(SIGINT, pass_on);
  std::signal(SIGTERM, pass_on);
  const pid_t id = ::fork();
  if (id < 0) throw EnvironmentError(fmt::format("a run cannot be started ({})", std::strerror(errno)));
  if (id == 0) {
    ::execv("/proc/self/exe", arguments.data());
    ::_exit(127);
  }
  child = id;
  int status = 0;
  while (::waitpid(id, &status, 0) < 0)
    if (errno != EINTR) throw EnvironmentError(fmt::format("a run was lost ({})", std::strerror(errno)));
  child = 0;
  if (WIFSIGNALED(status))
    throw EnvironmentError(fmt::format("{}: the run was killed by signal {}{}", options.out.string(),
                                       WTERMSIG(status),
                                       WTERMSIG(status) == SIGKILL ? " (out of memory?)" : ""));
  return WEXITSTATUS(status);
}

}  // namespace sluice
