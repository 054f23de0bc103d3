#!/usr/bin/env bash
# Two pictures beside each other: POV-Ray's and the window's own, their difference, the divider, exposure; with real keys
# and a real pointer on a virtual display.
#
#   tests/window/beside.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 800x400 "import compare convert povray" "$@"
export TMPDIR=$work/temporary
mkdir "$TMPDIR"

# part X: part.png is a part of the window's picture, shot.png, from this column on.
part() {
    convert shot.png -crop "40x100+$1+0" +repage part.png
}
# is_black X: is that part black but for some pixels on edges?
is_black() {
    part "$1"
    bright=$(convert part.png -threshold 12% -format '%[fx:mean*w*h]' info:)
    ((${bright%.*} < 40))
}
black() { becomes is_black "$1" || fault "at $1 $bright pixels are not black"; }
# is_divided: does the window differ from first.png in the line, and in some pixels on edges?
is_divided() {
    different=$(compare -metric AE -fuzz 10% shot.png first.png null: 2>&1)
    ((different > 150 && different < 600))
}

echo "-- POV-Ray's picture at the right, and the difference"
put "$camera" "$world"
start scene.rt --size 160x120
await 'finished 160x120'
still first.png --size 160x120
xdotool key n
shows first.png
xdotool key g
await 'at the right: POV-Ray'
await 'smooth edges follow'
await 'second picture: POV-Ray, '
[[ ${line#*POV-Ray, } == [0-9]' pixels'* ]] || fault "the pictures differ: $line"
becomes is_divided || fault "$different pixels differ from Strahl's picture"
xdotool key shift+g
await '16 times the difference'
black 100

echo "-- the divider is dragged, and the camera stays"
xdotool mousemove --window "$id" 80 40 mousedown 1 mousemove_relative -- -20 5 mousemove_relative -- -40 5 mouseup 1
black 30
xdotool mousemove --window "$id" 20 60 mousedown 1 mousemove_relative 90 0 mouseup 1 key c
await 'camera copied'
await 'look_at <0, 0, 0>'
import -window "$id" shot.png
part 30
cmp -s <(convert part.png rgb:-) <(convert first.png -crop 40x100+30+0 +repage rgb:-) ||
    fault "left of the divider is not Strahl's picture"

echo "-- another view ends POV-Ray; a view that was seen before is kept"
xdotool key w
await 'rest after'
xdotool key r
await "the scene's camera"
await 'finished'
black 120
xdotool key g
await 'second picture: one ray'
xdotool key g
await 'second picture: long double'
echo "-- what was shown in motion, and what the camera of the flight sees"
xdotool key shift+g g
await 'at the right: in motion'
for ((i = 0; i < 20; ++i)); do # until a picture in motion is seen before it is finished
    import -window "$id" before.png
    xdotool keydown w
    shows_other before.png
    xdotool keyup w
    await 'second picture: in motion, '
    [[ ${line#*motion, } == [1-9]*' pixels'* ]] && break
done
((i < 20)) || fault "it is the picture at rest: $line"
xdotool key g
await 'second picture: the camera of the flight'
xdotool key r
await 'finished'
xdotool key g
await 'one picture'
shows first.png
[[ ! $(ls "$TMPDIR") ]] || fault "files stay: $(ls "$TMPDIR")"

echo "-- exposure"
xdotool key plus plus minus
await 'exposure +0.5 stops'
still exposed.png --size 160x120 --exposure .5
shows exposed.png
xdotool key 0
await 'light as it is'
shows first.png
quit

echo "-- without povray its package is named"
built=$strahl
printf '#!/bin/sh\nPATH=/nowhere exec %q "$@"\n' "$strahl" >without
chmod +x without
strahl=$work/without
start scene.rt --size 160x120 --exposure 1
xdotool key g
await 'povray is not installed; on Debian: apt install povray'
quit

echo "-- a scene of POV-Ray's own, seen by another camera"
strahl=$built
printf '%s\n' '#version 3.7; global_settings { assumed_gamma 1 }' 'camera { location <1, 2, -6> look_at <0, .5, 0> }' \
    'light_source { <-5, 9, -3>, 1 } plane { y, 0 pigment { rgb <.3, .6, .2> } }' \
    'sphere { <.5, 1, 1>, 1 pigment { rgb <.9, .2, .1> } }' >scene.pov
start scene.pov --size 160x120
await 'finished'
xdotool key d
await 'rest after'
xdotool key g
await 'second picture: POV-Ray, '
[[ ${line#*POV-Ray, } == [0-9]' pixels'* ]] || fault "the pictures differ: $line"
quit
finish
