#!/bin/sh
# SPDX-License-Identifier: MIT
# Drives the real window on the display there is, as a person would, and writes what it shows after each step.
# usage: open_window.sh PROGRAM FOLDER; FOLDER holds scene.toml, broken.toml and edited.toml. The exit code is the
# program's, 99 where no window came up. Writes FOLDER/STEP.xwd (X window dumps).
program=$1
folder=$2
"$program" view "$folder/scene.toml" -q --no-times -r 160x120 &
id=$!
window=$(timeout 120 xdotool search --sync --onlyvisible --name '^sidelight' | head -n 1)
if [ -z "$window" ]; then
  kill "$id"
  exit 99
fi
eval "$(xdotool getwindowgeometry --shell "$window")"
xdotool windowfocus "$window"

# Writes what is shown once it is not what was shown before and has come to rest; gives up after a minute.
dump() { xwd -silent -id "$window" -out "$1"; }
touch "$folder/last"
show() {
  step=$1
  for try in $(seq 100); do
    dump "$folder/now"
    sleep 0.3
    dump "$folder/$step.xwd"
    if cmp -s "$folder/now" "$folder/$step.xwd" && ! cmp -s "$folder/last" "$folder/$step.xwd"; then break; fi
  done
  cp "$folder/$step.xwd" "$folder/last"
}
park() { xdotool mousemove --window "$window" 3 3; }   # where no picture is

park
show open
xdotool key 2
show swipe
xdotool key 5
show causes
xdotool key 1 mousemove --window "$window" $((WIDTH / 4)) $((HEIGHT / 2)) click 1
park
show inspect
xdotool key Escape
xdotool mousemove --window "$window" $((WIDTH / 4)) $((HEIGHT / 2)) mousedown 1
for x in 10 20 30 40 50; do xdotool mousemove --window "$window" $((WIDTH / 4 + x)) $((HEIGHT / 2)); done
xdotool mouseup 1
park
show orbit
xdotool key z
show reset
# A newer time than the first file's, however coarse the clock of the file system.
replace() { cp "$1" "$folder/scene.toml" && touch -d "$2 seconds" "$folder/scene.toml"; }
replace "$folder/broken.toml" +5
show error
replace "$folder/edited.toml" +9
show recovered
xdotool click 4 mousemove --window "$window" $((WIDTH / 4)) $((HEIGHT / 2)) click 4
park
show zoomed
xdotool key Escape
wait "$id"
