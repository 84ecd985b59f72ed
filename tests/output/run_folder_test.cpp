#include "output/run_folder.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "output/temporary_folder.h"

namespace sluice {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, IsMadeWithItsParents) {
  const TemporaryFolder temporary;
  const RunFolder folder = open_run_folder(temporary.path / "a" / "b", FolderUse::fresh);
  EXPECT_TRUE(fs::is_directory(folder.root));
  EXPECT_EQ(folder.manifest(), temporary.path / "a" / "b" / "run.json");
}

TEST(RunFolder, ForgetsAnEarlierRunButNothingElse) {
  const TemporaryFolder temporary;
  RunFolder folder = open_run_folder(temporary.path, FolderUse::fresh);
  fs::create_directories(folder.frames());
  for (const fs::path& file : {folder.manifest(), folder.checkpoint(), folder.frames() / "rocks_000000.vtp",
                               folder.root / "notes.txt", folder.frames() / "mine.txt"})
    write_atomically(file, "x");
  open_run_folder(temporary.path, FolderUse::resume);
  EXPECT_TRUE(fs::exists(folder.manifest()));
  open_run_folder(temporary.path, FolderUse::fresh);
  EXPECT_FALSE(fs::exists(folder.manifest()));
  EXPECT_FALSE(fs::exists(folder.checkpoint()));
  EXPECT_FALSE(fs::exists(folder.frames() / "rocks_000000.vtp"));
  EXPECT_TRUE(fs::exists(folder.root / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder.frames() / "mine.txt"));
}

TEST(RunFolder, SaysWhyItCannotBeMade) {
  const TemporaryFolder temporary;
  write_atomically(temporary.path / "file", "x");
  try {
    open_run_folder(temporary.path / "file" / "run", FolderUse::fresh);
    FAIL() << "a folder inside a file was made";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
  }
}

TEST(AtomicWrite, ReplacesTheContentAndLeavesNothingBeside) {
  const TemporaryFolder temporary;
  const fs::path file = temporary.path / "f";
  write_atomically(file, "one");
  write_atomically(file, "two");
  EXPECT_EQ(read_whole_file(file), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(temporary.path), {}), 1);
}

TEST(AtomicWrite, KeepsTheOldContentIfTheDiskRefuses) {
  const TemporaryFolder temporary;
  const fs::path file = temporary.path / "f";
  write_atomically(file, "one");
  fs::create_directory(temporary.path / "f.tmp");  // stands in the way of the temporary file
  EXPECT_THROW(write_atomically(file, "two"), EnvironmentError);
  EXPECT_EQ(read_whole_file(file), "one");
}

TEST(ReadWholeFile, SaysThatAFileIsNotThere) {
  try {
    read_whole_file("/nowhere/run.json");
    FAIL() << "a missing file was read";
  } catch (const EnvironmentError& error) {
    EXPECT_EQ(std::string(error.what()), "/nowhere/run.json: cannot be read (No such file or directory)");
  }
}

}  // namespace
}  // namespace sluice
