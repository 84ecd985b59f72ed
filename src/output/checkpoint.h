#pragma once
/// Saved state on disk (HDF5): checkpoint.h5 and the generation before it, checkpoint.previous.h5.
///
/// Sections become groups, members become datasets. A hash over all data is stored with them and
/// checked before anything is restored, so that a damaged file is found out while the older one can
/// still be used.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/state_archive.h"
#include "output/run_folder.h"

namespace sluice {

/// Whose state it is. `process_sha256` decides whether a run may go on from it.
struct CheckpointStamp {
  std::string process_sha256;
  std::string program;  ///< version and commit that wrote it; told when it differs, not an error
  double time = 0;      ///< simulated [s]
};

/// Saves or restores one state: calls exchange() of whatever belongs to it.
using ExchangeState = std::function<void(StateArchive&)>;

/// Writes a new checkpoint.h5; the present one becomes checkpoint.previous.h5. A reader finds one or
/// the other whole at any moment. @throws EnvironmentError
void save_checkpoint(const RunFolder& folder, const CheckpointStamp& stamp, const ExchangeState& exchange);

struct RestoredCheckpoint {
  CheckpointStamp stamp;
  std::vector<std::string> notes;  ///< for the user: the newest was damaged, another program wrote it
};

/// Finds the newest whole checkpoint: what `--resume` starts from. Nothing is restored yet.
/// nullopt if the folder has none.
/// @throws EnvironmentError  all there are are damaged, or of another format version
std::optional<RestoredCheckpoint> find_checkpoint(const RunFolder& folder);

/// @throws InputError  the checkpoint was saved by another process file
void refuse_other_process(const RunFolder& folder, const CheckpointStamp& stamp,
                          const std::string& process_sha256);

/// Restores from the newest whole checkpoint of this process.
/// @throws EnvironmentError  none, all damaged, another format version, or the state does not fit
/// @throws InputError  saved by another process file
RestoredCheckpoint load_checkpoint(const RunFolder& folder, const std::string& process_sha256,
                                   const ExchangeState& exchange);

}  // namespace sluice
