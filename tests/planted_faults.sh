#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Who watches the watchmen: puts each fault of planted_faults.txt into a copy of the source, builds it, and runs the
# check that must catch it. A fault that nobody catches is a failure, and so is one whose source text is no longer
# found exactly once, or a check that fails without any fault. Called by tests/run.sh --ci.
#
#   planted_faults.sh [TEXT]    only the faults whose line holds TEXT; default: all
#
# The copy lives in build/planted_faults and keeps its objects, so a second run builds the changed files only.
set -euo pipefail

root="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)"
work="$root/build/planted_faults"
tree="$work/tree"
objects="$work/objects"
scene="$tree/tests/agreement/everything.toml"
# The test files that hold the checks, beside every header; all others are left out, since they would only cost time.
tests=(tests/CMakeLists.txt tests/main.cpp tests/tiers.txt tests/support tests/agreement/everything.toml
  tests/agreement/test_references.cpp tests/agreement/test_lecture_pixels_local.cpp tests/model/test_visibility.cpp
  tests/hardcases/test_shadows.cpp tests/hardcases/test_triangles.cpp
  tests/judges/test_povray_terms.cpp tests/raster/test_visible.cpp
  tests/raytrace/test_enclosed.cpp tests/raytrace/test_lone_hit.cpp tests/raytrace/test_packets.cpp
  tests/raytrace/test_ray_kernel.cpp
  tests/raytrace/test_wave.cpp)

# Makes the copy equal to the source. Only files that differ are written, so that the build sees just those as new; one
# that an interrupted run left with a fault in it differs, too.
copy_source() {
  local file
  (cd -- "$root" && find CMakeLists.txt common raster raytrace viewer scenes "${tests[@]}" -type f &&
    find tests -name '*.h') | sort -u >"$work/files"
  while IFS= read -r file; do
    cmp -s -- "$root/$file" "$tree/$file" && continue
    mkdir -p -- "$(dirname -- "$tree/$file")"
    cp -- "$root/$file" "$tree/$file"
  done <"$work/files"
  (cd -- "$tree" && find . -type f -printf '%P\n') | sort | comm -13 "$work/files" - |
    while IFS= read -r file; do rm -- "$tree/$file"; done
}

# Little optimisation: these builds run for a second each.
configure() {
  cmake -S "$tree" -B "$objects" -G Ninja -D CMAKE_BUILD_TYPE=Planted -D CMAKE_CXX_FLAGS_PLANTED=-O1 \
    -D SIDELIGHT_TESTS=ON --log-level=NOTICE
}

# What check $1 runs, and no more.
build() {
  local target=sidelight_tests
  [[ $1 != compare ]] || target=sidelight
  cmake --build "$objects" -j "$(nproc)" --target "$target" >"$work/build.log" 2>&1
}

# Runs a check; its exit code is 0 where all is well, 1 where a fault was caught, anything else where the check itself
# broke down.
check() {
  local code=0
  case $1 in
    compare) "$objects/viewer/sidelight" compare "$scene" -q -o "$work/out" || code=$? ;;
    "test "*) "$objects/tests/sidelight_tests" --minimal --test-case="${1#test }" || code=$? ;;
    *) echo "unknown check: $1"; code=2 ;;
  esac >"$work/check.log" 2>&1
  return "$code"
}

# Replaces text $2 of file $1 by $3; fails unless it stands there exactly once.
plant() {
  local text rest
  text="$(cat -- "$1" && echo .)"   # the dot keeps the newlines at the end
  rest="${text#*"$2"}"
  [[ $rest != "$text" && $rest != *"$2"* ]] || return 1
  printf '%s' "${text%.}" >"$1.whole"
  text="${text/"$2"/"$3"}"
  printf '%s' "${text%.}" >"$1"
}

# What becomes of the fault in file $1, text $2, replacement $3, check $4.
verdict() {
  local file="$tree/$1" code=0
  plant "$file" "$2" "$3" || { echo "MISSED: the source text is not there exactly once"; return; }
  if build "$4"; then check "$4" || code=$?; else code=-1; fi
  cp -- "$file.whole" "$file" && rm -- "$file.whole"
  case $code in
    1) echo caught ;;
    0) echo "MISSED: the check saw nothing" ;;
    -1) echo "MISSED: does not build: $(grep -m1 error: "$work/build.log")" ;;
    *) echo "MISSED: the check broke down with code $code: $(tail -n 1 "$work/check.log")" ;;
  esac
}

passed=0 failed=0
row() {
  printf '%-44s %-52s %s\n' "$1" "$2" "$3"
  case $3 in caught | fine) passed=$((passed + 1)) ;; *) failed=$((failed + 1)) ;; esac
}

# Splits a line of the list at " | " into the array `field`.
split() {
  local rest="$1 | "
  field=()
  while [[ -n $rest ]]; do
    field+=("${rest%%" | "*}")
    rest="${rest#*" | "}"
  done
}

# The list in another order: the faults of one file together, and last the file that is part of most objects. These are
# compiled anew for each of its faults, and once more when the next file's turn comes.
by_cost() {
  local line
  ninja -C "$objects" -t deps >"$work/deps"
  while IFS= read -r line; do
    split "$line"
    printf '%4d %s|%s\n' "$(grep -cF -e "/${field[1]:-}" "$work/deps")" "${field[1]:-}" "$line"
  done <"$work/faults" | LC_ALL=C sort -s -t '|' -k 1,1 | cut -d '|' -f 2-
}

mkdir -p -- "$tree"
copy_source
configure >"$work/build.log"
grep -v -e '^#' -e '^$' "$root/tests/planted_faults.txt" | grep -F -e "${1:-}" >"$work/faults"

printf '%-44s %-52s %s\n' fault "to be caught by" verdict
build all || { tail -n 20 "$work/build.log"; exit 1; }   # the tests, whose build is the program's too
sed 's/.* | //' "$work/faults" | sort -u >"$work/checks"
while IFS= read -r name; do
  if check "$name"; then row none "$name" fine; else row none "$name" "FAILED without a fault"; fi
done <"$work/checks"

by_cost >"$work/in_order"
while IFS= read -r line; do
  split "$line"
  if ((${#field[@]} == 5)); then
    row "${field[0]}" "${field[4]}" "$(verdict "${field[@]:1}")"
  else
    row "$line" "" "MISSED: ${#field[@]} fields instead of 5"
  fi
done <"$work/in_order"

echo "$passed passed, $failed failed"
((failed == 0))
