#include "geometry/read_text.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>

namespace sluice {

namespace {

constexpr std::string_view blanks = " \t\r\v\f";

template <class T>
std::optional<T> parsed(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

InputError file_error(const std::filesystem::path& file, int line, std::string problem, std::string reason,
                      std::string suggestion) {
  return InputError(InputProblem{{file.string(), line, line > 0 ? 1 : 0},
                                 "",
                                 std::move(problem),
                                 std::move(reason),
                                 std::move(suggestion)});
}

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw file_error(file, 0, "is missing", "a CAD file is named but not there", "check the path");
  if (!std::filesystem::is_regular_file(status))
    throw file_error(file, 0, "is not a file", "a CAD file is needed", "check the path");
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) throw file_error(file, 0, "cannot be read", "no permission or a disk error", "check the file");
  if (bytes.empty()) throw file_error(file, 0, "is empty", "it has no bytes", "export the part again");
  return bytes;
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++number_;
  return true;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t start = line.find_first_not_of(blanks);
    if (start == std::string_view::npos) return words;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of(blanks), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::string_view trimmed(std::string_view text) {
  const std::size_t start = text.find_first_not_of(blanks);
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(blanks) - start + 1);
}

std::optional<double> number_of(std::string_view word) {
  return parsed<double>(word);
}

std::optional<long long> integer_of(std::string_view word) {
  return parsed<long long>(word);
}

}  // namespace sluice
