#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a fresh clone to two pictures of one scene and an account of their difference. See --help.
set -euo pipefail

usage() {
  cat <<'END'
usage: viewer/demo.sh [SCENE.toml] [-o DIR]

Renders one scene twice, with a z-buffer and with a ray tracer, and accounts for every pixel in which they differ.

  1. installs the Debian packages that are missing (asks for root only then)
  2. builds the program into build/demo
  3. writes both pictures, their difference, its causes and report.html, which explains them, into DIR
  4. opens the window, if there is a display

  SCENE.toml   default: scenes/showcase.toml
  -o DIR       default: out/ and the scene's name, at the top of the source tree
END
}

root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)"
scene="$root/scenes/showcase.toml"
out=""
while (($#)); do
  case $1 in
    -h | --help) usage; exit 0 ;;
    -o) out="${2:?-o needs a folder}"; shift ;;
    -*) usage >&2; exit 2 ;;
    *) scene=$1 ;;
  esac
  shift
done
out="${out:-$root/out/$(basename -- "$scene" .toml)}"

"$root/viewer/install_packages.sh" build

echo "building sidelight (the first time takes a few minutes)" >&2
cmake -S "$root" --preset demo --log-level=NOTICE >/dev/null
cmake --build "$root/build/demo" --target sidelight -j "$(nproc)" >&2
sidelight="$root/build/demo/viewer/sidelight"

mkdir -p -- "$(dirname -- "$out")"
"$sidelight" compare "$scene" -o "$out"

printf '\nWritten to %s:\n' "$out"
for file in "$out"/*; do echo "  $(basename -- "$file")"; done
echo "Open report.html first, in any browser: both pictures, why they differ, and each step from one to the other."

if [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
  echo "Opening the window: space flips the two pictures, Esc closes."
  "$sidelight" view "$scene" || (($? == 6))   # a display that does not answer is none
else
  printf 'No display, so no window; where there is one: %q view %q\n' "$sidelight" "$scene"
fi
