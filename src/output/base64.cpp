#include "output/base64.h"

#include <algorithm>
#include <array>

namespace sluice {
namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int, 256> make_values() {
  std::array<int, 256> values{};
  for (int& v : values) v = -1;
  for (std::size_t k = 0; k < alphabet.size(); ++k)
    values[static_cast<unsigned char>(alphabet[k])] = static_cast<int>(k);
  return values;
}
constexpr std::array<int, 256> values = make_values();

}  // namespace

std::string base64(const void* data, std::size_t bytes) {
  const auto* in = static_cast<const std::uint8_t*>(data);
  std::string out;
  out.reserve((bytes + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes; k += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes - k);
    std::uint32_t group = static_cast<std::uint32_t>(in[k]) << 16;
    if (n > 1) group |= static_cast<std::uint32_t>(in[k + 1]) << 8;
    if (n > 2) group |= in[k + 2];
    out += alphabet[group >> 18];
    out += alphabet[(group >> 12) & 63];
    out += n > 1 ? alphabet[(group >> 6) & 63] : '=';
    out += n > 2 ? alphabet[group & 63] : '=';
  }
  return out;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::vector<std::uint8_t> out;
  out.reserve(text.size() / 4 * 3);
  for (std::size_t k = 0; k < text.size(); k += 4) {
    const bool last = k + 4 == text.size();
    const int padding = !last || text[k + 3] != '=' ? 0 : text[k + 2] != '=' ? 1 : 2;
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const bool pad = j >= 4 - static_cast<std::size_t>(padding);
      const int value = pad ? 0 : values[static_cast<unsigned char>(text[k + j])];
      if (value < 0) return std::nullopt;
      group = group << 6 | static_cast<std::uint32_t>(value);
    }
    for (int j = 0; j < 3 - padding; ++j) out.push_back(static_cast<std::uint8_t>(group >> (16 - 8 * j)));
  }
  return out;
}

}  // namespace sluice
