#!/usr/bin/env bash
# The window in use, besides flying: full screen, drags, signals, broken files; with real keys and mouse on a
# virtual display.
#
#   tests/window/hands.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 800x400 "import compare" "$@"

echo "-- a scene that is missing, then broken, is waited for"
start_log 'waiting until' scene.rt --size 320x240 --depth 2
put "shpere { }"
await 'scene.rt:1:1'
flat=${camera/fov 12/fov 12 aspectratio 2}
put "$flat" "$world" "$path"
await 'read again'
await 'finished 320x160'

echo "-- nobody has to wait for a pipe; what comes through it is shown, as from standard input"
[[ $(cat log) != *'finished 320x240'* ]] || fault "a picture of nothing was traced"
quit
printf '#declare i = 0;\n#while (1)\n#declare i = i + 1;\n#end\n' >long.rt
start_log 'reading long.rt' long.rt --size 320x240
xdotool key Escape
timeout 20 tail --pid="$pid" -f /dev/null || fault "the window closes only when the scene has been read"
quit
mkfifo pipe.rt
start_log 'reading pipe.rt' pipe.rt --size 320x240
quit
start_log 'reading pipe.rt' pipe.rt --size 320x240
cat scene.rt >pipe.rt
await 'finished 320x160'
quit
input=scene.rt start - --size 320x240
await 'finished 320x160'
quit
start scene.rt --size 320x240 --depth 2
await 'finished 320x160'

echo "-- the picture keeps its camera's proportions, or fills the window"
still picture.png --size 320x160 --depth 2
convert -size 320x240 xc:black picture.png -geometry +0+40 -composite bars.png
shows bars.png
xdotool key v
await 'finished 320x240'
put "$camera" "$world" "$path"
await 'read again'
await 'finished 320x240'
still filled.png --size 320x240 --depth 2
shows filled.png

echo "-- a click moves nothing, a drag from elsewhere only by its own length"
xdotool mousemove --window "$id" 10 10 mousedown 1 mousemove_relative 1 1 mouseup 1
await 'chosen: body 3, plane, line 5'
xdotool click 1 # again: nothing is behind it
xdotool key F11
await 'finished 800x400'
still full.png --size 800x400 --depth 2
shows full.png
xdotool mousemove --window "$id" 300 300 mousedown 1 mousemove_relative 1 0 mouseup 1 click 1 key c
await 'camera copied'
await 'look_at <0, 0, 0>'
xdotool key F11
await 'finished 320x240'

echo "-- the wheel with Ctrl while the path is flown"
xdotool key f
await 'flying from 0 s'
xdotool mousemove --window "$id" 100 100 keydown Control_L click 4 keyup Control_L
await 'flight at 1.25 times its speed'
xdotool key x
await 'rounding is checked in a picture at rest: Space pauses'

echo "-- F plays, whatever is paused or chosen; Esc ends the flight, then what is chosen"
xdotool key space
await 'paused at'
xdotool key f
await 'flying from'
xdotool key Escape
await 'flight ended'

echo "-- the number pad looks from the sides, the middle button turns around what is seen, B goes to what is chosen"
xdotool key r KP_7 c
await 'camera copied'
await 'position <0, -0.47'
xdotool mousemove --window "$id" 100 100 mousedown 2 mousemove_relative 40 0 mousemove_relative 40 0 mouseup 2 key c
await 'camera copied'
await 'look_at <0, 0, 0>'
xdotool key r
xdotool mousemove --window "$id" 100 100 click 1
await 'chosen: body'
xdotool key b f
await 'flying from'
xdotool key Escape Escape
await 'flight ended'

echo "-- a signal waits for stills, as Esc does; one that cannot be written is told at once"
xdotool key shift+F12
await 'still saved: scene'
[[ $line == *.png ]] || fault "with Shift a still is no .png: $line"
xdotool key F12
await 'still queued'
kill -TERM "$pid"
await 'interrupted'
wait "$pid"
(($? == 130)) || fault "after a signal the exit status is not 130"
(($(grep -cF 'still saved: ' log) == 2)) || fault "after a signal the still was not saved" # sometimes it is before
start_log "stills cannot be written into 'missing'" scene.rt --size 64x48 --still-folder missing --still-format png
await 'first picture'
xdotool key F12
await "stills cannot be written into 'missing'"
xdotool key Escape
wait "$pid"
(($? == 1)) || fault "a still was not written, and the exit status is not 1"
pid=

echo "-- another scene is chosen by the desktop's dialog, here a program that takes its place"
mkdir bin
printf '#!/bin/sh\necho %q\n' "$PWD/other.rt" >bin/zenity
chmod +x bin/zenity
printf '%s\n' "$camera" "$world" >other.rt
path_before=$PATH PATH=$PWD/bin:$PATH
start scene.rt --size 64x48
PATH=$path_before
xdotool key ctrl+o
await "opened $PWD/other.rt"
quit

echo "-- a flight becomes a film with the frames of strahl render; ended early, its first part stays, and Esc waits"
printf '#!/usr/bin/env bash\nfile=${!#}\nexec cat >"${file#file:}"\n' >bin/ffmpeg # the film is its stream of frames
chmod +x bin/ffmpeg
put "$camera" "$world" "${path//60/1}"
PATH=$PWD/bin:$PATH
start scene.rt --size 64x48
PATH=$path_before
xdotool key ctrl+F12
await 'film saved: scene-'
"$strahl" render scene.rt -o - --format y4m --frames 0-24 --size 64x48 >frames || fault "render of frames"
cmp frames "${line#*film saved: }" || fault "the film has other frames"
put "$camera" "$world" "${path//60/6000}"
await 'read again'
xdotool key ctrl+F12
await 'a film of the flight is being made: scene-'
until [[ -n $(find . -name '.strahl-*' -size +20k) ]] || ! kill -0 "$pid"; do sleep 0.05; done # two frames
xdotool key ctrl+F12
await 'film ended after'
[[ -s ${line##*: } && ${line##*: } == *.part.mp4 ]] || fault "there is no part of the film: $line"
put "$camera" "$world" "${path//60/1}"
await 'read again'
xdotool key ctrl+F12
await 'a film of the flight is being made'
quit
(($(grep -cF 'film saved' log) == 2)) || fault "the window did not wait for the film"
put "$camera" "$world" "${path//60/6000}"
PATH=$PWD/bin:$PATH
start scene.rt --size 64x48
PATH=$path_before
xdotool key ctrl+F12
await 'a film of the flight is being made'
xdotool key Escape
await 'waiting for the film'
xdotool key F12
await 'makes no more stills'
quit

echo "-- size and place are remembered"
is_placed() {
    geometry=$(xdotool getwindowgeometry --shell "$id" | tr '\n' ' ')
    [[ $geometry == *'X=30 Y=40 WIDTH=200 HEIGHT=160 '* ]]
}
placed() { becomes is_placed || fault "the window is not where it was: $geometry"; }
start scene.rt --depth 2
xdotool windowsize "$id" 200 160 windowmove "$id" 30 40
placed
await 'finished 200x160'
quit
[[ $(<state/strahl/window) == '30 40 200 160' ]] || fault "not that is remembered, but: $(<state/strahl/window)"
start scene.rt --depth 2
placed
await 'finished 200x160'
quit

echo "-- a flight is played once and measured"
put "$camera" "$world" "${path//60/1}"
"$strahl" play scene.rt --size 64x48 --benchmark --stats stats.json >log || fault "play fails: $(cat log)"
grep -q 'median .* ms, 99th percentile .* ms, worst' log || fault "the figures of a flight: $(cat log)"
grep -q '[1-9] pictures beside the finished ones.*RMS [0-9.]*, .*flicker' log || fault "the quality of a flight: $(cat log)"
grep -A 1 '"quality": {' stats.json | grep -q '"pictures": [1-9]' || fault "the quality of a flight: $(cat stats.json)"
grep -q '"pixels_per_second": [1-9]' stats.json || fault "the statistics of a flight: $(cat stats.json)"
finish
