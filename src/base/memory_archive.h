#pragma once
/// State kept in memory: the last good state while running, and what tests restore from.

#include <map>

#include "base/state_archive.h"

namespace sluice {

class MemoryArchive : public StateArchive {
 public:
  bool loading() const override { return loading_; }
  void enter(std::string_view section) override;
  void leave() override;
  void rewind_to_load() { loading_ = true; }  ///< what follows reads what was written
  void clear();
  std::size_t bytes() const;
  bool operator==(const MemoryArchive& other) const { return entries_ == other.entries_; }

 protected:
  void write(std::string_view name, Scalar scalar, std::size_t columns, std::size_t rows,
             const void* data) override;
  std::size_t rows(std::string_view name, Scalar scalar, std::size_t columns) override;
  void read(std::string_view name, void* data) override;

 private:
  struct Entry {
    Scalar scalar = Scalar::u8;
    std::size_t columns = 0;
    std::vector<std::uint8_t> bytes;
    bool operator==(const Entry&) const = default;
  };
  const Entry& find(std::string_view name) const;
  std::string path_of(std::string_view name) const { return prefix_ + std::string(name); }

  std::map<std::string, Entry> entries_;
  std::string prefix_;
  bool loading_ = false;
};

}  // namespace sluice
