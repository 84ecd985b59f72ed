# Writes OUTPUT with version, commit, compiler and flags; touches it only when something changed.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
else()
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no -- src cmake CMakeLists.txt
                  OUTPUT_VARIABLE changed ERROR_QUIET)
  if(changed)
    string(APPEND commit "+changes")
  endif()
endif()
set(text "#pragma once
namespace sluice {
inline constexpr const char* program_version = \"${VERSION}\";
inline constexpr const char* program_commit = \"${commit}\";
inline constexpr const char* program_compiler = \"${COMPILER}\";
inline constexpr const char* program_flags = \"${FLAGS}\";
}  // namespace sluice
")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
