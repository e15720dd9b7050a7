#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Who watches the watchmen: compiles each fault of planted_faults.txt, links it into the tests or the program of the
# release build, and runs the check that must catch it. A fault that nobody catches is a failure, and so is one whose
# source text is no longer found exactly once, or a check that fails without any fault. Called by tests/run.sh --ci.
#
#   planted_faults.sh [TEXT]    only the faults whose line holds TEXT; default: all
#
# The source stays as it is: a changed file lies in a folder of its own, where the compiler looks first. Only what the
# renderers and the model make of it is compiled, by the commands of build/release; all else is taken from there, so no
# check has the fault in itself.
set -euo pipefail

root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)"
release="$root/build/release"
work="$root/build/planted_faults"   # a folder for each fault, and one for each check without any
scene="$root/tests/agreement/everything.toml"
declare -A programs=([compare]=viewer/sidelight [test]=tests/sidelight_tests)   # by the first word of a check

# Faults are put into what all instruction sets share, and checks run the widest that the machine has: the kernels of
# another one, a third of what a fault in their headers has to compile, stay without it.
spare=avx512
! grep -q avx512bw /proc/cpuinfo || spare=avx2

# The pictures and ray counts of the default tier: these checks run for a second each.
export SIDELIGHT_TIER=default

build_release() {
  cmake -S "$root" --preset release -D SIDELIGHT_TESTS=ON -D SIDELIGHT_TEST_CASES= --log-level=NOTICE &&
    cmake --build "$release" -j "$(nproc)" --target sidelight sidelight_tests
}

# The objects of the renderers and the model that are made of file $1, by their names in build/release.
objects_of() {
  awk -v file="/$1" '
    /^[^ ]/ { object = $0; sub(/: #deps .*/, "", object) }
    /^ / && substr($0, length($0) - length(file) + 1) == file { print object }' "$work/files_of_objects" |
    grep -E '/sidelight_(common|raster|raytrace)\.dir/' | grep -v "/kernels_$spare\.cpp\.o$"
}

# Compiles object $2 in folder $1, with the changed file there.
compile() {
  local command file source="$root"
  command="$(ninja -C "$release" -t commands -s "$2")"
  command=${command%% -MD *}   # the names of files follow
  command=${command/" -I"/" -I'$1' -I"}
  file=${2/"CMakeFiles/"*".dir/"/}   # of raytrace/CMakeFiles/sidelight_raytrace.dir/wave.cpp.o
  file=${file%.o}
  [[ ! -e $1/$file ]] || source=$1
  (cd -- "$release" && bash -c "$command -o '$1/${file//\//_}.o' -c '$source/$file'")
}

# Links program $2 in folder $1, whose objects come before the libraries that hold them, too.
link() {
  local command
  command="$(ninja -C "$release" -t commands -s "$2" | tail -n 1)"
  command=${command#": && "}
  command=${command%%" && "*}   # what is done with the program follows
  command=${command/" -o $2 "/" '$1'/*.o -o '$1/program' "}
  (cd -- "$release" && bash -c "$command")
}

# Replaces text $3 of file $2 by $4 in folder $1; fails unless it stands there exactly once.
plant() {
  local text rest
  text="$(cat -- "$root/$2" && echo .)"   # the dot keeps the newlines at the end
  rest="${text#*"$3"}"
  [[ $rest != "$text" && $rest != *"$3"* ]] || return 1
  text="${text/"$3"/"$4"}"
  mkdir -p -- "$(dirname -- "$1/$2")"
  printf '%s' "${text%.}" >"$1/$2"
}

# Runs check $3 by program $2 in folder $1; the exit code is 0 where all is well, 1 where a fault was caught, anything
# else where the check itself broke down.
check() {
  case $3 in
    compare) "$2" compare "$scene" -q -o "$1/out" ;;
    "test "*) "$2" --minimal --abort-after=1 --test-case="${3#test }" ;;
    *) echo "unknown check: $3"; return 2 ;;
  esac >"$1/check.log" 2>&1
}

# Judges, in folder $1, fault $2 in file $3, text $4, replacement $5, by check $6.
judge() {
  local code=0 object program="${programs[${6%% *}]:-no program}"
  plant "$1" "$3" "$4" "$5" || { row "$2" "$6" "MISSED: the source text is not there exactly once"; return; }
  for object in $(objects_of "$3"); do
    compile "$1" "$object" || { code=$?; break; }
  done >"$1/build.log" 2>&1
  if ((code != 0)) || ! link "$1" "$program" >>"$1/build.log" 2>&1; then
    row "$2" "$6" "MISSED: does not build: $(grep -m1 error: "$1/build.log")"
    return
  fi
  check "$1" "$1/program" "$6" || code=$?
  case $code in
    1) row "$2" "$6" caught ;;
    0) row "$2" "$6" "MISSED: the check saw nothing" ;;
    *) row "$2" "$6" "MISSED: the check broke down with code $code: $(tail -n 1 "$1/check.log")" ;;
  esac
  rm -f -- "$1/program"   # 80 MB
}

# Whether check $2 is content, in folder $1, with what has no fault.
judge_sound() {
  local program="${programs[${2%% *}]:-no program}"
  if check "$1" "$release/$program" "$2"; then row none "$2" fine; else row none "$2" "FAILED without a fault"; fi
}

row() { printf '%-44s %-52s %s\n' "$@" | tee -a -- "$work/rows"; }

# Splits a line of the list at " | " into the array `field`.
split() {
  local rest="$1 | "
  field=()
  while [[ -n $rest ]]; do
    field+=("${rest%%" | "*}")
    rest="${rest#*" | "}"
  done
}

# Runs $2 in a new folder, with that and what follows as arguments, beside others: as many as there are cores.
started=0
beside() {
  local function=$1 folder="$work/$started"
  shift
  while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n || true; done
  mkdir -- "$folder"
  "$function" "$folder" "$@" &
  started=$((started + 1))
}

rm -rf -- "$work"
mkdir -p -- "$work"
trap 'kill $(jobs -p) 2>/dev/null || true' EXIT
build_release >"$work/build.log" 2>&1 || { tail -n 20 "$work/build.log"; exit 1; }
ninja -C "$release" -t deps >"$work/files_of_objects"
grep -v -e '^#' -e '^$' "$root/tests/planted_faults.txt" | grep -F -e "${1:-}" >"$work/faults"
sed 's/.* | //' "$work/faults" | sort -u >"$work/checks"

printf '%-44s %-52s %s\n' fault "to be caught by" verdict | tee -- "$work/rows"
# What takes longest first, so that all cores have work to the end.
while IFS= read -r line; do
  split "$line"
  printf '%d %s\n' "$(objects_of "${field[1]:-}" | wc -l)" "$line"
done <"$work/faults" | sort -srn -k 1,1 | cut -d ' ' -f 2- >"$work/order"
while IFS= read -r line; do
  split "$line"
  if ((${#field[@]} == 5)); then
    beside judge "${field[@]}"
  else
    row "$line" "" "MISSED: ${#field[@]} fields instead of 5"
  fi
done <"$work/order"
while IFS= read -r name; do beside judge_sound "$name"; done <"$work/checks"
wait

passed="$(grep -cE ' (caught|fine)$' "$work/rows")" || true
failed=$(($(cat -- "$work/faults" "$work/checks" | wc -l) - passed))   # one that says nothing, too
echo "$passed passed, $failed failed"
((failed == 0))
