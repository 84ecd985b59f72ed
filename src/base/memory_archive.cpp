#include "base/memory_archive.h"

#include <fmt/format.h>

#include <cstring>

#include "base/errors.h"

namespace sluice {

void MemoryArchive::enter(std::string_view section) {
  prefix_ += std::string(section) + "/";
}

void MemoryArchive::leave() {
  prefix_.pop_back();
  const std::size_t slash = prefix_.rfind('/');
  prefix_ = slash == std::string::npos ? "" : prefix_.substr(0, slash + 1);
}

void MemoryArchive::clear() {
  entries_.clear();
  prefix_.clear();
  loading_ = false;
}

std::size_t MemoryArchive::bytes() const {
  std::size_t n = 0;
  for (const auto& [name, entry] : entries_) n += entry.bytes.size();
  return n;
}

void MemoryArchive::write(std::string_view name, Scalar scalar, std::size_t columns, std::size_t rows,
                          const void* data) {
  Entry entry{scalar, columns, std::vector<std::uint8_t>(rows * columns * size_of(scalar))};
  if (!entry.bytes.empty()) std::memcpy(entry.bytes.data(), data, entry.bytes.size());
  entries_[path_of(name)] = std::move(entry);
}

const MemoryArchive::Entry& MemoryArchive::find(std::string_view name) const {
  const auto found = entries_.find(path_of(name));
  if (found == entries_.end()) throw EnvironmentError(fmt::format("saved state has no '{}'", path_of(name)));
  return found->second;
}

std::size_t MemoryArchive::rows(std::string_view name, Scalar scalar, std::size_t columns) {
  const Entry& entry = find(name);
  if (entry.scalar != scalar || entry.columns != columns)
    throw EnvironmentError(fmt::format("saved state: '{}' has another type", path_of(name)));
  return entry.bytes.size() / (columns * size_of(scalar));
}

void MemoryArchive::read(std::string_view name, void* data) {
  const Entry& entry = find(name);
  if (!entry.bytes.empty()) std::memcpy(data, entry.bytes.data(), entry.bytes.size());
}

}  // namespace sluice
