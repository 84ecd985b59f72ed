#pragma once
/// A process file, read strictly:
///
///   ProcessDocument document = ProcessDocument::read("processes/feedbox/demo.yaml", {"feed.rate=900 t/h"});
///   auto config = document.as<ProcessConfig>();   // ProcessConfig has keys(Schema&)
///   document.finish();                            // throws InputError with everything that is wrong
///
/// `extends: other.yaml` at the top takes another file and changes what is given here: mappings are
/// merged, all else replaced. `--set a.b.c=value` changes the tree after that; `layers.0.depth` counts
/// list items from 0. Files named in keys are relative to the file in which the key stands.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/schema.h"
#include "processes/input_node.h"

namespace sluice {

class ProcessDocument {
 public:
  /// @param overrides  each "a.b.c=value", the value in YAML
  /// @throws EnvironmentError if the file is not there or cannot be read; InputError for what is not YAML
  static ProcessDocument read(const std::filesystem::path& path,
                              const std::vector<std::string>& overrides = {});

  /// Fills a struct that has keys(Schema&). Problems are collected, not thrown.
  template <class T>
  void into(T& root) {
    visit([&](Schema& s) { root.keys(s); });
  }
  template <class T>
  T as() {
    T root{};
    into(root);
    return root;
  }
  /// Adds a problem found by a later check (parts that do not fit together, say).
  void add(InputProblem problem) { problems_.push_back(std::move(problem)); }
  /// Throws InputError if anything is wrong: unknown keys and bad values in reading order, then what
  /// is missing.
  void finish() const;

  const std::filesystem::path& file() const { return files_.front(); }
  /// The process file and those it extends, nearest first.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  const InputNode& root() const { return root_; }

 private:
  ProcessDocument() = default;
  void visit(const std::function<void(Schema&)>& keys);
  InputNode load(const std::filesystem::path& path, const Location& named_at);
  void override_with(const std::string& assignment);

  std::vector<std::filesystem::path> files_;
  InputNode root_;
  std::vector<InputProblem> problems_;
};

}  // namespace sluice
