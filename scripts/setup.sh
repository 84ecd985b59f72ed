#!/usr/bin/env bash
# Installs the Debian 12 packages that building and testing need, and only those that are missing.
set -euo pipefail

# The one list. The README says what each is for.
packages=(
  g++ cmake ninja-build ccache git pkg-config clang-format
  libassimp-dev libcgal-dev libembree-dev libeigen3-dev libvtk9-dev libyaml-cpp-dev libhdf5-dev
  libudunits2-dev libcli11-dev libfmt-dev nlohmann-json3-dev libssl-dev libpng-dev
  libgtest-dev libbenchmark-dev
  chromium fonts-dejavu-core
)

installed() {
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

missing=()
for package in "${packages[@]}"; do
  installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "setup: all ${#packages[@]} packages are there"
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "setup: these packages are missing and only root can install them: ${missing[*]}" >&2
    exit 4
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
echo "setup: done"
