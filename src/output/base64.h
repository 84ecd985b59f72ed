#pragma once
/// Base64 (RFC 4648), for binary data inside pages and JSON.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

std::string base64(const void* data, std::size_t bytes);
/// nullopt if the text is not base64.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace sluice
