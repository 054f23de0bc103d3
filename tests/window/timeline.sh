#!/usr/bin/env bash
# A path made by hand: keys added, dragged on the timeline, written into the scene file, undone; and a number of a body
# dragged likewise; with real keys and mouse on a virtual display.
#
#   tests/window/timeline.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 640x400 "import convert" "$@"

put "// mine" "$camera // eye" "$world"
cp scene.rt first.rt
start scene.rt --size 640x400 --depth 2

echo "-- two keys, written into the file"
xdotool key t p KP_3 p
await 'key 2 added at 3 s'
xdotool key F2
await 'the file as it was is scene.rt~'
cmp first.rt scene.rt~ || fault "the copy is not the file as it was"
[[ $(diff first.rt scene.rt | grep -c '^<') == 0 ]] || fault "more than a block was added: $(diff first.rt scene.rt)"
cp scene.rt second.rt

# has_color COLOR LINE: puts the first ('1') or the rightmost place ('$') in the lower part of the window that has this
# colour into x and y.
has_color() {
    read -r x y < <(convert shot.png -crop 640x170+0+230 +repage txt:- |
        sed -n "s/^\([0-9]*\),\([0-9]*\):.*#$1.*/\1 \2/p" | if [[ $2 == 1 ]]; then cat; else sort -n; fi | sed -n "$2p")
    [[ -n $x ]] && y=$((y + 230))
}
find() { becomes has_color "$1" "$2" || fault "nothing on the timeline has the colour $1"; }
# find_key: puts the place of the second key's right corner into x and y.
find_key() {
    xdotool key Home
    await '// at 0 s'
    await 'finished'
    find 8CCCFF '$'
}
echo "-- a key is dragged on the timeline, and written"
find_key
xdotool mousemove --window "$id" $((x - 3)) "$y" mousedown 1
xdotool mousemove_relative 40 0 mousemove_relative 60 0 mouseup 1 key F2
await 'path written into'
time=$(sed -n 's/.*key { time \([0-9.]*\) .*/\1/p' scene.rt | tail -n 1)
awk -v t="$time" 'BEGIN { exit !(t > 4 && t < 6) }' || fault "the key was dragged to $time s"
grep -q "duration $time\$" scene.rt || fault "the duration is not that of the last key: $(grep duration scene.rt)"

echo "-- one undo takes back the whole drag; written again"
xdotool mousemove --window "$id" 300 100 key ctrl+z
await 'undone'
xdotool key F2
await 'path written into'
cmp second.rt scene.rt || fault "undone is not what was written before"

echo "-- the ease of a key is typed after a double click on the slider in its menu, and written; undone"
find_key
xdotool mousemove --window "$id" $((x - 3)) "$y" click 3
find 3D85E0 1 # the slider's grip
xdotool mousemove --window "$id" $((x + 30)) $((y + 4)) click --repeat 2 1 type .5
xdotool key Return mousemove --window "$id" 300 100 key F2
await 'path written into'
[[ $(diff second.rt scene.rt | grep -c '^>') == 1 && $(<scene.rt) == *'  ease 0.5 }'* ]] ||
    fault "the ease: $(diff second.rt scene.rt)"
xdotool key ctrl+z key ctrl+z key F2 # the first click moved the slider
await 'path written into'
cmp second.rt scene.rt || fault "undone is not what was written before"

echo "-- a body is chosen, its radius dragged and written in place; undone"
xdotool key t key r
await "the scene's camera"
xdotool mousemove --window "$id" 320 160 click 1
await 'chosen: body 1, sphere, line 4'
xdotool mousemove --window "$id" 507 147 mousedown 1
xdotool mousemove_relative 20 0 mousemove_relative 20 0 mouseup 1 key F2
await 'changes written into'
[[ $(<scene.rt) =~ 'sphere { <0, 0, 2>, 2.'[0-9]*'  material' ]] || fault "the radius: $(sed -n 4p scene.rt)"
[[ $(diff second.rt scene.rt | grep -c '^<') == 1 ]] || fault "more than a line has changed: $(diff second.rt scene.rt)"
xdotool mousemove --window "$id" 100 200 key ctrl+z key F2
await 'changes written into'
cmp second.rt scene.rt || fault "undone is not what was written before"
quit

echo "-- a key of a motion is dragged in its lane, and written in place"
put "$camera" 'light { position <0, -9, 9>  color <1, 1, 1> }' \
    'sphere { <0, 0, 2>, 2  motion { key { time 0 }  key { time 8  translate <1, 0, 0> } } }  // mine'
cp scene.rt first.rt
start scene.rt --size 640x400 --depth 2
xdotool key t
find 8CCCFF '$'
xdotool mousemove --window "$id" $((x - 3)) "$y" mousedown 1
xdotool mousemove_relative -- -40 0 mousemove_relative -- -60 0 mouseup 1
await 'the changed text is shown'
xdotool mousemove --window "$id" 300 100 key F2
await 'changes written into'
[[ $(<scene.rt) =~ 'key { time 0 }  key { time '([45]|[456].[0-9]+)'  translate <1, 0, 0> } } }  // mine' ]] ||
    fault "the motion: $(diff first.rt scene.rt)"
quit
finish
