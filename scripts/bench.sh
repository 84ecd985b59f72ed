#!/usr/bin/env bash
# Runs the benchmarks and writes reports/benchmarks.{md,json} with their provenance. Ten minutes or so, on a quiet
# machine. Usage: scripts/bench.sh [FILTER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

filter="${1:-.}"
scripts/setup.sh
cmake --preset release >/dev/null
cmake --build --preset release --target sluice_bench
threads="${OMP_NUM_THREADS:-$(nproc)}"
export OMP_NUM_THREADS="$threads"
export GOMP_SPINCOUNT="${GOMP_SPINCOUNT:-1000}"  # as the program sets for itself
found=$(mktemp)
trap 'rm -f "$found"' EXIT
text=$(build/release/sluice_bench --benchmark_filter="$filter" --benchmark_counters_tabular=true --benchmark_min_time=0.3 \
  --benchmark_out="$found" --benchmark_out_format=json 2>/dev/null)
if grep 'ERROR OCCURRED' <<<"$text" >&2; then
  echo "bench: a benchmark found its answer wrong; nothing is written" >&2
  exit 1
fi
{
  echo "# Benchmarks"
  echo
  echo "- commit: $(git rev-parse --short=12 HEAD)"
  echo "- command: \`scripts/bench.sh $filter\`"
  echo "- compiler: $(c++ --version | head -n 1), \`-O3 -march=native -fno-math-errno -fno-trapping-math\`"
  echo "- threads: $threads on $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2 | xargs)"
  echo
  echo "Each benchmark checks its answer before it reports. Compare figures of one run only."
  echo
  echo '```'
  echo "$text"
  echo '```'
} >reports/benchmarks.md
# The machine's name is nobody's business.
sed 's/"host_name": "[^"]*"/"host_name": ""/; s|"executable": "[^"]*"|"executable": "sluice_bench"|' "$found" >reports/benchmarks.json
echo "written: reports/benchmarks.md"
