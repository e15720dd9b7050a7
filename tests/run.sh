#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what is missing, builds, runs the tests, and sums up. See --help; how much each tier does stands in tiers.txt.
set -euo pipefail

usage() {
  cat <<'END'
usage: tests/run.sh [--ci | --long] [--preset P]... [--bless]

  (nothing)    at most 15 minutes from a fresh clone, packages included
  --ci         at most 60 minutes: sanitizers, every instruction set, planted faults, fuzzing
  --long       what takes longer
  --preset P   build and test P only (release, debug, asan-ubsan, tsan; may be repeated)
  --bless      store the small reference pictures anew, from the release build, and name those that changed

The last line reads "N passed, N failed" (and ", N skipped" if any). Exit code 0 if tests ran and none failed.
END
}

root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)"
jobs="$(nproc)"
tier=default
presets=()
bless=
while (($#)); do
  case $1 in
    --ci) tier=ci ;;
    --long) tier=long ;;
    --preset) presets+=("${2:?--preset needs a name}"); shift ;;
    --bless) bless=1 ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

# The entry of row $1 for tier $2, a list with spaces for commas.
entry() {
  local value
  value="$(awk -v row="$1" -v tier="$2" '
    $1 == "name" { for (i = 2; i <= NF; ++i) if ($i == tier) column = i }
    $1 == row { print $column }' "$root/tests/tiers.txt")"
  [[ $value == - ]] || echo "${value//,/ }"
}

# The tier that the tests of preset $1 run in.
tier_of() { if [[ $1 == release ]]; then echo "$tier"; else echo sanitized; fi; }

passed=0 failed=0 skipped=0
summary=()
# One stage is over: its name, when it began (in $SECONDS), and its passed, failed and skipped cases.
record() {
  passed=$((passed + $3)) failed=$((failed + $4)) skipped=$((skipped + $5))
  summary+=("$(printf '%-22s %5d s   %d passed, %d failed, %d skipped' "$1" $((SECONDS - $2)) "$3" "$4" "$5")")
}

# Builds and tests preset $1; what does not build counts as one failure.
run_preset() {
  local preset=$1 dir="$root/build/$1" start=$SECONDS cases= left_out=
  [[ $preset != tsan ]] || cases="$(entry tsan_runs "$tier")"
  [[ $preset != asan-ubsan ]] || left_out="$(entry asan_leaves_out "$tier")"
  echo "== $preset: build"
  if ! { cmake -S "$root" --preset "$preset" -D SIDELIGHT_TESTS=ON -D SIDELIGHT_TEST_CASES="$cases" \
    -D SIDELIGHT_STAND_INS="$(entry stand_ins "$(tier_of "$preset")")" --log-level=NOTICE >/dev/null &&
    run_in "$preset" cmake --build "$dir" -j "$jobs"; }; then
    record "$preset: build" "$start" 0 1 0
    return
  fi
  record "$preset: build" "$start" 0 0 0

  local before after
  before="$(stored_pictures)"
  if [[ -n $cases ]]; then
    run_tests "$preset" "$preset: test" -R "^($cases)"
    record "$preset: hard cases" "$SECONDS" 0 0 1   # not all of them ran
  else
    run_tests "$preset" "$preset: test" ${left_out:+-E "^($left_out)"}
    [[ -z $left_out ]] || record "$preset: left out" "$SECONDS" 0 0 "$(tr '|' '\n' <<<"$left_out" | wc -l)"
    judge_hard_cases "$preset" "$preset: hard cases"
  fi

  if [[ -n $bless ]]; then
    after="$(stored_pictures)"
    echo "stored pictures that changed:"
    diff <(echo "$before") <(echo "$after") | sed -nE 's/^[<>] [0-9a-f]+ +/  /p' | sort -u
  fi
}

# The tests of preset $1 as stage $2, with what follows as further arguments of ctest.
run_tests() {
  local preset=$1 stage=$2 start=$SECONDS dir="$root/build/$1" code=0 total bad not_run
  shift 2
  echo "== $stage"
  rm -f -- "$dir/junit.xml" "$dir/hardcases.tsv"
  SIDELIGHT_TIER="$(tier_of "$preset")" SIDELIGHT_BLESS="$bless" run_in "$preset" \
    ctest --test-dir "$dir" "$@" -j "$jobs" --timeout "$(entry test_timeout_seconds "$(tier_of "$preset")")" \
    --output-on-failure --no-tests=error --output-junit "$dir/junit.xml" || code=$?
  total="$(junit_count tests "$dir/junit.xml")" bad="$(junit_count failures "$dir/junit.xml")"
  not_run=$(($(junit_count skipped "$dir/junit.xml") + $(junit_count disabled "$dir/junit.xml")))
  ((bad > 0 || (total > 0 && code == 0))) || bad=1 total=$((total + 1))
  record "$stage" "$start" $((total - bad - not_run)) "$bad" "$not_run"
}

# Stage $2: the table of the hard cases that the tests of preset $1 just met.
judge_hard_cases() {
  local start=$SECONDS
  echo "== $2"
  if "$root/tests/hardcases/table.sh" "$root/build/$1"; then
    record "$2" "$start" 1 0 0
  else
    record "$2" "$start" 0 1 0
  fi
}

# Runs a command as preset $1 needs it. The ThreadSanitizer of GCC 12 stops where addresses are too random.
run_in() {
  local preset=$1 wrap=()
  shift
  if [[ $preset == tsan ]] && (($(cat /proc/sys/vm/mmap_rnd_bits 2>/dev/null || echo 0) > 28)); then
    wrap=(setarch -R)
  fi
  "${wrap[@]}" "$@"
}

# Attribute $1 of ctest's report $2, a count; 0 if there is none.
junit_count() {
  local count
  count="$(tr '\n\t' '  ' 2>/dev/null <"$2" | sed -nE "s/.*<testsuite [^>]* $1=\"([0-9]+)\".*/\1/p")" || true
  echo "${count:-0}"
}

stored_pictures() { find "$root/tests" -type f \( -name '*.png' -o -name '*.exr' \) -exec sha256sum {} + | sort -k2; }

# Every scene, both renderers, each instruction set in $@: the same file as the first one's. One case a picture.
run_isas() {
  local start=$SECONDS good=0 bad=0 absent=0 program="$root/build/release/viewer/sidelight" dir="$root/build/isas"
  local scene renderer isa first=$1 name code
  echo "== instruction sets: $*"
  mkdir -p -- "$dir"
  for scene in "$root"/scenes/*.toml; do
    for renderer in raster raytrace; do
      for isa in "$@"; do
        name="$(basename -- "$scene" .toml)-$renderer"
        code=0
        "$program" render "$scene" --renderer "$renderer" --layers all --isa "$isa" -r 320x240 -q \
          -o "$dir/$name-$isa.exr" || code=$?
        if ((code == 2)) && [[ $isa != "$first" ]]; then
          absent=$((absent + 1))   # this machine lacks it
        elif ((code == 0)) && cmp -- "$dir/$name-$first.exr" "$dir/$name-$isa.exr"; then
          good=$((good + 1))
        else
          echo "FAILED: $name --isa $isa (exit code $code; pictures in $dir)"
          bad=$((bad + 1))
        fi
      done
    done
  done
  record "instruction sets" "$start" "$good" "$bad" "$absent"
}

# The stage $1 is the script and arguments that follow. Its closing line counts, as ours does; without one it is one case.
run_script() {
  local start=$SECONDS name=$1 log="$root/build/${1// /_}.log" code=0 good bad
  shift
  echo "== $name"
  SIDELIGHT_TIER="$tier" "$@" 2>&1 | tee -- "$log" || code=$?
  if [[ $(tail -n 1 -- "$log") =~ ^([0-9]+)\ passed,\ ([0-9]+)\ failed ]]; then
    good=${BASH_REMATCH[1]} bad=${BASH_REMATCH[2]}
    ((code == 0 || bad > 0)) || bad=1
  else
    good=$((code == 0)) bad=$((code != 0))
  fi
  record "$name" "$start" "$good" "$bad" 0
}

echo "tier: $tier"
sed '/^#/d; /^$/d; s/^/  /' "$root/tests/tiers.txt"

start=$SECONDS
sections=(build test)
[[ $(entry fuzz_seconds "$tier") == 0 ]] || sections+=(fuzz)
"$root/viewer/install_packages.sh" "${sections[@]}"
record packages "$start" 0 0 0

only_presets=${bless}${presets[*]}
if ((${#presets[@]} == 0)); then
  read -ra presets <<<"$(if [[ -n $bless ]]; then echo release; else entry presets "$tier"; fi)"
fi
for preset in "${presets[@]}"; do run_preset "$preset"; done
if [[ -z $only_presets ]]; then
  for isa in $(entry suite_isas "$tier"); do
    SIDELIGHT_ISA="$isa" run_tests release "release on $isa: test"
    judge_hard_cases release "release on $isa: hard cases"
  done
  read -ra isas <<<"$(entry isas "$tier")"
  ((${#isas[@]} == 0)) || run_isas "${isas[@]}"
  [[ $(entry planted_faults "$tier") == 0 ]] || run_script "planted faults" "$root/tests/planted_faults.sh"
  fuzz_seconds="$(entry fuzz_seconds "$tier")"
  [[ $fuzz_seconds == 0 ]] || run_script fuzzing "$root/tests/fuzz/run.sh" "$fuzz_seconds"
fi

echo
echo "tier $tier, $SECONDS s:"
printf '  %s\n' "${summary[@]}"
((skipped == 0)) || also=", $skipped skipped"
echo "$passed passed, $failed failed${also:-}"
((failed == 0 && passed > 0))
