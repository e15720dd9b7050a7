#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of tests/hardcases/README.md. See --help. tests/viewer/commands/test_walk_pictures.cpp compares them
# with what the program makes now.
set -euo pipefail

usage() {
  cat <<'END'
usage: tests/hardcases/make_pictures.sh [--program FILE] [-o DIR] [NAME]...

Makes the pictures of tests/hardcases/README.md anew: for each scene NAME of scenes/hard what goes wrong the usual way,
NAME-usual.png, and what sidelight shows, NAME-right.png. The same program makes the same bytes.

  --program FILE   the sidelight to use; default: that of build/release, else of build/demo
  -o DIR           where to write; default: tests/hardcases/pictures
  NAME...          only these scenes (snap-bits ...); default: all
END
}

root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd)"
out="$root/tests/hardcases/pictures"
source "$root/scenes/picture_options.sh"
if ((${#names[@]} == 0)); then
  for scene in scenes/hard/*.toml; do names+=("$(basename -- "$scene" .toml)"); done
fi
mkdir -p -- "$out"

# picture SUFFIX [FLAG]...
picture() { "$program" render "scenes/hard/$name.toml" -q -o "$out/$name-$1.png" "${@:2}"; }

small=(-r 320x240)
near=(-r 640x480 --crop 160,120,480,360)   # the middle, twice as large
for name in "${names[@]}"; do
  case $name in
    snap-bits)
      picture usual "${small[@]}" --renderer raster --snap-bits 0
      picture right "${small[@]}" --renderer raster ;;
    depth-format)
      picture usual "${small[@]}" --renderer raster --depth-format unorm16
      picture right "${small[@]}" --renderer raster ;;
    edge-on | precision)
      picture usual "${small[@]}" --precision float
      picture right "${small[@]}" ;;
    far-ball)
      picture usual "${small[@]}" --tessellate 64 --precision float
      picture right "${small[@]}" ;;
    shadow-offset)
      picture usual "${near[@]}" --shadow-offset 0
      picture usual-too "${near[@]}" --shadow-offset 0.3
      picture right "${near[@]}" ;;
    tessellate)
      picture usual "${small[@]}" --spp 4 --tessellate 16
      picture right "${small[@]}" --spp 4 ;;
    mirror-hall)
      picture usual "${small[@]}" --depth 6
      picture right "${small[@]}" ;;
    touching-glass)   # the flask in the middle, that on the left, that on the right
      picture usual -r 960x720 --crop 344,224,616,496
      picture right -r 960x720 --crop 60,224,332,496
      picture right-too -r 960x720 --crop 628,224,900,496 ;;
    *) picture right "${small[@]}" ;;
  esac
done
