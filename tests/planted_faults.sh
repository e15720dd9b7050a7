#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Who watches the watchmen: puts each fault of planted_faults.txt into a copy of the source, builds it, and runs the
# check that must catch it. A fault that nobody catches is a failure, and so is one whose source text is no longer
# found exactly once, or a check that fails without any fault. Called by tests/run.sh --ci.
#
#   planted_faults.sh [TEXT]    only the faults whose line holds TEXT; default: all
#
# The copy lives in build/planted_faults and keeps its objects, so a second run builds the changed files only. What is
# not of the libraries that faults are put into, the program `sidelight` but for them, is taken from build/release.
set -euo pipefail

root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)"
work="$root/build/planted_faults"
tree="$work/tree"
objects="$work/objects"
sound="$work/sound"         # the objects without any fault
release="$root/build/release"
libraries=(common raster raytrace)   # that faults are put into
programs="$work/programs"   # what is judged, while the next fault is built
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
    [[ $file != */kernels_$spare.cpp ]] || continue
    cmp -s -- "$root/$file" "$tree/$file" && continue
    mkdir -p -- "$(dirname -- "$tree/$file")"
    cp -- "$root/$file" "$tree/$file"
  done <"$work/files"
  (cd -- "$tree" && find . -type f -printf '%P\n') | sort | comm -13 "$work/files" - |
    while IFS= read -r file; do rm -- "$tree/$file"; done
}

# Faults are put into what all instruction sets share, and checks run the widest that the machine has: the kernels of
# another one, a third of what a fault in their headers has to build, are the scalar ones in the copy.
spare=avx512
! grep -q avx512bw /proc/cpuinfo || spare=avx2
spare_kernels() {
  local folder text
  for folder in common/model raster raytrace; do
    text="#include \"$folder/kernels.h\"
$(sed -nE "/^(namespace|}  \/\/ namespace)/p; s/^(const .*& (.*))_$spare\(\) \{/\1_$spare() { return \2_scalar(); }/p" \
      "$root/$folder/kernels_$spare.cpp")"
    [[ -e $tree/$folder/kernels_$spare.cpp ]] || printf '%s\n' "$text" >"$tree/$folder/kernels_$spare.cpp"
  done
}

# Little optimisation, and the pictures and ray counts of the default tier: these builds run for a second each.
export SIDELIGHT_TIER=default
configure() {
  cmake -S "$tree" -B "$objects" -G Ninja -D CMAKE_BUILD_TYPE=Planted -D CMAKE_CXX_FLAGS_PLANTED=-O1 \
    -D SIDELIGHT_TESTS=ON -D SIDELIGHT_TESTS_OF_PROGRAM=OFF --log-level=NOTICE
}

# What check $1 runs, and no more, is built and set aside.
build() {
  local targets=(sidelight_tests)
  [[ $1 != compare ]] || targets=("${libraries[@]/#/sidelight_}")
  cmake --build "$objects" -j "$(nproc)" --target "${targets[@]}" >"$work/build.log" 2>&1 || return
  finish   # the check before, which runs what was set aside
  if [[ $1 == compare ]]; then
    (cd -- "$release" && bash -c "$link") >"$work/build.log" 2>&1   # of link_command
  else
    cp -- "$objects/tests/sidelight_tests" "$programs"
  fi
}

# The command that links the release program, but for the libraries that faults are put into, which are the copy's.
link_command() {
  local command library
  cmake -S "$root" --preset release --log-level=NOTICE || return
  cmake --build "$release" -j "$(nproc)" --target sidelight || return
  command="$(ninja -C "$release" -t commands -s viewer/sidelight | tail -n 1)"
  command=${command/"-o viewer/sidelight"/"-o '$programs/sidelight'"}
  for library in "${libraries[@]}"; do
    command=${command//" $library/libsidelight_$library.a"/" '$objects/$library/libsidelight_$library.a'"}
  done
  link=$command
}

# Runs a check; its exit code is 0 where all is well, 1 where a fault was caught, anything else where the check itself
# broke down.
check() {
  local code=0
  case $1 in
    compare) "$programs/sidelight" compare "$scene" -q -o "$work/out" || code=$? ;;
    "test "*) "$programs/sidelight_tests" --minimal --abort-after=1 --test-case="${1#test }" || code=$? ;;
    *) echo "unknown check: $1"; code=2 ;;
  esac >"$work/check.log" 2>&1
  return "$code"
}

# Replaces text $2 of file $1 by $3, and keeps the whole file beside it; fails unless it stands there exactly once.
plant() {
  local text rest
  text="$(cat -- "$1" && echo .)"   # the dot keeps the newlines at the end
  rest="${text#*"$2"}"
  [[ $rest != "$text" && $rest != *"$2"* ]] || return 1
  cp -p -- "$1" "$1.whole"
  text="${text/"$2"/"$3"}"
  printf '%s' "${text%.}" >"$1"
}

# Undoes what was planted in file $1, and what was built since, times included: nothing has to be built anew. The source
# comes last, since one that differs is what tells the next run that an interrupted one left faulty objects.
restore() {
  local file
  find "$objects" -type f -newer "$work/built" -printf '%P\n' | while IFS= read -r file; do
    cp -p --remove-destination -- "$sound/$file" "$objects/$file" 2>/dev/null || rm -- "$objects/$file"
  done
  mv -- "$1.whole" "$1"
}

# Plants fault $1 in file $2, text $3, replacement $4, and starts check $5, whose end and verdict `finish` waits for.
start() {
  local file="$tree/$2" built=
  plant "$file" "$3" "$4" || { finish; row "$1" "$5" "MISSED: the source text is not there exactly once"; return; }
  build "$5" && built=1
  restore "$file"
  if [[ $built ]]; then
    check "$5" &
    running=("$!" "$1" "$5")
  else
    finish
    row "$1" "$5" "MISSED: does not build: $(grep -m1 error: "$work/build.log")"
  fi
}

running=()   # the process of a check, its fault and its name
finish() {
  local code=0 verdict
  ((${#running[@]} > 0)) || return 0
  wait "${running[0]}" || code=$?
  case $code in
    1) verdict=caught ;;
    0) verdict="MISSED: the check saw nothing" ;;
    *) verdict="MISSED: the check broke down with code $code: $(tail -n 1 "$work/check.log")" ;;
  esac
  row "${running[1]}" "${running[2]}" "$verdict"
  running=()
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

mkdir -p -- "$tree" "$programs"
copy_source
spare_kernels
{ configure && link_command; } >"$work/build.log" || { tail -n 20 "$work/build.log"; exit 1; }
grep -v -e '^#' -e '^$' "$root/tests/planted_faults.txt" | grep -F -e "${1:-}" >"$work/faults"

printf '%-44s %-52s %s\n' fault "to be caught by" verdict
sed 's/.* | //' "$work/faults" | sort -u >"$work/checks"
for name in compare test; do
  build "$name" || { tail -n 20 "$work/build.log"; exit 1; }
done
rm -rf -- "$sound" && cp -a -- "$objects" "$sound" && touch -- "$work/built"
while IFS= read -r name; do
  if check "$name"; then row none "$name" fine; else row none "$name" "FAILED without a fault"; fi
done <"$work/checks"

while IFS= read -r line; do
  split "$line"
  if ((${#field[@]} == 5)); then
    start "${field[@]}"
  else
    row "$line" "" "MISSED: ${#field[@]} fields instead of 5"
  fi
done <"$work/faults"
finish

echo "$passed passed, $failed failed"
((failed == 0))
