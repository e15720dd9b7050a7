#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the fuzz targets and runs each for SECONDS (20 unless given), from the seeds and from what earlier runs of this
# build found worth keeping. What fails is kept under build/fuzz/found, with the command that repeats it.
# The last line reads "N passed, N failed", one case a target.
set -euo pipefail

seconds="${1:-20}"
root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd)"
build="$root/build/fuzz"

cd -- "$root"
if ! { cmake --preset fuzz --log-level=NOTICE >/dev/null && cmake --build --preset fuzz -j "$(nproc)"; }; then
  echo "0 passed, 1 failed"
  exit 1
fi
seeds="$build/seeds" found="$build/found"
mkdir -p -- "$found"
"$build/tests/fuzz/fuzz_seeds" "$seeds"

# Fuzzes target $1 and says what came of it.
fuzz() {
  local target=$1 corpus="$build/corpus/$1" log="$found/$1.log"
  mkdir -p -- "$corpus"
  # Long inputs only slow the search: the seeds' own lengths bound them. A reader may take 4 GB and a minute, with
  # sanitizers, for the largest scene it allows.
  local options=(-max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -print_final_stats=1 -verbosity=0
    -artifact_prefix="$found/$target-")
  case $target in
    scene) options+=(-dict="$root/tests/fuzz/scene.dict") ;;
    mesh | material) options+=(-dict="$root/tests/fuzz/mesh.dict") ;;
  esac
  if "$build/tests/fuzz/fuzz_$target" "${options[@]}" "$corpus" "$seeds/$target" >"$log" 2>&1; then
    echo "$target: $(sed -nE 's/^stat::number_of_executed_units: *//p' "$log") inputs"
  else
    tail -n 40 -- "$log"
    echo "FAILED: $target; repeat with $build/tests/fuzz/fuzz_$target FILE, FILE one of $found/$target-*"
    return 1
  fi
}

# Each has one thread: two at a time, where there are two cores.
passed=0 failed=0
targets=(scene mesh material picture)
at_once=$(($(nproc) > 1 ? 2 : 1))
for ((first = 0; first < ${#targets[@]}; first += at_once)); do
  running=()
  for target in "${targets[@]:first:at_once}"; do
    fuzz "$target" &
    running+=($!)
  done
  for process in "${running[@]}"; do
    if wait "$process"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
  done
done
echo "$passed passed, $failed failed"
((failed == 0))
