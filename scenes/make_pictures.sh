#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of scenes/README.md. See --help. tests/viewer/commands/test_walk_pictures.cpp compares them
# with what the program makes now.
set -euo pipefail

usage() {
  cat <<'END'
usage: scenes/make_pictures.sh [--program FILE] [-o DIR] [NAME]...

Makes the pictures of scenes/README.md anew: for each scene NAME-raster.png, NAME-raytrace.png and, where the two
differ, NAME-causes.png. The same program makes the same bytes.

  --program FILE   the sidelight to use; default: that of build/release, else of build/demo
  -o DIR           where to write; default: scenes/pictures
  NAME...          only these scenes (06-shadows ...); default: all
END
}

root="$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)"
out="$root/scenes/pictures"
source "$root/scenes/picture_options.sh"
if ((${#names[@]} == 0)); then
  for scene in scenes/*.toml; do names+=("$(basename -- "$scene" .toml)"); done
fi

mkdir -p -- "$out"
made="$(mktemp -d)"
trap 'rm -rf -- "$made"' EXIT
look=(-r 320x240 --spp 4 -q)

for name in "${names[@]}"; do
  scene="scenes/$name.toml"
  "$program" compare "$scene" "${look[@]}" --no-times -o "$made"
  mv -- "$made/raster.png" "$out/$name-raster.png"
  mv -- "$made/raytrace.png" "$out/$name-raytrace.png"
  # Where nothing differs, the map of causes is black and says nothing.
  grep -q '"psnr": null' "$made/compare.json" || mv -- "$made/causes.png" "$out/$name-causes.png"
  if [[ $name == 07-mirrors ]]; then   # one ray more along a path, one image more
    for depth in 1 2 3; do
      "$program" render "$scene" "${look[@]}" --depth "$depth" -o "$out/$name-depth-$depth.png"
    done
  fi
done
