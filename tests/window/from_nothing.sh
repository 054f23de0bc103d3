#!/usr/bin/env bash
# A small demo, made in the window alone: from a template, by adding, dragging, colours, a light, a flight, the beat of
# music, and a film; with real keys and mouse on a virtual display.
#
#   tests/window/from_nothing.sh STRAHL [FOLDER]
#
# With FOLDER it writes the pictures of that, from_nothing.jpg, and the scene, untitled.rt with its tracks, there.
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
[[ -z ${2-} ]] || set -- "$1" "$(readlink -f -- "$2")"
own_display 960x720 "import compare convert montage" "$@"
folder=${2-}
mkdir bin
printf '#!/bin/sh\nexit 127\n' | tee bin/zenity >bin/kdialog
printf '#!/usr/bin/env bash\nfile=${!#}\nexec cat >"${file#file:}"\n' >bin/ffmpeg
chmod +x bin/*
export PATH=$work/bin:$PATH ALSOFT_DRIVERS=null

# shot NAME: keeps what the window shows, for the pictures, with the toolbar; by then its notes have disappeared.
shot() {
    [[ -z $folder ]] && return
    xdotool mousemove --window "$id" 480 90 key ctrl+t key 0
    await 'light as it is'
    await 'notes have disappeared'
    import -window "$id" "$1.png"
    xdotool key ctrl+t
    shows_other "$1.png"
}
# shot_gallery NAME: the same of the gallery, once it shows the pictures of all scenes.
shot_gallery() {
    [[ -z $folder ]] && return
    await 'the gallery shows all its pictures'
    import -window "$id" "$1.png"
}
# add ROW X Y: adds what this row of the list has where the view is clicked.
add() {
    xdotool key ctrl+a
    point 84 $((253 + 26 * $1))
    point "$2" "$3"
    await 'chosen'
}
# color Y RED GREEN BLUE: types a colour.
color() {
    change 754 "$1" "$2"
    change 808 "$1" "$3"
    change 861 "$1" "$4"
}
# drag_round X Y DX DY: drags by round distances.
drag_round() {
    xdotool keydown Control_L
    drag "$@"
    xdotool keyup Control_L
    await 'the changed text is shown'
}
# turn: turns the view by 0.4 radians around what is seen.
turn() {
    xdotool mousemove --window "$id" 300 20 mousedown 2 mousemove_relative 220 0 mousemove_relative 220 0 mouseup 2
    await 'rest after'
}
# follow X Y NAME BUTTON: the value with the button there follows a track of this name, by the button in the list that
# opens.
follow() {
    point "$1" "$2"
    xdotool type --delay 1 "$3"
    point "$4" $(($2 + 68))
    await "follows the track $3"
    await 'finished'
}
# way ROW: chooses this row of the list of ways to the next key.
way() {
    point 430 662
    point 430 $((574 + 20 * $1))
}

echo "-- an empty floor, of the gallery"
start_log 'gallery of' view --size 960x720
shot_gallery 1
xdotool key Return
await 'a new scene: untitled.rt'
await 'finished'

echo "-- a ball: added, made larger, lifted by its arrow, and red"
add 0 430 470
change 820 124 1.2
drag_round 429 358 0 -29
color 202 .85 .12 .1
change 820 228 .25
shot 2

echo "-- a ring and a cone"
add 4 250 560
change 758 202 -.61
change 819 202 -.03
change 820 150 1.7
color 254 .95 .7 .25
change 820 280 .3
add 3 560 320
color 254 .2 .4 .75
shot 3

echo "-- a spotlight, whose mark is shown"
add 9 330 640
shot 4

echo "-- a flight around it, on the timeline"
point 480 20
xdotool key l p
await 'key 1 added'
turn
xdotool key p
await 'key 2 added'
turn
xdotool click 4 click 4 key p t
await 'key 3 added'
shot 5

echo "-- music, and a ball that bounces on each beat"
cp "$here/../../scenes/beat.ogg" . # a person would bring music of their own
change 246 688 125
change 780 688 beat.ogg
point 420 400
await 'chosen: body 2'
follow 927 210 bounce 795
way 2
for _ in 1 2 3 4 5 6 7 8; do point 88 596 4; done
point 160 590
point 310 662 # set key
type_at 320 662 2.3
way 3
point 620 662
shot 6

echo "-- a light that flashes with it"
point 480 20
xdotool key Home l
await 'lights are shown'
point 318 299
await 'chosen: light 3'
follow 863 124 flash 885
point 87 546
type_at 320 662 1.3
point 222 565
point 310 662
type_at 320 662 .25
point 620 662
shot 7

echo "-- played, written, and filmed"
for _ in 1 2 3 4 5 6 7 8; do point 88 596 5; done
point 480 20
xdotool key l space
await 'flight continues'
[[ -z $folder ]] || { xdotool sleep 2 key space && await 'paused' && shot 8; }
xdotool key F2
await 'tracks saved: untitled.tracks'
await 'path and changes written into untitled.rt'
xdotool key ctrl+F12
await 'a film of the flight is being made'
shot 9
xdotool key ctrl+F12
await ' ended ' # perhaps before its first frame
quit
"$strahl" check untitled.rt >checked || fault "the scene has errors: $(<checked)"
grep -q '2 with keys' checked || fault "the tracks: $(<checked)"
has() { grep -qF -- "$1" untitled.rt || fault "no '$1' in $(<untitled.rt)"; }
has 'music { bpm 125  rows 8  sound "beat.ogg" }'
has 'sphere { <0, 0, 0>, 1.2  material { rgb <0.85, 0.12, 0.1>  reflection 0.25 '
has 'translate <-0.61, -0.03, track "bounce" 1.2> }'
has '1.7, 0.125  material { rgb <0.95, 0.7, 0.25>  reflection 0.3 '
has 'material { rgb <0.2, 0.4, 0.75> '
has 'color <track "flash" .9, track "flash" .9, track "flash" .9>  spot {'
(($(grep -c ' 2.3 ramp' untitled.tracks) == 12)) || fault "the track of the ball: $(<untitled.tracks)"
(($(grep -c ' 0.25 linear' untitled.tracks) == 12)) || fault "the track of the light: $(<untitled.tracks)"
[[ -z $folder ]] || {
    montage [1-9].png -resize 400x300 -tile 3x3 -geometry +2+2 -strip -quality 80 "$folder/from_nothing.jpg"
    cp untitled.rt untitled.tracks "$folder"
}
finish
