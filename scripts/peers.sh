#!/usr/bin/env bash
# Runs the same beds of spheres in Debian's LIGGGHTS and LAMMPS (2 MPI ranks) and in sluice_bench (2 threads), one
# after the other and again, and writes reports/peers.md with the ratios of the medians. Installs the two packages if
# they are missing. Some ten minutes on a quiet machine. Usage: scripts/peers.sh [REPEATS [STEPS]]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

repeats="${1:-5}"
steps="${2:-400}"
warm=100   # as in the benchmark
skin=0.1  # over the smallest diameter: the fastest of 0.1, 0.15 and 0.2 for LAMMPS; a rebuild in some 100 steps
beds=(dense_200k poly5_50k)
declare -A rocks=([dense_200k]=200000 [poly5_50k]=50000)

as_root=()
((EUID == 0)) || as_root=(sudo)
for package in liggghts lammps; do
  if ! dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed; then
    echo "peers: installing $package"
    "${as_root[@]}" apt-get update -qq
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "$package" >/dev/null
  fi
done
scripts/setup.sh
cmake --preset release >/dev/null
cmake --build --preset release --target sluice_bench write_bed

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export GOMP_SPINCOUNT="${GOMP_SPINCOUNT:-1000}"  # as the program sets for itself
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# rate, coordination and list builds of one run of a peer: from its log
peer() { # PROGRAM DECK BED
  local log="$work/$1.log"
  OMP_NUM_THREADS=1 mpirun -np 2 --oversubscribe "$1" -in "tests/speed/peers/$2" -log none -var bed "$work/$3" \
    -var warm "$warm" -var steps "$steps" -var skin "$skin" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
  awk -v code="$1" '
    /^Loop time of/ { rate = $9 * $12 / $4 }
    /^Neighbor list builds/ { builds = $5 }
    /^coordination [0-9]/ { coordination = $2; drift = $5 - $4; scale = $4 < 0 ? -$4 : $4; seen = 1 }
    END {
      if (drift < 0) drift = -drift
      if (!seen || coordination < 1 || drift > 1e-6 * scale) {
        print "peers: " code " lost its contacts or its momentum" >"/dev/stderr"
        exit 1
      }
      printf "%.0f %.3f %d\n", rate, coordination, builds
    }' "$log"
}

# the same of the benchmark, which checks its own answer
ours() { # BED
  local out="$work/sluice.json" seconds
  seconds=$(awk -v n="${rocks[$1]}" -v steps="$steps" 'BEGIN { printf "%.2f", n * steps / 1.5e7 }')
  OMP_NUM_THREADS=2 build/release/sluice_bench --benchmark_filter="^dem_spheres/$1\$" --benchmark_min_time="$seconds" \
    --benchmark_format=json >"$out" 2>/dev/null
  awk -F'[:,]' '
    /"error_message"/ { print "peers: sluice_bench: " $0 >"/dev/stderr"; failed = 1 }
    /"rock_steps_per_s"/ { rate = $2 }
    /"coordination"/ { coordination = $2 }
    END {
      if (failed || !rate) exit 1
      printf "%.0f %.3f -\n", rate, coordination
    }' "$out"
}

median() { sort -g | awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }

answer=$(cd "$work"; echo 'atom_style superquadric' | liggghts 2>&1 || true)
if grep -q '^ERROR' <<<"$answer"; then
  superquadrics="Debian's LIGGGHTS is built without superquadrics: it gives no figure for them here."
else
  superquadrics="Debian's LIGGGHTS has superquadrics; they are not part of this comparison."
fi

table=""
for bed in "${beds[@]}"; do
  mkdir -p "$work/$bed"
  build/release/tests/write_bed "$bed" "$work/$bed"
  for ((k = 1; k <= repeats; ++k)); do
    peer liggghts liggghts.in "$bed" >>"$work/$bed.liggghts"
    peer lmp lammps.in "$bed" >>"$work/$bed.lammps"
    ours "$bed" >>"$work/$bed.sluice"
    echo "$bed, repeat $k of $repeats: LIGGGHTS, LAMMPS, Sluice:" \
      "$(tail -qn 1 "$work/$bed.liggghts" "$work/$bed.lammps" "$work/$bed.sluice" | cut -d' ' -f1 | xargs) rock-steps/s"
  done
  sluice=$(cut -d' ' -f1 "$work/$bed.sluice" | median)
  for code in liggghts lammps sluice; do
    read -r _ coordination builds < <(tail -n 1 "$work/$bed.$code")
    rate=$(cut -d' ' -f1 "$work/$bed.$code" | median)
    table+=$(awk -v bed="$bed" -v code="$code" -v rate="$rate" -v ours="$sluice" -v z="$coordination" -v b="$builds" \
      -v low="$(cut -d' ' -f1 "$work/$bed.$code" | sort -g | head -n 1)" \
      -v high="$(cut -d' ' -f1 "$work/$bed.$code" | sort -g | tail -n 1)" \
      'BEGIN { printf "| `%s` | %s | %.2f M | %.2f - %.2f M | %.2f | %s | %s |", bed, code, rate / 1e6, low / 1e6,
               high / 1e6, ours / rate, z, b }')$'\n'
  done
done

{
  echo "# Spheres beside LIGGGHTS and LAMMPS"
  echo
  echo "- commit: $(git rev-parse --short=12 HEAD)$(git diff --quiet HEAD -- . ':!reports' || echo ', with changes')"
  echo "- command: \`scripts/peers.sh $repeats $steps\`"
  echo "- compiler: $(c++ --version | head -n 1), \`-O3 -march=native -fno-math-errno -fno-trapping-math\`; the peers as Debian built them"
  echo "- packages: liggghts $(dpkg-query -W -f='${Version}' liggghts), lammps $(dpkg-query -W -f='${Version}' lammps)"
  echo "- threads: 2 in Sluice, 2 MPI ranks in the peers, on $(grep -m1 'model name' /proc/cpuinfo | cut -d: -f2 | xargs)"
  echo
  echo "Rock-steps per second, medians of $repeats runs taken in turn, each of about $steps steps after $warm others; rebuilds of"
  echo "the pair lists are included. Positions and velocities at the start, density, damping, friction, tangential history and time"
  echo "step are the same in all three. In \`dense_200k\` the stiffness is, too; in \`poly5_50k\` the peers have one for all pairs"
  echo "(of two of the smallest rocks), Sluice one that grows with the size. The peers' normal force may pull at the end of a"
  echo "contact, ours may not. Sluice checks its steps against a plain reference; the peers' contacts and momentum are checked."
  echo
  echo "| bed | code | median | range | Sluice is faster by | contacts of a rock | list builds |"
  echo "|---|---|---|---|---|---|---|"
  printf '%s' "$table"
  echo
  echo "$superquadrics"
} >reports/peers.md
cat reports/peers.md
