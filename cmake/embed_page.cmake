# Writes OUT, a C++ file that holds SCRIPT and STYLE as text (functions of src/reports/page_files.h).
file(READ "${SCRIPT}" script)
file(READ "${STYLE}" style)
file(WRITE "${OUT}" "#include \"reports/page_files.h\"\n
namespace sluice {
std::string_view page_script() {\n  return R\"sluice_page(")
file(APPEND "${OUT}" "${script}")
file(APPEND "${OUT}" ")sluice_page\";\n}\nstd::string_view page_style() {\n  return R\"sluice_page(")
file(APPEND "${OUT}" "${style}")
file(APPEND "${OUT}" ")sluice_page\";\n}\n}  // namespace sluice\n")
