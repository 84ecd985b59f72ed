#pragma once
/// Keys of a process named by their path, as `--set` and `--vary` have it.

#include <string>
#include <vector>

#include "processes/key_list.h"
#include "processes/process_document.h"

namespace sluice {

/// The declaration of "pipes.header.bore"; null where there is none. Names and places in lists match any.
const KeyEntry* find_key(const std::vector<KeyEntry>& keys, const std::string& path);

/// What is wrong with naming this key in this scene: a section that it does not have, a name that is none of
/// its own, or a key that no section has. Empty where nothing is.
/// @param where  of the path, for the message
std::vector<InputProblem> misnamed_key(const ProcessDocument& scene, const std::vector<KeyEntry>& keys,
                                       const std::string& path, const Location& where);

}  // namespace sluice
