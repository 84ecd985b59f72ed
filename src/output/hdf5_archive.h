#pragma once
/// One HDF5 file of state, being written or read. Used by checkpoint.cpp.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/state_archive.h"

namespace sluice {

enum class ArchiveUse { save, load };

class Hdf5Archive : public StateArchive {
 public:
  /// @throws EnvironmentError  the file cannot be made or is not an HDF5 file
  Hdf5Archive(const std::filesystem::path& file, ArchiveUse use);
  ~Hdf5Archive() override;

  bool loading() const override;
  void enter(std::string_view section) override;
  void leave() override;

  void set_attribute(const std::string& name, const std::string& text);
  /// nullopt if there is none.
  std::optional<std::string> attribute(const std::string& name) const;

  /// Hash over names, types, lengths and bytes of everything in the file, in any order of writing.
  /// @throws EnvironmentError  something cannot be read
  std::uint64_t content_hash() const;

  /// Ends writing. @throws EnvironmentError  the disk is full, ...
  void close();

 protected:
  void write(std::string_view name, Scalar scalar, std::size_t columns, std::size_t rows,
             const void* data) override;
  std::size_t rows(std::string_view name, Scalar scalar, std::size_t columns) override;
  void read(std::string_view name, void* data) override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sluice
