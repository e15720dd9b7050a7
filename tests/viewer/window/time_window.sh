#!/bin/sh
# SPDX-License-Identifier: MIT
# A minute of use of the real window, for its times: orbiting without a pause, with a rest now and then in which the ray
# tracer may finish, every mode, zoom and the inspector. Prints what --frame-log sums up, and keeps the log.
# usage: time_window.sh PROGRAM SCENE LOG.csv [SECONDS]; needs xvfb-run and xdotool, and an idle machine.
set -e
if [ "$5" != inside ]; then
  exec xvfb-run -a -s "-screen 0 1600x900x24" "$0" "$1" "$2" "$3" "${4:-60}" inside
fi
program=$1 scene=$2 log=$3 seconds=$4

"$program" view "$scene" -r 640x480 --frame-log "$log" &
id=$!
trap 'kill "$id" 2>/dev/null || true' EXIT
window=$(timeout 60 xdotool search --sync --onlyvisible --name '^sidelight' | head -n 1)
eval "$(xdotool getwindowgeometry --shell "$window")"
xdotool windowfocus "$window"
x=$((WIDTH / 4)) y=$((HEIGHT / 2))

# Five seconds of a drag there and back, 125 moves a second; then a second's rest.
orbit() {
  moves=
  for i in $(seq 300); do moves="$moves mousemove_relative -- 1 0 sleep 0.008"; done
  for i in $(seq 300); do moves="$moves mousemove_relative -- -1 0 sleep 0.008"; done
  xdotool mousemove --window "$window" "$x" "$y" mousedown 1 $moves mouseup 1
  sleep 1
}
# The mouse wheel zooms, a click inspects; Escape, z and 1 undo all that.
look() {
  for mode in 2 3 4 5 6 1; do xdotool key "$mode" sleep 0.3; done
  xdotool mousemove --window "$window" "$x" "$y" click 4 sleep 0.2 click 4 sleep 0.2 click 1 sleep 0.5
  xdotool key Escape key z key 1
  sleep 0.5
}
end=$(($(date +%s) + seconds))
while [ "$(date +%s)" -lt "$end" ]; do
  orbit
  look
done
xdotool key Escape
wait "$id"
trap - EXIT
