#pragma once
/// SHA-256 of text (FIPS 180-4, through libcrypto): names a process file in run.json and checkpoints.

#include <string>
#include <string_view>

namespace sluice {

std::string sha256(std::string_view bytes);  ///< 64 hexadecimal digits

}  // namespace sluice
