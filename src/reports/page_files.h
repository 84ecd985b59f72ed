#pragma once
/// What every page carries with it: src/reports/page, bundled. Written by cmake/embed_page.cmake.

#include <string_view>

namespace sluice {

std::string_view page_script();  ///< viewer.bundle.js
std::string_view page_style();   ///< viewer.bundle.css

}  // namespace sluice
