/// The rules of the house, as tests: floors, third-party includes, OpenMP, length and format of files.

#include "repo/repository.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace sluice::repository {
namespace {

const std::map<std::string, int> floors{{"base", 0},       {"geometry", 1},  {"fluid", 1},  {"dem", 2},
                                        {"mpm", 2},        {"coupling", 3},  {"inflow", 3}, {"analysis", 3},
                                        {"simulation", 4}, {"processes", 5}, {"output", 5}, {"validation", 6},
                                        {"reports", 6},    {"app", 7}};

/// "dem/rocks.h" -> "dem"; "" where there is no folder.
std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

TEST(Repository, HasFilesToCheck) {
  EXPECT_GT(cpp_files("src").size(), 20u);
  EXPECT_GT(cpp_files("tests").size(), 5u);
  EXPECT_FALSE(includes("src/base/vec.h", '<').empty());
  EXPECT_FALSE(includes("src/base/domain.h", '"').empty());
}

TEST(Floors, EveryFolderOfTheSourceHasOne) {
  for (const std::string& file : cpp_files("src"))
    EXPECT_TRUE(floors.count(folder_of(file.substr(4))))
        << file << ": its folder is not on a floor; name it here";
}

TEST(Floors, AFolderIncludesOnlyItselfAndLowerFloors) {
  for (const std::string& file : cpp_files("src")) {
    const std::string home = folder_of(file.substr(4));
    for (const std::string& included : includes(file, '"')) {
      const std::string other = folder_of(included);
      if (other.empty()) {
        EXPECT_EQ(included, "sluice_version.h") << file << ": include by full path, as in \"dem/rocks.h\"";
        continue;
      }
      if (other == home) continue;
      ASSERT_TRUE(floors.count(other)) << file << " includes " << included;
      EXPECT_LT(floors.at(other), floors.at(home))
          << file << " includes " << included << " from a floor not below";
    }
  }
}

/// Beginning of an included name -> the library it belongs to. Eigen and fmt are the house's own language.
const std::vector<std::pair<const char*, const char*>> libraries{
    {"yaml-cpp/", "yaml-cpp"}, {"assimp/", "assimp"},
    {"CGAL/", "CGAL"},         {"boost/", "boost"},
    {"embree3/", "embree"},    {"vtk", "vtk"},
    {"hdf5", "hdf5"},          {"H5", "hdf5"},
    {"CLI/", "CLI11"},         {"nlohmann/", "json"},
    {"udunits2", "udunits2"},  {"png.h", "png"},
    {"openssl/", "openssl"},   {"converter.h", "udunits2"}};

/// Headers of the system that are not the standard library's.
const std::set<std::string> system_headers{"omp.h",       "unistd.h",       "fcntl.h",      "immintrin.h",
                                           "sys/stat.h",  "sys/resource.h", "sys/ioctl.h",  "sys/wait.h",
                                           "sys/types.h", "sys/mman.h",     "sys/utsname.h"};

TEST(ThirdParty, ALibraryIsIncludedInTwoFilesAtMost) {
  std::map<std::string, std::set<std::string>> users;
  for (const std::string& file : cpp_files("src"))
    for (const std::string& name : includes(file, '<'))
      for (const auto& [beginning, library] : libraries)
        if (name.starts_with(beginning)) users[library].insert(file);
  for (const auto& [library, where] : users) {
    std::string list;
    for (const std::string& file : where) list += "\n  " + file;
    EXPECT_LE(where.size(), 2u) << library << " is included in" << list;
    for (const std::string& file : where)
      EXPECT_TRUE(file.ends_with(".cpp")) << library << " in the header " << file;
  }
}

TEST(ThirdParty, EveryIncludeIsKnown) {
  for (const std::string& file : cpp_files("src"))
    for (const std::string& name : includes(file, '<')) {
      const bool standard = name.find('/') == std::string::npos && name.find('.') == std::string::npos;
      if (standard && !name.starts_with("vtk")) continue;
      if (name.starts_with("Eigen/") || name.starts_with("fmt/") || system_headers.count(name)) continue;
      EXPECT_TRUE(std::any_of(libraries.begin(), libraries.end(),
                              [&](const auto& l) { return name.starts_with(l.first); }))
          << file << " includes <" << name << ">: a new library needs a line here and a reason in the README";
    }
}

TEST(OpenMp, PragmasAreInTheParallelLoopsAndInTheKernelsNamedHere) {
  // Kernels with threads of their own, each with its reason in the file. `omp simd` is no thread.
  const std::set<std::string> kernels{"src/base/parallel.h"};
  for (const std::string& file : cpp_files("src"))
    for (const std::string& line : read_lines(file)) {
      const std::size_t pragma = line.find("#pragma omp");
      if (pragma == std::string::npos || line.find("omp simd", pragma) != std::string::npos) continue;
      EXPECT_TRUE(kernels.count(file)) << file << ": " << line;
    }
}

TEST(OpenMp, ThereIsNoAtomicAndNoReduction) {
  for (const std::string& file : cpp_files("src"))
    for (const std::string& line : read_lines(file)) {
      if (line.find("#pragma omp") == std::string::npos) continue;
      EXPECT_EQ(line.find("atomic"), std::string::npos)
          << file << ": sums must not depend on the thread count";
      if (line.find("omp simd") != std::string::npos) continue;
      EXPECT_EQ(line.find("reduction"), std::string::npos) << file << ": use parallel_sum";
    }
}

TEST(Build, DoesNotTradeNaNsForSpeed) {
  for (const std::string& file : files()) {
    const bool build = file.starts_with("cmake/") || file.find("CMake") != std::string::npos ||
                       (file.starts_with("src/") && has_ending(file, {".h", ".cpp"}));
    if (!build) continue;
    for (const std::string& line : read_lines(file))
      for (const char* flag : {"-ffast-math", "-Ofast", "-ffinite-math-only", "-funsafe-math-optimizations"})
        EXPECT_EQ(line.find(flag), std::string::npos) << file << ": " << line;
  }
}

TEST(Files, AreAtMostFiveHundredLinesLong) {
  constexpr std::size_t longest = 500;
  for (const std::string& file : files()) {
    const bool ours = file.starts_with("src/") || file.starts_with("tests/") ||
                      file.starts_with("geometry/") || file.starts_with("scripts/") ||
                      file.starts_with("cmake/");
    const bool generated = file.find("bundle") != std::string::npos || file.ends_with("package-lock.json");
    if (!ours || generated ||
        !has_ending(file,
                    {".h", ".cpp", ".py", ".js", ".mjs", ".ts", ".css", ".html", ".sh", ".cmake", ".txt"}))
      continue;
    EXPECT_LE(read_lines(file).size(), longest) << file << ": split it by concept";
  }
}

TEST(Files, AreFormatted) {
  std::string names;
  for (const std::string& file : files())
    if (has_ending(file, {".h", ".cpp"})) names += " '" + file + "'";
  const Outcome outcome = run("clang-format --dry-run -Werror" + names);
  EXPECT_EQ(outcome.status, 0) << "run clang-format -i on these:\n" << outcome.output;
}

TEST(Files, HeadersAreIncludedOnce) {
  for (const std::string& folder : {std::string("src"), std::string("tests")})
    for (const std::string& file : cpp_files(folder))
      if (file.ends_with(".h")) {
        const auto lines = read_lines(file);
        EXPECT_TRUE(std::find(lines.begin(), lines.end(), "#pragma once") != lines.end()) << file;
      }
}

TEST(Tests, AreNeverDisabled) {
  const std::string disabled = std::string("DISABLED") + "_";
  for (const std::string& file : cpp_files("tests"))
    for (const std::string& line : read_lines(file))
      EXPECT_EQ(line.find("TEST") != std::string::npos && line.find(disabled) != std::string::npos, false)
          << file << ": " << line;
}

TEST(Scripts, CanBeRun) {
  for (const std::string& file : files())
    if (file.ends_with(".sh") || file == ".ci/run") {
      EXPECT_EQ(run("test -x '" + file + "'").status, 0) << file << " is not executable";
      EXPECT_EQ(run("bash -n '" + file + "'").status, 0) << file << " is not bash";
    }
}

}  // namespace
}  // namespace sluice::repository
