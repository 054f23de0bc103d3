#!/usr/bin/env bash
# The lens and the shutter in the window: numbers of the camera's panel, a click that sets the focus, depth and normals
# with values under the pointer; with real keys and mouse on a virtual display.
#
#   tests/window/lens.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 960x540 import "$@"

# says NUMBER PATTERN: the values that the window logs for the pointer match.
says() { [[ $line =~ $1 ]] || fault "'$line' does not match $1"; }

put "${camera/fov 12/fov 20}" 'light { position <-5, 0, 10>  color <.9, .9, .9> }' 'sphere { <-3, 0, 3>, 1 }' \
    'plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }'
start scene.rt --size 480x270 --depth 2
await 'finished'

echo "-- a click chooses what is sharp; the camera gets a lens"
xdotool key j
await 'a click chooses what is sharp'
point 171 68
await 'in focus: <-2.'
await 'the changed text is shown'
await 'finished'
writes '^camera .* aperture 0\.[0-9]+  focus_on <-2\.[0-9]+, -0\.[0-9]+, 3\.[0-9]+> \}$'
still lens.png --size 480x270 --depth 2
xdotool key n
shows lens.png
xdotool key n

echo "-- another click moves the plane of focus; undo brings it back"
xdotool key j
await 'a click chooses what is sharp'
point 240 200
await 'in focus: <'
await 'the changed text is shown'
xdotool key ctrl+z
await 'undone: focus of the camera'
await 'the changed text is shown'
xdotool key F2
await 'nothing to write: scene.rt has all of it'

echo "-- Esc ends it, and a click chooses bodies again"
xdotool key j
await 'a click chooses what is sharp'
xdotool key Escape
point 171 68
await 'chosen: body 1, sphere'
xdotool key Escape

echo "-- depth and normals, and the values under the pointer"
xdotool key z
await 'at the right: depth'
await 'second picture: depth'
xdotool mousemove --window "$id" 300 200
await 'pointed at: '
says 'pointed at: [0-9.]+ away, normal <0, 0, 1>, at <[-0-9.]+, [-0-9.]+, [-0-9e.]+>'
xdotool key shift+z
await 'second picture: normals'
xdotool key shift+z
await 'one picture'
quit

echo "-- the camera of a .pov gets a lens in the window alone"
printf '%s\n' 'camera { location <0, 2, -10> look_at <0, 1, 0> right x*16/9 up y angle 40 }' \
    'light_source { <-5, 10, -10> rgb 1 }' 'plane { y, 0 pigment { rgb .5 } }' \
    'sphere { <0, 1, 0>, 1 pigment { rgb <.9, .2, .1> } }' >scene.pov
cp scene.pov before.pov
start scene.pov --size 480x270 --depth 2
await 'finished'
xdotool key j
await 'a click chooses what is sharp'
point 240 135
await 'in focus: <'
await 'finished'
cmp -s scene.pov before.pov || fault 'the .pov was written'
quit
finish
