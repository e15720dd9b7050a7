#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# usage: tests/support/stand_ins.sh LIBRARY FOLDER
# Fills FOLDER with stand-ins for libraries that LIBRARY (OpenImageIO) brings for pictures that sidelight neither reads
# nor writes: those of films, cameras, medicine, phones and clouds, which bring 200 more. A stand-in has the library's
# name and what LIBRARY takes from it, functions that return 0 and that nobody calls but to set up and take down what is
# not used. Where LIBRARY was built without such a library there is nothing to stand in for.
#
# For -D SIDELIGHT_STAND_INS=ON (row stand_ins of tests/tiers.txt): loading them all is most of what a program takes that
# reads or writes a small picture, and the tests of one build start 600 of those.
set -euo pipefail
export LC_ALL=C   # join wants the order that sort makes

library="$1" folder="$2"
few='^lib(avcodec|avformat|avutil|dcmdata|dcmimage|dcmimgle|heif|ofstd|oflog|opencv_[a-z]*|openvdb|swscale)[.]so'

# The symbols of library $2 that nm calls $1, each with its version or a dash.
symbols() {
  nm -D "--$1" --with-symbol-versions "$2" |
    awk '{ n = split($NF, part, "@+"); print part[1], (n > 1 ? part[2] : "-") }' | sort -u
}

[[ ! $folder/done -nt $0 || ! $folder/done -nt $library ]] || exit 0
rm -rf -- "$folder"
mkdir -p -- "$folder"
symbols undefined-only "$library" | cut -d ' ' -f 1 >"$folder/wanted"
objdump -p "$library" | awk -v few="$few" '$1 == "NEEDED" && $2 ~ few { print $2 }' >"$folder/names"
ldd "$library" | awk 'FNR == NR { named[$1]; next } $1 in named && $2 == "=>" { print $1, $3 }' "$folder/names" - |
  while read -r name path; do
    symbols defined-only "$path" | join "$folder/wanted" - >"$folder/symbols"
    awk '{ of[$2] = of[$2] " " $1 ";" }
      END { for (version in of) print (version == "-" ? "" : version) " {" of[version] " };" }' \
      "$folder/symbols" >"$folder/versions"
    awk '{ print "int " $1 "(void) { return 0; }" }' "$folder/symbols" |
      cc -x c -w -fPIC -shared -nostdlib - -o "$folder/$name" \
        -Wl,-soname,"$name" -Wl,--version-script,"$folder/versions"
  done
touch -- "$folder/done"
