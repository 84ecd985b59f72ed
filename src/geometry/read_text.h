#pragma once
/// Reading a CAD file as bytes and lines, for our own checks before a library sees it.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"

namespace sluice {

/// The whole file. @throws InputError if it is missing, a folder, unreadable or empty
std::string read_bytes(const std::filesystem::path& file);

/// An InputError about a place in the file (line 0: the file as a whole).
InputError file_error(const std::filesystem::path& file, int line, std::string problem, std::string reason,
                      std::string suggestion);

/// One line at a time, without its end (\n, \r\n); counts from 1.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line);
  int number() const { return number_; }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// Words between blanks and tabs.
std::vector<std::string_view> words_of(std::string_view line);
/// Without blanks at either end.
std::string_view trimmed(std::string_view text);
/// The whole word as a number; nan and inf are numbers here.
std::optional<double> number_of(std::string_view word);
std::optional<long long> integer_of(std::string_view word);

}  // namespace sluice
