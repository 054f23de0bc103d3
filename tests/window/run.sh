#!/usr/bin/env bash
# The window as a user sees it: real keys and mouse on a virtual display; screenshots are compared with pictures of
# `strahl render`.
#
#   tests/window/run.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 1280x1024 "import compare" "$@"

echo "-- first picture, refinement"
put "$camera" "$world" "$path"
start scene.rt --size 320x240
await 'finished 320x240'
still first.png --size 320x240
shows first.png

echo "-- idle"
ticks() { awk '{ print $14 + $15 }' "/proc/$pid/stat"; }
before=$(ticks)
sleep 2
used=$(($(ticks) - before))
((used <= 3)) || fault "the window used $used hundredths of a second in two idle seconds"

echo "-- flying by hand; the camera can be copied"
xdotool key w
await 'rest after'
await 'finished'
shows_other first.png
xdotool key c
await 'camera copied'
await '}'
put "$(grep -A 6 -F 'camera {' log)" "$world" "$path"
await 'read again'
still flown.png --size 320x240
shows flown.png

# From here on without notes, which would have to disappear each time.
xdotool key n

echo "-- looking around, orbiting, storing and recalling"
xdotool key shift+1
await 'camera 1 stored'
xdotool mousemove --window "$id" 100 100 mousedown 1 mousemove_relative 20 10 mousemove_relative 20 10 mouseup 1
await 'rest after'
shows_other flown.png
xdotool key Tab
await 'orbiting'
xdotool key a
await 'rest after'
xdotool key 2
await 'no camera is stored as 2'
xdotool key 1
await 'camera 1'
shows flown.png

# Pauses the flight; sets `seconds`.
pause() {
    xdotool key space
    await 'paused at '
    seconds=${line##*paused at }
    seconds=${seconds% s}
}
# Flies, pauses, goes on by a second, and waits until that picture is finished; sets `seconds`.
fly_and_pause() {
    xdotool key f
    await 'flying from'
    pause
    xdotool key shift+Right
    await '// at '
    seconds=${line##*at }
    seconds=${seconds% s}
    await 'finished'
}

echo "-- the flight: played, paused, a still of it"
put "$camera" "$world" "$path"
await 'read again'
fly_and_pause
still paused.png --size 320x240 --time "$seconds"
shows paused.png
xdotool key F12
await 'still queued'
await 'still saved: '
file=${line##*saved: }
"$strahl" render scene.rt -o still.bmp --size 320x240 --time "$seconds" --quiet
cmp still.bmp "$file" || fault "the still $file is not what render makes"
shows paused.png

echo "-- overlays"
xdotool key i
shows_other paused.png
xdotool key i
shows paused.png
xdotool key h
shows_other paused.png
xdotool key f BackSpace Escape # typing searches the help, and does nothing else
shows paused.png
xdotool key n

echo "-- pixels that depend on rounding are marked while the picture is at rest"
xdotool key x
await '% are proved'
xdotool key x
shows paused.png

echo "-- the file changes: a broken one, and a good one"
xdotool key n
put "$camera" "$world" "shpere { }" "$path"
await 'has an error'
await 'scene.rt:6:1'
shows_other paused.png
xdotool key n space
await 'flight continues'
pause
put "$camera" "$world" "sphere { <-3, 0, 1>, 1 }" "$path"
await 'read again'
still changed.png --size 320x240 --time "$seconds"
shows changed.png

echo "-- depth, resolution, keys of a path"
xdotool key bracketleft bracketleft
await 'depth 18'
still shallow.png --size 320x240 --time "$seconds" --depth 18
shows shallow.png
xdotool key comma
await "motion quality: equal distances"
xdotool key comma
await 'at most 1/2 of the pixels'
xdotool key p r p ctrl+z shift+c
await 'key 3 added at 63 s'
await 'key 4 added at 66 s'
await 'undone'
await 'flythrough {'
await 'key { time 63'

echo "-- another size, full screen and back"
xdotool windowsize "$id" 400 300
await 'finished 400x300'
still larger.png --size 400x300 --depth 18
shows larger.png
xdotool key F11
await 'finished 1280x1024'
still full.png --size 1280x1024 --depth 18
shows full.png
xdotool key F11
await 'finished 400x300'
shows larger.png

echo "-- quitting asks about a path that is not written, and waits for stills; a path that the file replaces is printed"
xdotool key F12 F12 Escape
await 'scene.rt is not written'
put "$camera" "$world" "${path//60/50}"
await 'Ctrl+Z brings yours back'
quit d
await 'not written into the file'
await 'key { time 63'
grep -q 'quit' log || fault "the window did not say that it quits"
count=$(grep -c 'still saved' log)
((count == 3)) || fault "$count of 3 stills were saved"

echo "-- Esc twice drops them; and a flight from the start"
start scene.rt --size 200x100 --still-size 8000x6000 --fly --time 5
grep -q 'flight continues' log || fault "--fly does not fly"
xdotool key F12
await 'still queued'
xdotool key ctrl+q
await 'waiting for'
quit Escape
grep -q 'still dropped: scene-' log || fault "it is not said which still was dropped"

echo "-- bodies that move: played, paused, and looked at from elsewhere meanwhile"
put "$camera" "$world" "sphere { <-3, 0, 1>, 1  motion { key { time 0 }  key { time 20  translate <0, 6, 3>  scale 2 } } }"
start scene.rt --size 320x240
await 'finished'
still moving.png --size 320x240
shows moving.png
xdotool key n
fly_and_pause
still moved.png --size 320x240 --time "$seconds"
shows moved.png
(($(different_pixels moving.png moved.png) > 0)) || fault "nothing moved in $seconds s"
xdotool key w
await 'rest after'
shows_other moved.png
xdotool key space
await 'flight continues'
xdotool key r
await "the scene's camera"
quit
start scene.rt --size 320x240 --time "$seconds"
await 'finished'
shows moved.png
quit

echo "-- so small that every picture is complete while the camera still moves"
start scene.rt --size 64x48
await 'finished'
import -window "$id" before.png
xdotool keydown w
shows_other before.png
xdotool keyup w
await 'rest after'
await 'finished'
quit

echo "-- where no window can be"
env -u DISPLAY -u WAYLAND_DISPLAY "$strahl" scene.rt >log 2>&1
(($? == 1)) && grep -q 'strahl render' log || fault "without a display: $(cat log)"
MESA_GL_VERSION_OVERRIDE=2.1 "$strahl" scene.rt >log 2>&1
(($? == 1)) && grep -q 'strahl render' log || fault "with an old OpenGL: $(cat log)"

finish
