#!/usr/bin/env bash
# The window as a user sees it: real keys and mouse on a virtual display; screenshots are compared with pictures of
# `strahl render`.
#
#   tests/window/run.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail

strahl=$(readlink -f -- "$1")
source "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/display.sh"
own_display 1280x1024 "import compare" "$strahl"

work=$(mktemp -d)
pid=
trap '[[ -n $pid ]] && kill "$pid" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
faults=0
fault() {
    printf 'FAULT: %s\n' "$*"
    ((++faults))
}

# start ARGUMENT...: opens the window and waits for it.
start() {
    : >log
    read_lines=0
    "$strahl" "$@" --verbose >log 2>&1 &
    pid=$!
    await 'first picture' || {
        cat log
        exit 1
    }
    id=$(xdotool search --pid "$pid" | tail -n 1)
    # Without a window manager keys go where the mouse is.
    xdotool mousemove --window "$id" 100 100
}

# await TEXT: waits for a line that contains it, after the last awaited one, and puts it into $line.
await() {
    local i number
    for ((i = 0; i < 600; ++i)); do
        if number=$(tail -n "+$((read_lines + 1))" log | grep -n -m 1 -F -e "$1"); then
            line=${number#*:}
            read_lines=$((read_lines + ${number%%:*}))
            return 0
        fi
        kill -0 "$pid" 2>/dev/null || break
        sleep 0.1
    done
    fault "there was no '$1' after line $read_lines of what the window says:"
    cat log
    return 1
}

different_pixels() { compare -metric AE "$1" "$2" null: 2>&1; }

# shows FILE: after a while (notes disappear after some seconds) the window shows exactly this picture.
shows() {
    local i
    for ((i = 0; i < 60; ++i)); do
        import -window "$id" shot.png
        [[ $(different_pixels shot.png "$1") == 0 ]] && return
        sleep 0.25
    done
    fault "the window does not show $1: $(different_pixels shot.png "$1") pixels differ"
    [[ -n ${STRAHL_KEEP-} ]] && cp shot.png "$1" "$STRAHL_KEEP"
}
shows_other() {
    local i
    for ((i = 0; i < 60; ++i)); do
        import -window "$id" shot.png
        [[ $(different_pixels shot.png "$1") != 0 ]] && return
        sleep 0.25
    done
    fault "the window still shows $1"
}

# still FILE ARGUMENT...: renders what the window should show.
still() { "$strahl" render scene.rt -o "$1" --precision float --quiet "${@:2}" || fault "render $*"; }

quit() {
    xdotool key Escape
    wait "$pid"
    local status=$?
    ((status == 0)) || fault "the window ended with status $status"
    pid=
}

world='light { position <-5, 0, 10>  color <.9, .9, .9> }
sphere { <0, 0, 2>, 2  material { rgb <1, .2, .2> } }
sphere { <2.5, -2, 1>, 1  material { rgb <.2, 1, .2>  refraction .6  ior 1.3 } }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }'
camera='camera { position <5, -20, 18>  look_at <0, 0, 0>  up <0, 0, -1>  fov 12 }'
path='flythrough { duration 60  key { time 0  position <5, -20, 18>  look_at <0, 0, 0> }
  key { time 60  position <15, -20, 10>  look_at <0, 0, 0> } }'
# put TEXT: replaces the content of the scene file.
put() {
    printf '%s\n' "$1" >scene.new
    mv scene.new scene.rt
}

echo "-- first picture, refinement"
put "$camera
$world
$path"
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

echo "-- flying by hand; what is seen can be printed"
xdotool keydown w
sleep 0.5
xdotool keyup w
await 'rest after'
await 'finished'
shows_other first.png
xdotool key c
await 'camera printed'
await '}'
put "$(grep -A 6 -F 'camera {' log)
$world
$path"
await 'read again'
still flown.png --size 320x240
shows flown.png

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
await 'there is no camera 2'
xdotool key 1
await 'camera 1'
shows flown.png

# Flies for a moment and waits until the paused picture is finished; sets `seconds`.
fly_and_pause() {
    xdotool key f
    await 'flying from'
    sleep 0.5
    xdotool key space
    await 'paused at '
    seconds=${line##*paused at }
    seconds=${seconds% s}
    await 'finished'
}

echo "-- the flight: played, paused, a still of it"
put "$camera
$world
$path"
await 'read again'
fly_and_pause
still paused.png --size 320x240 --time "$seconds"
shows paused.png
xdotool key s
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
xdotool key h
shows paused.png

echo "-- pixels that rounding decides are marked while the picture rests"
xdotool key x
await 'rounding decides'
xdotool key x
shows paused.png

echo "-- the file changes: a broken one, and a good one"
put "$camera
$world
shpere { }
$path"
await 'has an error'
await 'scene.rt:6:1'
shows_other paused.png
xdotool key space
await 'flight continues'
sleep 0.3 # the flight goes on meanwhile
xdotool key space
await 'paused at '
seconds=${line##*paused at }
seconds=${seconds% s}
put "$camera
$world
sphere { <-3, 0, 1>, 1 }
$path"
await 'read again'
still changed.png --size 320x240 --time "$seconds"
shows changed.png

echo "-- depth, resolution, recording"
xdotool key bracketleft bracketleft
await 'depth 18'
still shallow.png --size 320x240 --time "$seconds" --depth 18
shows shallow.png
xdotool key comma
await 'at most 1/2 of the pixels'
xdotool key p r p
await 'key 1 added'
await 'key 2 added'
await 'flythrough {'

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

echo "-- quitting waits for stills"
xdotool key ctrl+s ctrl+s
quit
grep -q 'quit' log || fault "the window did not say that it quits"
count=$(grep -c 'still saved' log)
((count == 3)) || fault "$count of 3 stills were saved"

echo "-- unless asked twice; and a flight from the start"
start scene.rt --size 200x100 --still-size 8000x6000 --fly --time 5
grep -q 'flight continues' log || fault "--fly does not fly"
xdotool key ctrl+s
await 'still queued'
xdotool key Escape
await 'waiting for'
quit
grep -q 'still dropped: scene-' log || fault "it is not said which still was dropped"

echo "-- bodies that move: played, paused, and looked at from elsewhere meanwhile"
put "$camera
$world
sphere { <-3, 0, 1>, 1  motion { key { time 0 }  key { time 20  translate <0, 6, 3>  scale 2 } } }"
start scene.rt --size 320x240
await 'finished'
still moving.png --size 320x240
shows moving.png
fly_and_pause
still moved.png --size 320x240 --time "$seconds"
shows moved.png
(($(different_pixels moving.png moved.png) > 0)) || fault "nothing moved in $seconds s"
xdotool keydown w
sleep 0.3
xdotool keyup w
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
xdotool keydown w
sleep 1
xdotool keyup w
await 'rest after'
await 'finished'
quit

echo "-- where no window can be"
env -u DISPLAY -u WAYLAND_DISPLAY "$strahl" scene.rt >log 2>&1
(($? == 1)) && grep -q 'strahl render' log || fault "without a display: $(cat log)"
MESA_GL_VERSION_OVERRIDE=2.1 "$strahl" scene.rt >log 2>&1
(($? == 1)) && grep -q 'strahl render' log || fault "with an old OpenGL: $(cat log)"

((faults == 0)) || exit 1
echo "as expected"
