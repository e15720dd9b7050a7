#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the fuzz targets and runs each for SECONDS (20 unless given), from the seeds and from what earlier runs of this
# build found worth keeping. What fails is kept under build/fuzz/found, with the command that repeats it.
# The last line reads "N passed, N failed", one case a target.
set -euo pipefail

seconds="${1:-20}"
root="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)"
build="$root/build/fuzz"

cd -- "$root"
if ! { cmake --preset fuzz --log-level=NOTICE >/dev/null && cmake --build --preset fuzz -j "$(nproc)"; }; then
  echo "0 passed, 1 failed"
  exit 1
fi
seeds="$build/seeds" found="$build/found"
mkdir -p -- "$found"
"$build/tests/fuzz/fuzz_seeds" "$seeds"

passed=0 failed=0
for target in scene mesh material picture; do
  corpus="$build/corpus/$target"
  mkdir -p -- "$corpus"
  # Long inputs only slow the search: the seeds' own lengths bound them. A reader may take 4 GB and a minute, with
  # sanitizers, for the largest scene it allows.
  options=(-max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -print_final_stats=1 -verbosity=0
    -artifact_prefix="$found/$target-")
  case $target in
    scene) options+=(-dict="$root/tests/fuzz/scene.dict") ;;
    mesh | material) options+=(-dict="$root/tests/fuzz/mesh.dict") ;;
  esac
  log="$found/$target.log"
  if "$build/tests/fuzz/fuzz_$target" "${options[@]}" "$corpus" "$seeds/$target" >"$log" 2>&1; then
    echo "$target: $(sed -nE 's/^stat::number_of_executed_units: *//p' "$log") inputs"
    passed=$((passed + 1))
  else
    tail -n 40 -- "$log"
    echo "FAILED: $target; repeat with $build/tests/fuzz/fuzz_$target FILE, FILE one of $found/$target-*"
    failed=$((failed + 1))
  fi
done
echo "$passed passed, $failed failed"
((failed == 0))
