#include "reports/png.h"

#include <png.h>

#include <cstring>
#include <stdexcept>

#include "base/errors.h"

namespace sluice {
namespace {

/// libpng's simplified interface, set up for 8-bit RGB.
png_image header_of(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  return header;
}

}  // namespace

std::string png_bytes(const Image& image) {
  png_image header = header_of(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("a picture cannot be compressed: ") + header.message);
  bytes.resize(size);
  return bytes;
}

Image read_png(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const auto fail = [&] {
    InputProblem problem;
    problem.problem = "is not a picture";
    problem.reason = header.message;
    throw InputError(problem);
  };
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) fail();
  header.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  if (png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr) == 0) fail();
  return image;
}

}  // namespace sluice
