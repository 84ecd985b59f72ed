#pragma once
/// Images in memory, and as PNG.

#include <cstdint>
#include <string>
#include <vector>

namespace sluice {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< height x width x 3, top row first
};

/// The bytes of a PNG file; the same image gives the same bytes.
std::string png_bytes(const Image& image);

/// Reads a PNG of 8-bit RGB, as png_bytes writes it. @throws InputError
Image read_png(const std::string& bytes);

}  // namespace sluice
