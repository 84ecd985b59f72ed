#include "app/brief_waits.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace sluice {

void wait_briefly(char** argv) {
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
  // By its own path, not by the link to it, which would be the process's name.
  std::error_code unreadable;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  if (!unreadable && setenv("GOMP_SPINCOUNT", "1000", 0) == 0) execv(program.c_str(), argv);
}

}  // namespace sluice
