#!/usr/bin/env bash
# Counts what a scene executes and keeps for parts that it does not have, and writes reports/leave-out.md. Retired
# instructions by cachegrind, one thread, a build that any processor runs. Installs valgrind if it is missing. Some ten
# minutes after the build. Usage: scripts/leave_out.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

as_root=()
((EUID == 0)) || as_root=(sudo)
if ! dpkg-query --show --showformat='${db:Status-Status}' valgrind 2>/dev/null | grep -qx installed; then
  echo "leave_out: installing valgrind"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends valgrind >/dev/null
fi
scripts/setup.sh
build=build/leave-out
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O3 -g1 -DNDEBUG" \
  -DSLUICE_NATIVE=OFF >/dev/null
cmake --build "$build" --target leave_out sluice

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1 GOMP_SPINCOUNT=1000
scenes=tests/speed/leave_out

# A part alone or a scene whole, after so many steps: hash, heap [bytes], step [s], substeps; instructions in NAME.cg
drive() { # NAME MODE STEPS SCENE
  valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file="$work/$1.cg" \
    "$build/tests/leave_out" "$2" "$3" "$scenes/$4.yaml" >"$work/$1" 2>"$work/$1.log" || { cat "$work/$1.log" >&2; exit 1; }
}
program() { # NAME SECONDS SCENE
  valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file="$work/$1.cg" "$build/sluice" run "$scenes/$3.yaml" \
    --threads 1 --until "$2 s" --out "$work/$1.run" >"$work/$1.log" 2>&1 || { cat "$work/$1.log" >&2; exit 1; }
  sed -n 's/.*"state_hash": "\([0-9a-f]*\)".*/\1/p' "$work/$1.run/run.json" >"$work/$1"
}
field() { cut -d' ' -f"$2" "$work/$1"; }
instructions() { sed -n 's/^summary: *//p' "$work/$1.cg"; }
# Two lengths of a run tell the steps from the start: their difference is counted, over the steps of the particles.
per_step() { # NAME STEPS
  awk -v a="$(instructions "$1.1")" -v b="$(instructions "$1.2")" -v n="$2" 'BEGIN { printf "%.0f", (b - a) / n }'
}
both_lengths() { # NAME MODE STEPS SCENE
  drive "$1.1" "$2" "$3" "$4"
  drive "$1.2" "$2" "$((2 * $3))" "$4"
}
same_bits() { # NAME NAME
  [[ "$(field "$1" 1)" == "$(field "$2" 1)" ]] || { echo "leave_out: $1 and $2 end in different states" >&2; exit 1; }
}

failed=0
rows=""
row() { # WORDS WITH WITHOUT BYTES LIMIT_BYTES ("-": told, not judged)
  local verdict="not asked"
  [[ "$5" == - ]] ||  verdict=$(awk -v a="$2" -v b="$3" -v bytes="$4" -v limit="$5" \
    'BEGIN { print (a <= 1.02 * b && (bytes == "-" || bytes <= limit)) ? "yes" : "NO" }')
  [[ "$verdict" != NO ]] || failed=1
  rows+=$(awk -v words="$1" -v a="$2" -v b="$3" -v bytes="$4" -v verdict="$verdict" \
    'BEGIN { printf "| %s | %.0f | %.0f | %+.2f %% | %s | %s |", words, a, b, 100 * (a / b - 1), bytes, verdict }')$'\n'
  echo "$1: $2 against $3 instructions a step, $4 bytes a particle"
}
# The heap's difference over the particles; what does not grow with them (stages, the watch) is less than one byte each.
bytes_each() { # NAME NAME PARTICLES
  awk -v a="$(field "$1" 2)" -v b="$(field "$2" 2)" -v n="$3" 'BEGIN { d = (a - b) / n; printf "%.1f", d < 0 ? 0 : d }'
}

rock_steps=15 rocks=400 water_steps=60 points=24000
both_lengths rocks_alone rocks "$rock_steps" rocks
both_lengths rocks_whole whole "$rock_steps" rocks
same_bits rocks_alone.2 rocks_whole.2
n=$((rock_steps * $(field rocks_whole.2 4)))
row "dry scene whole / its rocks alone" "$(per_step rocks_whole "$n")" "$(per_step rocks_alone "$n")" \
  "$(bytes_each rocks_whole.2 rocks_alone.2 "$rocks")" 4

both_lengths shapes whole "$rock_steps" shapes
m=$((rock_steps * $(field shapes.2 4)))
row "spheres of a feed that may bring superquadrics / spheres" "$(per_step shapes "$m")" \
  "$(per_step rocks_whole "$n")" "$(bytes_each shapes.2 rocks_whole.2 "$rocks")" -

dt=$(field rocks_whole.2 3)
program rocks_program.1 "$(awk -v n="$rock_steps" -v dt="$dt" 'BEGIN { printf "%.17g", n * dt }')" rocks
program rocks_program.2 "$(awk -v n="$rock_steps" -v dt="$dt" 'BEGIN { printf "%.17g", 2 * n * dt }')" rocks
same_bits rocks_program.2 rocks_whole.2
row "\`sluice run\` of the dry scene, no output due / the scene's steps alone" "$(per_step rocks_program "$n")" \
  "$(per_step rocks_whole "$n")" - 0

both_lengths water_alone water "$water_steps" water
both_lengths water_whole whole "$water_steps" water
same_bits water_alone.2 water_whole.2
w=$((water_steps * $(field water_whole.2 4)))
row "water scene whole / its water alone" "$(per_step water_whole "$w")" "$(per_step water_alone "$w")" \
  "$(bytes_each water_whole.2 water_alone.2 "$points")" 1

dt=$(field water_whole.2 3)
program water_program.1 "$(awk -v n="$water_steps" -v dt="$dt" 'BEGIN { printf "%.17g", n * dt }')" water
program water_program.2 "$(awk -v n="$water_steps" -v dt="$dt" 'BEGIN { printf "%.17g", 2 * n * dt }')" water
same_bits water_program.2 water_whole.2
row "\`sluice run\` of the water scene, no output due / the scene's steps alone" "$(per_step water_program "$w")" \
  "$(per_step water_whole "$w")" - 0

# Instructions of a run's second half in source files whose path matches, over all of them [%].
share() { # NAME PATTERN
  local of_files=0 k
  for k in 1 2; do
    awk -v pattern="$2" '
      /^f[lie]=/ { mine = substr($0, 4) ~ pattern; next }
      mine && /^[0-9]/ { sum += $2 }
      END { printf "%.0f\n", sum }' "$work/$1.$k.cg" >"$work/share.$k"
  done
  of_files=$(awk -v a="$(cat "$work/share.1")" -v b="$(cat "$work/share.2")" 'BEGIN { printf "%.0f", b - a }')
  awk -v part="$of_files" -v a="$(instructions "$1.1")" -v b="$(instructions "$1.2")" \
    'BEGIN { s = 100 * part / (b - a); printf "%.4f", s < 0 ? 0 : s }'
}
files=""
unused() { # WORDS NAME PATTERN
  local percent
  percent=$(share "$2" "$3")
  awk -v p="$percent" 'BEGIN { exit p <= 2 ? 0 : 1 }' || failed=1
  files+="| $1 | \`${3//|/ }\` | $percent % |"$'\n'
}
# Where the files are is known from one that does the work.
awk -v p="$(share rocks_whole 'src/dem/')" 'BEGIN { exit p > 30 ? 0 : 1 }' || { echo "leave_out: no lines in the count" >&2; exit 1; }
unused "dry scene: water" rocks_whole 'src/(mpm|fluid)/'
unused "dry scene: coupling" rocks_whole 'src/coupling/'
unused "dry scene: feeds and fills" rocks_whole 'src/inflow/'
unused "dry scene of spheres: superquadrics" rocks_whole 'src/dem/(superquadric|turn_rocks)'
unused "dry scene, linear law: Hertz-Mindlin" rocks_whole 'src/dem/hertz_mindlin'
unused "dry scene, still walls: moving walls" rocks_whole 'src/(dem/moving_walls|dem/rigid_motion|geometry/wall_motion)'
unused "dry scene without exits and gauges: analysis" rocks_whole 'src/analysis/'
unused "water scene: rocks" water_whole 'src/dem/'
unused "water scene: coupling" water_whole 'src/coupling/'
unused "water scene: jets and sprays" water_whole 'src/inflow/'
unused "water scene without gauges: analysis" water_whole 'src/analysis/'
unused "program, nothing due: output" rocks_program 'src/(output|reports)/'

{
  echo "# What is left out costs nothing"
  echo
  echo "- commit: $(git rev-parse --short=12 HEAD)$(git diff --quiet HEAD -- . ':!reports' || echo ', with changes')"
  echo "- command: \`scripts/leave_out.sh\`"
  echo "- compiler: $(c++ --version | head -n 1), \`-O3 -g1\`, no processor named"
  echo "- counted by: $(valgrind --version), cachegrind, one thread"
  echo
  echo "Retired instructions of a rock step or water step, from the difference of two lengths of the same run ($rock_steps and"
  echo "$((2 * rock_steps)) scene steps of $rocks rocks; $water_steps and $((2 * water_steps)) of $points water points), so that the start does not count."
  echo "Both sides of a row end in the same bits, but for the feed that may bring superquadrics, whose time step is another and"
  echo "whose spheres keep their orientation: that is what such a scene needs, told here and not judged. Bytes"
  echo "are the heap in use at the end, the difference over the particles. Asked: at most 2 % and 0 bytes; the few hundred bytes of"
  echo "stages and watch do not grow with the scene."
  echo
  echo "| scene / what it is compared with | instructions | of the other | more | bytes a particle | within the limit |"
  echo "|---|---|---|---|---|---|"
  printf '%s' "$rows"
  echo
  echo "The same counts by source file: what a scene executes in the files of a part that it does not have."
  echo
  echo "| scene: part that it leaves out | files | share of its instructions |"
  echo "|---|---|---|"
  printf '%s' "$files"
} >reports/leave-out.md
cat reports/leave-out.md
exit "$failed"
