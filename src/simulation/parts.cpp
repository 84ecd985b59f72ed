#include "simulation/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace sluice {

namespace {
std::string counted(std::size_t n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}
}  // namespace

std::vector<std::string> Parts::present() const {
  std::vector<std::string> words;
  if (rocks) words.push_back("rocks");
  if (water) words.push_back("water");
  if (coupling) words.push_back("coupling");
  const auto& all = walls->all();
  const auto moving = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const Wall& wall) { return wall.motion.has_value(); }));
  if (all.size() > moving) words.push_back(counted(all.size() - moving, "wall"));
  if (moving > 0) words.push_back(counted(moving, "moving wall"));
  std::map<std::string, std::size_t> kinds;
  for (const auto& inflow : inflows) ++kinds[inflow->kind()];
  for (const auto& [kind, n] : kinds) words.push_back(counted(n, kind));
  if (exits && !exits->tallies().empty()) words.push_back(counted(exits->tallies().size(), "exit"));
  if (!probes.empty()) words.push_back(counted(probes.size(), "probe"));
  return words;
}

std::vector<std::string> Parts::left_out() const {
  std::vector<std::string> words;
  if (!rocks) words.push_back("rocks");
  if (!water) words.push_back("water");
  if (!coupling) words.push_back("coupling");
  if (walls->size() == 0) words.push_back("walls");
  if (inflows.empty()) words.push_back("inflow");
  if (!exits || exits->tallies().empty()) words.push_back("exits");
  if (probes.empty()) words.push_back("probes");
  return words;
}

}  // namespace sluice
