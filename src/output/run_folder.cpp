#include "output/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include "base/errors.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* what, const fs::path& file, int reason) {
  throw EnvironmentError(fmt::format("{}: {} ({})", file.string(), what, std::strerror(reason)));
}

/// A file descriptor that closes itself.
struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

void flush_to_disk(const fs::path& file) {
  const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  if (descriptor.number < 0) fail("cannot be opened", file, errno);
  // EINVAL: a file system that cannot flush (some network and memory ones)
  if (::fsync(descriptor.number) != 0 && errno != EINVAL) fail("cannot be flushed to disk", file, errno);
}

void remove_results(const RunFolder& folder) {
  const std::array<fs::path, 9> results = {
      folder.manifest(), folder.series(),     folder.exits(),
      folder.mixing(),   folder.walls(),      folder.view(),
      folder.report(),   folder.checkpoint(), folder.previous_checkpoint()};
  std::error_code error;
  for (const fs::path& file : results) {
    fs::remove(file, error);
    if (error) fail("the result of an earlier run cannot be removed", file, error.value());
  }
  // frames/ is ours, but only what we write there goes
  if (!fs::exists(folder.frames(), error)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.frames(), error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".vtp" || extension == ".pvd") fs::remove(entry.path(), error);
    if (error) fail("the result of an earlier run cannot be removed", entry.path(), error.value());
  }
}

}  // namespace

RunFolder open_run_folder(const fs::path& root, FolderUse use) {
  RunFolder folder{root};
  std::error_code error;
  fs::create_directories(root, error);
  if (error) fail("the run folder cannot be made", root, error.value());
  if (!fs::is_directory(root, error)) fail("the run folder cannot be made", root, ENOTDIR);
  if (::access(root.c_str(), W_OK | X_OK) != 0) fail("the run folder cannot be written to", root, errno);
  if (use == FolderUse::fresh) remove_results(folder);
  return folder;
}

void write_atomically(const fs::path& file, std::string_view content) {
  const fs::path temporary = file.string() + ".tmp";
  {
    const Descriptor descriptor{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC,
                                       S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH)};
    if (descriptor.number < 0) fail("cannot be written", file, errno);
    for (std::size_t done = 0; done < content.size();) {
      const ssize_t n = ::write(descriptor.number, content.data() + done, content.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) {
        const int reason = errno;
        ::unlink(temporary.c_str());
        fail("cannot be written", file, reason);
      }
      done += static_cast<std::size_t>(n);
    }
  }
  replace_file(temporary, file);
}

void replace_file(const fs::path& temporary, const fs::path& file) {
  flush_to_disk(temporary);
  if (::rename(temporary.c_str(), file.c_str()) != 0) {
    const int reason = errno;
    ::unlink(temporary.c_str());
    fail("cannot be replaced", file, reason);
  }
}

std::string read_whole_file(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) fail("cannot be read", file, EISDIR);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail("cannot be read", file, errno == 0 ? ENOENT : errno);
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) fail("cannot be read", file, errno == 0 ? EIO : errno);
  return std::move(text).str();
}

void refuse_file(const fs::path& file, const FileProblem& problem) {
  InputProblem p;
  p.where.file = file.string();
  p.where.line = problem.line;
  p.problem = problem.problem;
  p.reason = problem.reason;
  p.suggestion = problem.suggestion;
  throw InputError(p);
}

}  // namespace sluice
