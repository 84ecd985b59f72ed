#include "output/checkpoint.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <system_error>

#include "base/errors.h"
#include "output/hdf5_archive.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

/// Raised whenever an older program could misread what is stored.
constexpr const char* format_version = "3";

constexpr const char* version_key = "sluice_checkpoint_version";
constexpr const char* process_key = "process_sha256";
constexpr const char* program_key = "program";
constexpr const char* time_key = "time_s";
constexpr const char* hash_key = "content_hash";

struct OpenCheckpoint {
  std::unique_ptr<Hdf5Archive> archive;
  RestoredCheckpoint found;
};

/// Opens a file and checks that all of it is there and unchanged.
/// @throws EnvironmentError
OpenCheckpoint open_whole(const fs::path& file) {
  OpenCheckpoint open;
  open.archive = std::make_unique<Hdf5Archive>(file, ArchiveUse::load);
  const auto read = [&](const char* key) {
    auto text = open.archive->attribute(key);
    if (!text)
      throw EnvironmentError(fmt::format("{}: is not a checkpoint of sluice, or damaged", file.string()));
    return *text;
  };
  const std::string version = read(version_key);
  if (version != format_version)
    throw EnvironmentError(fmt::format(
        "{}: has checkpoint format {}, this program reads format {}; go on with the program that wrote "
        "it ({}) or start anew",
        file.string(), version, format_version, open.archive->attribute(program_key).value_or("unknown")));
  open.found.stamp.process_sha256 = read(process_key);
  open.found.stamp.program = read(program_key);
  const std::string time = read(time_key);
  std::from_chars(time.data(), time.data() + time.size(), open.found.stamp.time);
  if (read(hash_key) != fmt::format("{:016x}", open.archive->content_hash()))
    throw EnvironmentError(
        fmt::format("{}: is damaged (its contents differ from what was saved)", file.string()));
  return open;
}

/// The newest whole one, with a note for each that was passed over.
std::optional<OpenCheckpoint> open_newest(const RunFolder& folder) {
  std::vector<std::string> problems;
  for (const fs::path& file : {folder.checkpoint(), folder.previous_checkpoint()}) {
    std::error_code error;
    if (!fs::exists(file, error)) continue;
    try {
      OpenCheckpoint open = open_whole(file);
      for (const std::string& problem : problems)
        open.found.notes.push_back(fmt::format("{}; going on from {} at t = {:.6g} s instead", problem,
                                               file.filename().string(), open.found.stamp.time));
      return open;
    } catch (const EnvironmentError& problem) {
      problems.emplace_back(problem.what());
    }
  }
  if (problems.empty()) return std::nullopt;
  std::string all = problems.front();
  for (std::size_t k = 1; k < problems.size(); ++k) all += "; " + problems[k];
  throw EnvironmentError(all + "; start anew without --resume");
}

}  // namespace

void save_checkpoint(const RunFolder& folder, const CheckpointStamp& stamp, const ExchangeState& exchange) {
  const fs::path temporary = folder.checkpoint().string() + ".tmp";
  try {
    Hdf5Archive archive(temporary, ArchiveUse::save);
    exchange(archive);
    archive.set_attribute(version_key, format_version);
    archive.set_attribute(process_key, stamp.process_sha256);
    archive.set_attribute(program_key, stamp.program);
    archive.set_attribute(time_key, fmt::format("{}", stamp.time));
    archive.set_attribute(hash_key, fmt::format("{:016x}", archive.content_hash()));
    archive.close();
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }

  // between the two renames only the previous one is there: load_checkpoint finds it
  std::error_code error;
  if (fs::exists(folder.checkpoint(), error))
    fs::rename(folder.checkpoint(), folder.previous_checkpoint(), error);
  if (error)
    throw EnvironmentError(
        fmt::format("{}: cannot be replaced ({})", folder.previous_checkpoint().string(), error.message()));
  replace_file(temporary, folder.checkpoint());
}

std::optional<RestoredCheckpoint> find_checkpoint(const RunFolder& folder) {
  auto open = open_newest(folder);
  if (!open) return std::nullopt;
  return open->found;
}

void refuse_other_process(const RunFolder& folder, const CheckpointStamp& stamp,
                          const std::string& process_sha256) {
  if (stamp.process_sha256 == process_sha256) return;
  refuse_file(folder.checkpoint(),
              {.problem = "was saved by another process",
               .reason = fmt::format(
                   "the process file, what it extends or a --set has changed: sha256 {:.12} then, {:.12} now",
                   stamp.process_sha256, process_sha256),
               .suggestion = "restore the process file and its --set, or start anew in another folder"});
}

RestoredCheckpoint load_checkpoint(const RunFolder& folder, const std::string& process_sha256,
                                   const ExchangeState& exchange) {
  auto open = open_newest(folder);
  if (!open)
    throw EnvironmentError(
        fmt::format("{}: has no checkpoint to resume from; start without --resume", folder.root.string()));
  refuse_other_process(folder, open->found.stamp, process_sha256);
  exchange(*open->archive);
  return open->found;
}

}  // namespace sluice
