#!/usr/bin/env bash
# From nothing to a page: sets up, builds the program and runs the small feed box.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release --target sluice
build/release/sluice run processes/feedbox/demo.yaml --out out/demo --threads "$(nproc)"
echo
echo "the page: $PWD/out/demo/report.html"
echo "for ParaView: $PWD/out/demo/frames"
