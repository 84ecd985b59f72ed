#include "reports/page_shell.h"

#include <fmt/format.h>

#include "output/base64.h"
#include "reports/format.h"
#include "reports/page_files.h"

namespace sluice {

std::string page_html(const Page& page) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<link rel=\"icon\" href=\"data:,\"><title>";
  out += html(page.title) + "</title><style>";
  out += page_style();
  out += "</style></head>\n<body><header class=\"top\"><h1>" + html(page.title);
  if (!page.chip.empty()) out += fmt::format("<span class=\"chip {0}\">{0}</span>", html(page.chip));
  out += "</h1>";
  for (const std::string& line : page.lines) out += "<p>" + html(line) + "</p>";
  out += "</header>\n<nav>";
  for (const PageSection& s : page.sections)
    out += fmt::format("<a href=\"#{}\">{}</a>", s.id, html(s.heading));
  out += "</nav><main>\n";
  for (const PageSection& s : page.sections)
    out += fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}\n</section>\n", s.id, html(s.heading), s.body);
  out += "</main>\n";
  for (const auto& [id, json] : page.data)
    out += fmt::format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, script_json(json));
  if (!page.data.empty()) {
    out += "<script>";
    out += page_script();
    out += "</script>\n";
  }
  return out + "</body></html>\n";
}

std::string card(const std::string& value, const std::string& unit, const std::string& what) {
  return fmt::format(
      "<div class=\"card\"><div class=\"value\">{} <small>{}</small></div><div class=\"what\">{}</div></div>",
      value, unit, what);
}

std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows, LastRow last_row) {
  std::string out = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& cell : head) out += "<th>" + cell + "</th>";
  out += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += last_row == LastRow::total && i + 1 == rows.size() ? "<tr class=\"total\">" : "<tr>";
    for (const std::string& cell : rows[i]) out += "<td>" + cell + "</td>";
    out += "</tr>";
  }
  return out + "</tbody></table></div>";
}

std::string inline_picture(const std::string& png, const std::string& alternative) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", html(alternative),
                     base64(png.data(), png.size()));
}

const std::vector<ExitQuantity>& exit_quantities() {
  static const std::vector<ExitQuantity> quantities = {
      {"rock_kg_s", "Rock", "t/h per metre", 3.6, PerWidth::per_metre},
      {"water_kg_s", "Water with its fines", "t/h per metre", 3.6, PerWidth::per_metre},
      {"water_m3_per_t", "Water per tonne of rock", "m\u00b3/t", 1, PerWidth::whole_bin},
      {"rock_size_mean_m", "Mean size of rock, by mass", "mm", 1000, PerWidth::whole_bin},
      {"rock_speed_m_s", "Speed of rock", "m/s", 1, PerWidth::whole_bin},
      {"water_speed_m_s", "Speed of water", "m/s", 1, PerWidth::whole_bin}};
  return quantities;
}

}  // namespace sluice
