#!/usr/bin/env bash
# Bodies and lights are dragged by their handles, copied and removed in the text; with real keys and mouse on a virtual
# display.
#
#   tests/window/drag.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 640x400 "import convert" "$@"

# has_color COLOR: puts the place in the middle of the upper edge of this colour, left of the panel, into x and y.
has_color() {
    local found width
    read -r found width x y < <(convert shot.png -crop 340x400+0+0 +repage -fill black +opaque "#$1" \
        -format '%[fx:maxima>0] %@\n' info: | tr 'x+' '  ' | cut -d' ' -f1,2,4,5)
    [[ $found == 1 ]] && x=$((x + width / 2))
}
lacks_color() { ! has_color "$1"; }
find_color() { becomes has_color "$1" || fault "there is nothing of this colour: $1"; }

put "$camera" 'light { position <-5, 0, 10>  color <.9, .9, .9> }' 'light { position <-3, -3, .5>  color <.2, 0, .2> }' \
    'sphere { <-2, 0, 1>, 1 }  // the ball' \
    'box { <-4, 1, 0>, <-3, 2, 1>' '  material { rgb <.2, .6, .2> } }' 'plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }'
cp scene.rt first.rt
start scene.rt --size 640x400 --depth 2

echo "-- a click on a handle chooses what is behind it"
xdotool mousemove --window "$id" 212 140 click 1
await 'chosen: body 1, sphere, line 4'
find_color FFFFFF
xdotool click 1
await 'chosen: body 3, plane, line 7'

echo "-- a ball is dragged upwards along its axis, by round distances with Ctrl, and written in place; undone at once"
xdotool mousemove --window "$id" 186 160 click 1
await 'chosen: body 1, sphere, line 4'
find_color 5A8CFF
drag "$x" "$y" 0 -20
writes '^sphere { <-2, 0, [1-3]\.[0-9]*>, 1 }  // the ball$'
[[ $(diff first.rt scene.rt | grep -c '^<') == 1 ]] || fault "more than a line has changed: $(diff first.rt scene.rt)"
xdotool key ctrl+z
await 'undone'
writes '^sphere { <-2, 0, 1>, 1 }  // the ball$'
cmp first.rt scene.rt || fault "undone is not the file as it was"
find_color 5A8CFF
xdotool keydown Control_L
drag "$x" "$y" 0 -20
xdotool keyup Control_L
writes '^sphere { <-2, 0, [1-3](\.[1-9])?>, 1 }  // the ball$'
xdotool key ctrl+z
await 'undone'
await 'the changed text is shown'

echo "-- it is copied and written at once, and the copy removed"
xdotool key --delay 1 ctrl+d F2
await 'body 1 copied'
written '^sphere { <-2, 0, 1>, 1 }$'
[[ $(wc -l <scene.rt) == 8 ]] || fault "not one line more: $(<scene.rt)"
xdotool key Delete
await 'body 2 removed; Ctrl+Z brings it back'
writes '^sphere'
cmp first.rt scene.rt || fault "removed is not the file as it was"

echo "-- a light is shown, chosen and dragged across the view"
xdotool key l
await 'lights are shown'
find_color FF00FF
xdotool mousemove --window "$id" "$x" "$((y + 3))" click 1
await 'chosen: light 2, light, line 3'
drag "$x" "$((y + 3))" 20 -10
writes '^light { position <-[12]\.[0-9]*, -[0-9.]*, [0-9.]*>  color <.2, 0, .2> }$'
[[ $(diff first.rt scene.rt | grep -c '^<') == 1 ]] || fault "more than a line has changed: $(diff first.rt scene.rt)"

echo "-- a cone is chosen from a list and added where a click meets the floor; undone at once"
cp scene.rt before.rt
xdotool key ctrl+a mousemove --window "$id" 50 178 click 1
xdotool mousemove --window "$id" 300 320 click 1
await 'cone added'
writes '^cone { <0, 0, -[0-9.]*>, [0-9.]*, <0, 0, [0-9.]*>, 0  material { rgb <.8, .8, .8> .* }  translate <[-0-9., ]*> }$'
[[ $(diff before.rt scene.rt | grep -c '^[<>]') == 1 ]] || fault "more than a line: $(diff before.rt scene.rt)"
xdotool key ctrl+z
await 'undone'
writes '^sphere'
cmp before.rt scene.rt || fault "undone is not the file as it was"

echo "-- the outline chooses a body, and hides another one, so that clicks meet what is behind"
xdotool key o mousemove --window "$id" 150 120 click 1
await 'chosen: body 2, box, line 5'
xdotool mousemove --window "$id" 30 106 click 1 key o mousemove --window "$id" 186 160 click 1
await 'chosen: body 3, plane, line 7'
quit

echo "-- the cone of a spotlight is opened by its circle"
put "$camera" 'light { position <0, 0, 9>  color <.9, .9, .9>  spot { look_at <0, 0, 0>  radius 5  falloff 9 } }' \
    'plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }'
start scene.rt --size 640x400 --depth 2
xdotool key l
await 'lights are shown'
xdotool mousemove --window "$id" 320 200 click 1
await 'chosen: light 1, spotlight, line 2'
xdotool key m m
await 'circles open and close the cone of light'
# The handles that were there before have a ring of the other colour as well.
becomes lacks_color 5A8CFF || fault "the handles of before stay"
find_color 6EDC50 # the inner circle, which stays within the outer one
drag "$x" "$y" 0 -60
writes '^light .* spot { look_at <0, 0, 0>  radius 9  falloff 9 } }$'
quit

echo "-- a number that stands in a .pov scene is typed, and written in place"
printf '%s\n' '#declare R = 1;' 'camera { location <0, 0, -6> look_at 0 } light_source { -9, 1 }' \
    'sphere { 0, R*2 pigment { rgb <1, 0, 0> } finish { phong .5 } } // mine' >ball.pov
cp ball.pov before.pov
start ball.pov --size 640x400
xdotool mousemove --window "$id" 250 200 click 1
await 'chosen: body 1, sphere, line 3'
xdotool mousemove --window "$id" 480 183 click --repeat 2 1 type .75
xdotool key Return
await 'the changed text is shown'
xdotool mousemove --window "$id" 100 300 key F2
await 'changes written into ball.pov'
[[ $(diff before.pov ball.pov | grep '^>') == '> sphere { 0, R*2 pigment { rgb <1, 0, 0> } finish { phong 0.75 } } // mine' ]] ||
    fault "the .pov: $(diff before.pov ball.pov)"
quit
finish
