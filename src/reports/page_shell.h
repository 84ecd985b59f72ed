#pragma once
/// The parts that every page is put together from.

#include <string>
#include <utility>
#include <vector>

#include "reports/chart.h"
#include "reports/run_results.h"

namespace sluice {

struct PageSection {
  std::string id, heading;
  std::string body;  ///< HTML
};

struct Page {
  std::string title;               ///< plain text
  std::string chip;                ///< word and style of the label beside the title; empty = none
  std::vector<std::string> lines;  ///< under the title, plain text
  std::vector<PageSection> sections;
  std::vector<std::pair<std::string, std::string>> data;  ///< id and JSON for the script
};

/// The whole document: no address is loaded from anywhere.
std::string page_html(const Page& page);

/// A big number with what it is. `value` and `what` are HTML.
std::string card(const std::string& value, const std::string& unit, const std::string& what);

/// Table of HTML cells. The last row is bold if `last_row` is a total.
enum class LastRow { plain, total };
std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows, LastRow last_row = LastRow::plain);

/// PNG as an <img> that carries its own data.
std::string inline_picture(const std::string& png, const std::string& alternative);

/// One quantity of exits.csv across the width of its exits, for one or several runs.
struct ExitQuantity {
  const char* column;
  const char* title;
  const char* unit;
  double factor;
  PerWidth per;
};
const std::vector<ExitQuantity>& exit_quantities();

}  // namespace sluice
