#!/usr/bin/env bash
# A small demo, made in the window alone: from a template, by adding, dragging, colours, a light, a flight, and a film;
# with real keys and mouse on a virtual display.
#
#   tests/window/from_nothing.sh STRAHL [FOLDER]
#
# With FOLDER it writes the pictures of that, from_nothing.jpg, and the scene, demo.rt, there.
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
[[ -z ${2-} ]] || set -- "$1" "$(readlink -f -- "$2")"
own_display 960x720 "import montage" "$@"
folder=${2-}
mkdir bin
printf '#!/bin/sh\nexit 127\n' | tee bin/zenity >bin/kdialog
printf '#!/usr/bin/env bash\nfile=${!#}\nexec cat >"${file#file:}"\n' >bin/ffmpeg
chmod +x bin/*
export PATH=$work/bin:$PATH

# shot NAME: keeps what the window shows, for the pictures.
shot() {
    [[ -z $folder ]] || { sleep 7 && import -window "$id" "$1.png"; }
}
# add ROW X Y: adds what this row of the list has where the view is clicked.
add() {
    xdotool sleep 1 key ctrl+a sleep 0.4 mousemove --window "$id" 84 $((266 + 26 * $1)) sleep 0.2 click 1 sleep 0.3
    xdotool mousemove --window "$id" "$2" "$3" sleep 0.2 click 1
    await 'added'
    xdotool sleep 0.6
}
# type_at X Y NUMBER: types it into a field of the panel.
type_at() {
    xdotool mousemove --window "$id" "$1" "$2" sleep 0.2 keydown Control_L sleep 0.1 mousedown 1 sleep 0.2 mouseup 1
    xdotool sleep 0.2 keyup Control_L sleep 0.2 type --delay 30 -- "$3"
    xdotool sleep 0.2 keydown Return sleep 0.3 keyup Return sleep 0.2 # a panel misses what is shorter than a picture
}
# color Y RED GREEN BLUE: types a colour.
color() {
    type_at 716 "$1" "$2"
    type_at 769 "$1" "$3"
    type_at 822 "$1" "$4"
}
# drag X Y DX DY: drags from there, in two steps and by round distances.
drag() {
    xdotool mousemove --window "$id" "$1" "$2" sleep 0.2 mousedown 1 sleep 0.2 keydown Control_L
    xdotool mousemove_relative -- "$3" "$4" sleep 0.2 mousemove_relative -- "$3" "$4" sleep 0.2 mouseup 1
    xdotool keyup Control_L sleep 0.4
}
# hold KEY SECONDS
hold() {
    xdotool keydown "$1" sleep "$2" keyup "$1"
    await 'rest after'
}

echo "-- an empty floor, of the gallery"
start_log 'gallery of' view --size 960x720
shot 1
xdotool key Return
await 'a new scene: untitled.rt'
await 'finished'

echo "-- a ball: added, made larger, lifted by its arrow, and red"
add 0 430 470
type_at 780 124 1.2
drag 429 358 0 -29
color 176 .85 .12 .1
type_at 780 202 .25
shot 2

echo "-- a ring and a cone"
add 4 250 560
type_at 716 98 -.61
type_at 769 98 -.03
type_at 780 150 1.7
color 228 .95 .7 .25
type_at 780 254 .3
shot 3
add 3 520 330
color 228 .2 .4 .75

echo "-- a spotlight, whose mark is shown"
add 8 330 640
shot 4

echo "-- a flight around it, on the timeline"
xdotool mousemove --window "$id" 480 20 click 1 key l Tab p
await 'key 1 added'
hold a 0.4
xdotool key p
await 'key 2 added'
hold a 0.4
hold w 0.3
xdotool key p t
await 'key 3 added'
shot 5

echo "-- written, and filmed"
xdotool key F2
await 'path and changes written into untitled.rt'
xdotool key ctrl+F12
await 'a film of the flight is being made'
shot 6
cp untitled.rt demo.rt
xdotool key ctrl+F12
await ' ended ' # perhaps before its first frame
quit
"$strahl" check demo.rt >checked || fault "the scene has errors: $(<checked)"
cat demo.rt
[[ -z $folder ]] || {
    montage [1-6].png -resize 400x300 -tile 3x2 -geometry +2+2 -strip -quality 80 "$folder/from_nothing.jpg"
    cp demo.rt "$folder"
}
finish
