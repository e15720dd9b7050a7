#!/bin/sh
# SPDX-License-Identifier: MIT
# Opens the real window on the display there is, as a person would: flips the pictures, zooms in, closes it by Escape.
# usage: open_window.sh PROGRAM SCENE PICTURE; the exit code is the program's, 99 where no window came up. Writes what
# the window showed to PICTURE (a portable pixmap).
"$1" view "$2" -q -r 160x120 &
program=$!
window=$(timeout 120 xdotool search --sync --onlyvisible --name '^sidelight' | head -n 1)
if [ -z "$window" ]; then
  kill "$program"
  exit 99
fi
xdotool windowfocus "$window" mousemove --window "$window" 200 200 click 4 key space
sleep 1
xwd -silent -id "$window" -out "$3"
xdotool key Escape
wait "$program"
