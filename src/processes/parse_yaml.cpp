#include "processes/parse_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

namespace sluice {
namespace {

// Aliases can make a few lines stand for a billion nodes, or for themselves.
constexpr int deepest = 64;
constexpr std::size_t most_nodes = 100'000;

class TreeBuilder {
 public:
  TreeBuilder(const std::string& text, std::string place, std::string folder,
              std::vector<InputProblem>& problems)
      : text_(text), place_(std::move(place)), folder_(std::move(folder)), problems_(problems) {}

  InputNode build(const YAML::Node& yaml, int depth = 0) {
    InputNode node;
    node.where = location(yaml.Mark());
    node.folder = folder_;
    if (depth > deepest || ++nodes_ > most_nodes)
      throw InputError({node.where, "", "the file is nested too deeply or too large",
                        "an alias that contains itself does this", "write the value out"});
    switch (yaml.Type()) {
      case YAML::NodeType::Undefined:
      case YAML::NodeType::Null:
        break;
      case YAML::NodeType::Scalar:
        node.kind = InputNode::Kind::scalar;
        node.scalar = yaml.Scalar();
        node.quoted = yaml.Tag() == "!";
        check_quote(yaml.Mark());
        break;
      case YAML::NodeType::Sequence:
        node.kind = InputNode::Kind::list;
        for (const YAML::Node& item : yaml) node.list.push_back(build(item, depth + 1));
        break;
      case YAML::NodeType::Map:
        node.kind = InputNode::Kind::mapping;
        for (const auto& pair : yaml) add_entry(node, pair.first, pair.second, depth);
        break;
    }
    return node;
  }

  Location location(const YAML::Mark& mark) const {
    if (mark.is_null()) return {place_, 0, 0};
    return {place_, mark.line + 1, mark.column + 1};
  }

 private:
  void add_entry(InputNode& node, const YAML::Node& key, const YAML::Node& value, int depth) {
    const Location where = location(key.Mark());
    check_quote(key.Mark());
    if (!key.IsScalar() || key.Scalar().empty()) {
      problems_.push_back({where, "", "a key is not a word", "sections are made of 'key: value'",
                           "put text that holds braces or brackets in quotes"});
      return;
    }
    if (const InputEntry* first = node.find(key.Scalar())) {
      problems_.push_back({where, key.Scalar(), "is given twice",
                           fmt::format("it stands in line {} already", first->where.line), "keep one"});
      return;
    }
    node.mapping.push_back({key.Scalar(), where, build(value, depth + 1)});
  }

  /// yaml-cpp 0.7 takes a quote that is never closed for one closed at the end of the file.
  void check_quote(const YAML::Mark& mark) const {
    const auto begin = static_cast<std::size_t>(std::max(mark.pos, 0));
    if (mark.is_null() || begin >= text_.size()) return;
    const char quote = text_[begin];
    if (quote != '"' && quote != '\'') return;
    for (std::size_t i = begin + 1; i < text_.size(); ++i) {
      if (text_[i] == '\\' && quote == '"') {
        ++i;
      } else if (text_[i] == quote) {
        if (quote == '"' || i + 1 >= text_.size() || text_[i + 1] != quote) return;
        ++i;
      }
    }
    throw InputError({location(mark), "", "is not YAML: a quote is never closed", "", "close it"});
  }

  const std::string& text_;
  std::string place_, folder_;
  std::vector<InputProblem>& problems_;
  std::size_t nodes_ = 0;
};

}  // namespace

InputNode parse_yaml(const std::string& text, const std::string& place, const std::string& folder,
                     std::vector<InputProblem>& problems) {
  TreeBuilder builder(text, place, folder, problems);
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::Exception& e) {
    throw InputError({builder.location(e.mark), "", fmt::format("is not YAML: {}", e.msg),
                      "indentation, quotes or brackets do not match", "compare with the lines above"});
  }
  if (documents.empty() || (documents.size() == 1 && documents[0].IsNull()))
    throw InputError({{place, 1, 1},
                      "",
                      "the file is empty",
                      "a section with keys is needed",
                      "write 'key: value' lines"});
  if (documents.size() > 1)
    throw InputError({builder.location(documents[1].Mark()), "", "a second document begins",
                      "a file holds one", "remove the line '---' or split the file"});
  return builder.build(documents[0]);
}

}  // namespace sluice
