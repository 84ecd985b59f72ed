#pragma once
/// The repository as its own rules see it: tracked files, their lines and what they include.

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace sluice::repository {

inline std::string root() {
  return SLUICE_ROOT;
}

/// Output of a command run in the root, and its exit status.
struct Outcome {
  int status = -1;
  std::string output;
};
inline Outcome run(const std::string& command) {
  Outcome outcome;
  std::FILE* pipe = popen(("cd '" + root() + "' && " + command + " 2>&1").c_str(), "r");
  if (!pipe) return outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), n);
  outcome.status = pclose(pipe);
  return outcome;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// Every tracked file; every file below the source folders where this is no git checkout.
inline std::vector<std::string> files() {
  Outcome git = run("git -c safe.directory='*' ls-files --cached");
  if (git.status != 0) git = run("find src tests cmake geometry scripts processes validation CMake* -type f");
  std::vector<std::string> all;
  for (const std::string& name : lines_of(git.output))
    if (std::ifstream(root() + "/" + name).good()) all.push_back(name);  // removed, but not yet committed
  std::sort(all.begin(), all.end());
  return all;
}

inline bool has_ending(const std::string& name, std::initializer_list<const char*> endings) {
  return std::any_of(endings.begin(), endings.end(), [&](const char* e) { return name.ends_with(e); });
}

inline std::vector<std::string> cpp_files(const std::string& folder) {
  std::vector<std::string> found;
  for (const std::string& name : files())
    if (name.starts_with(folder + "/") && has_ending(name, {".h", ".cpp"})) found.push_back(name);
  return found;
}

inline std::vector<std::string> read_lines(const std::string& name) {
  std::ifstream stream(root() + "/" + name);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// `#include "x/y.h"` -> x/y.h for opening = '"'; `#include <z>` -> z for '<'.
inline std::vector<std::string> includes(const std::string& name, char opening) {
  std::vector<std::string> found;
  for (const std::string& line : read_lines(name)) {
    std::size_t i = line.find_first_not_of(" \t");
    if (i == std::string::npos || line[i] != '#') continue;
    i = line.find_first_not_of(" \t", i + 1);
    if (i == std::string::npos || line.compare(i, 7, "include") != 0) continue;
    const std::size_t begin = line.find(opening, i);
    const std::size_t end =
        line.find(opening == '<' ? '>' : '"', begin == std::string::npos ? begin : begin + 1);
    if (begin != std::string::npos && end != std::string::npos)
      found.push_back(line.substr(begin + 1, end - begin - 1));
  }
  return found;
}

}  // namespace sluice::repository
