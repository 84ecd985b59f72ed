#!/usr/bin/env bash
# Sets up, builds everything and runs every test. The last line is CTest's summary.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release

# Failures in full, passes counted; the whole log stays beside the build.
log=build/release/ctest.log
status=0
ctest --preset release -j2 2>&1 | tee "$log" | awk '
  /^ *Start +[0-9]+: / { next }
  /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: .* Passed +[0-9.]+ sec *$/ {
    if (++passed % 50 == 0) { print "  " passed " tests passed"; fflush() }
    next
  }
  { print; fflush() }' || status=$?
echo "whole log: $log"
if ! grep -E '^[0-9]+% tests passed' "$log"; then
  echo "no test was run" >&2
  exit 1
fi
exit "$status"
