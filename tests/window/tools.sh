#!/usr/bin/env bash
# The toolbar, the panels of the camera and the background, several bodies at once, and bodies placed on surfaces and by
# numbers; with real keys and mouse on a virtual display.
#
#   tests/window/tools.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 960x540 import "$@"
rm state/strahl/no_toolbar

put "${camera/fov 12/fov 20}" 'light { position <-5, 0, 10>  color <.9, .9, .9> }' 'sphere { <-3, 0, 3>, 1 }' \
    'box { <1, -1, 0>, <3, 1, 2> }' 'plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }'
start scene.rt --size 960x540 --depth 2
await 'finished'

echo "-- the toolbar's buttons; the camera's numbers are typed"
point 332 31
await 'lights are shown'
point 332 31
await 'lights are hidden'
point 385 31
await 'chosen: the camera, perspective, line 1'
change 704 164 7
writes '^camera \{ position <7, -20, 18>  look_at <0, 0, 0>  up <0, 0, -1>  fov 20 \}$'

echo "-- a drag with Shift and the middle button moves across the view, which becomes the scene's camera"
xdotool mousemove --window "$id" 300 300 keydown Shift_L mousedown 2 mousemove_relative 50 0 mousemove_relative 50 0 \
    mouseup 2 keyup Shift_L
await 'rest after'
point 642 137
await "this view is the scene's camera now"
writes '^camera'
# The direction of view stays, and the camera is to the left of where it was, at the same height.
sed -nE 's/^camera \{ position <(.*)>  look_at <(.*)>  up.*/\1, \2/p' scene.rt | awk -F, '
    function is(value, wanted) { return value > wanted - .001 && value < wanted + .001 }
    { good = is($1 - $4, 7) && is($2 - $5, -20) && is($3 - $6, 18) && $4 < -.5 && is($6, 0) }
    END { exit !good }' || fault "the camera: $(head -n 1 scene.rt)"
xdotool key ctrl+z
await "undone: the scene's camera"
await 'the changed text is shown'

echo "-- the background, of which the text has no word yet"
xdotool key o
point 60 124
await 'chosen: the background'
change 701 126 .2
writes '^background \{ color <0.2, 0, 0> \}$'
xdotool key o Escape

echo "-- the panel does not cover the point that was clicked: one click at the right, and one where the panel would be"
point 900 450
await 'chosen: body 3, plane'
point 900 200
await 'chosen: body 3, plane'

echo "-- a number that makes an error is taken back, and nothing of it is written"
xdotool mousemove --window "$id" 150 227 keydown Control_L click 1 keyup Control_L
xdotool type --delay 1 -- 0
xdotool key Return
await 'invalid plane'
xdotool key F2
await 'nothing to write'
xdotool key Escape

echo "-- Shift chooses another body too; both are copied, and removed"
point 332 136
await 'chosen: body 1, sphere, line 4'
xdotool keydown Shift_L
point 530 262
xdotool keyup Shift_L
await 'chosen: body 2, box, line 5, the last of 2 bodies'
xdotool key ctrl+d
await '2 bodies copied'
await 'the last of 2 bodies'
xdotool key Delete
await '2 bodies removed'
await 'the changed text is shown'
await 'finished'

echo "-- with Shift a ball is dragged onto the floor under the pointer; then moved by a number"
point 332 136
await 'chosen: body 1, sphere, line 4'
xdotool mousemove --window "$id" 332 136 keydown Shift_L mousedown 1 mousemove_relative 10 80 mousemove_relative 10 80 \
    mouseup 1 keyup Shift_L
await 'the changed text is shown'
writes '^sphere \{ <-?[0-9.]+, -?[0-9.]+, 1>, 1 \}$'
before=$(sed -nE 's/^sphere \{ <([^,]*),.*/\1/p' scene.rt)
point 700 325
change 706 349 2
writes '^sphere \{ <-?[0-9.]+, -?[0-9.]+, 1>, 1 \}$'
after=$(sed -nE 's/^sphere \{ <([^,]*),.*/\1/p' scene.rt)
awk -v a="$before" -v b="$after" 'BEGIN { exit !(b - a > 1.999 && b - a < 2.001) }' || fault "from $before to $after"

echo "-- the toolbar is hidden, also the next time"
xdotool key Escape ctrl+t
still picture.png --size 960x540 --depth 2
shows picture.png
quit
start scene.rt --size 960x540 --depth 2
await 'finished'
shows picture.png
xdotool key ctrl+t
shows_other picture.png
quit
finish
