#include "processes/process_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "processes/parse_yaml.h"
#include "processes/yaml_schema.h"

namespace sluice {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& path) {
  if (fs::is_directory(path))
    throw EnvironmentError(fmt::format("{} is a folder; name a file", path.string()));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw EnvironmentError(fmt::format("{} cannot be opened; check the path", path.string()));
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> keys_of(const InputNode& node) {
  std::vector<std::string> keys;
  for (const InputEntry& e : node.mapping) keys.push_back(e.key);
  return keys;
}

/// Index of a list item, counted from 0; size of the list if `word` is not one.
std::size_t index_of(const std::string& word, const InputNode& list) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
  if (error != std::errc{} || end != word.data() + word.size()) return list.list.size();
  return std::min(index, list.list.size());
}

void place_everywhere(InputNode& node, const Location& where) {
  node.where = where;
  for (InputNode& item : node.list) place_everywhere(item, where);
  for (InputEntry& entry : node.mapping) {
    entry.where = where;
    place_everywhere(entry.value, where);
  }
}

}  // namespace

ProcessDocument ProcessDocument::read(const fs::path& path, const std::vector<std::string>& overrides) {
  ProcessDocument document;
  document.root_ = document.load(path, {});
  for (const std::string& assignment : overrides) document.override_with(assignment);
  return document;
}

InputNode ProcessDocument::load(const fs::path& path, const Location& named_at) {
  if (!named_at.file.empty()) {
    if (!fs::is_regular_file(path))
      throw InputError({named_at, "extends", fmt::format("names '{}', which is not there", path.string()),
                        "the path is relative to this file", "check the path"});
    for (const fs::path& open : files_)
      if (fs::weakly_canonical(open) == fs::weakly_canonical(path))
        throw InputError({named_at, "extends",
                          fmt::format("names '{}', which extends this file", path.string()),
                          "a file cannot extend itself", "break the circle"});
  }
  files_.push_back(path);
  InputNode node = parse_yaml(text_of(path), path.string(), path.parent_path().string(), problems_);
  if (node.kind != InputNode::Kind::mapping)
    throw InputError({node.where, "", fmt::format("the file is {}", node.describe()),
                      "a section with keys is needed", "write 'key: value' lines"});
  const InputEntry* extends = node.find("extends");
  if (!extends) return node;
  const InputNode named = extends->value;
  std::erase_if(node.mapping, [](const InputEntry& e) { return e.key == "extends"; });
  if (named.kind != InputNode::Kind::scalar)
    throw InputError({named.where, "extends", "is " + named.describe(), "the name of one file is needed",
                      "write 'extends: other.yaml'"});
  InputNode base = load((path.parent_path() / named.scalar).lexically_normal(), named.where);
  return merged(std::move(base), std::move(node));
}

void ProcessDocument::override_with(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string path = assignment.substr(0, equals);
  const Location where{"--set " + path, 0, 0};
  if (equals == std::string::npos || path.empty() || path.front() == '.' || path.back() == '.' ||
      path.find("..") != std::string::npos)
    throw InputError(
        {{"--set " + assignment, 0, 0}, "", "is not an assignment", "", "write --set key.path=value"});

  std::vector<std::string> words;
  std::istringstream stream(path);
  for (std::string word; std::getline(stream, word, '.');) words.push_back(word);

  InputNode value;
  try {
    value = parse_yaml(assignment.substr(equals + 1), where.file, root_.folder, problems_);
  } catch (const InputError& e) {
    problems_.push_back({where, words.back(), "has a value that cannot be read", e.problems().front().problem,
                         "write --set key.path=value"});
    return;
  }
  place_everywhere(value, where);

  InputNode* node = &root_;
  for (std::size_t depth = 0; depth < words.size(); ++depth) {
    const std::string& word = words[depth];
    if (node->kind == InputNode::Kind::list) {
      const std::size_t index = index_of(word, *node);
      if (index == node->list.size()) {
        problems_.push_back({where, word, "is not an item of this list",
                             fmt::format("it has {} items, counted from 0", node->list.size()), ""});
        return;
      }
      node = &node->list[index];
      continue;
    }
    if (node->kind != InputNode::Kind::mapping) {
      problems_.push_back(
          {where, word, "does not exist",
           fmt::format("'{}' is {}, not a section", words[depth - 1], node->describe()),
           fmt::format("write --set {}=value",
                       fmt::join(words.begin(), words.begin() + static_cast<long>(depth), "."))});
      return;
    }
    InputEntry* entry = node->find(word);
    if (!entry) {
      // On the way a near name is meant; a new one may be a section that the file leaves out, which
      // the schema then knows or refuses.
      const std::string near = depth + 1 < words.size() ? nearest_word(word, keys_of(*node)) : "";
      if (!near.empty()) {
        problems_.push_back({where, word, "does not exist", "", fmt::format("did you mean '{}'?", near)});
        return;
      }
      InputNode section;
      section.kind = InputNode::Kind::mapping;
      section.where = where;
      section.folder = root_.folder;
      node->mapping.push_back({word, where, std::move(section)});
      entry = &node->mapping.back();
    }
    entry->where = where;
    node = &entry->value;
  }
  *node = std::move(value);
}

void ProcessDocument::visit(const std::function<void(Schema&)>& keys) {
  InputEntry top{"", root_.where, root_};
  YamlSchema schema(top, problems_);
  keys(schema);
  schema.report_unknown();
}

void ProcessDocument::finish() const {
  if (problems_.empty()) return;
  // Reading order: the process file, then what it extends, then --set; what is missing comes last.
  const auto file_rank = [&](const std::string& name) {
    const auto found =
        std::find_if(files_.begin(), files_.end(), [&](const auto& f) { return f.string() == name; });
    return found - files_.begin();
  };
  const auto order = [&](const InputProblem& p) {
    return std::tuple(p.problem == YamlSchema::missing, file_rank(p.where.file), p.where.line,
                      p.where.column);
  };
  std::vector<InputProblem> sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const InputProblem& a, const InputProblem& b) { return order(a) < order(b); });
  throw InputError(std::move(sorted));
}

}  // namespace sluice
