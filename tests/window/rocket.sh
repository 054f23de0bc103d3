#!/usr/bin/env bash
# An editor of tracks: its changes are visible at once, and are saved.
#
#   tests/window/rocket.sh STRAHL EDITOR
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
editor=$(readlink -f -- "$2")
own_display 640x480 "import compare" "$@"

# scene FOV GREEN HEIGHT
scene() {
    printf '%s\n' "camera { position <5, -20, 18>  look_at <0, 0, 0>  up <0, 0, -1>  fov $1 }
music { bpm 60  rows 4 }
light { position <-5, 0, 10>  color <.9, .9, .9> }
sphere { <0, 0, 2>, 2  material { rgb <1, $2, .2> }  translate <0, 0, $3> }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }"
}
put "$(scene 'track "zoom" 12' 'track "green" .2' 'track "ball:height"')"
echo 'track "old" { 0 1 step }' >scene.tracks
# pictured FILE FOV GREEN HEIGHT: renders what the window should show.
pictured() {
    scene "${@:2}" >still.rt
    "$strahl" render still.rt -o "$1" --precision float --quiet --size 200x150 --depth 2 || fault "render $*"
}

# edit [PORT]: starts the editor.
edit() {
    coproc "$editor" "$@"
    editor_process=$COPROC_PID  # bash unsets its own when the editor ends
    read -r _ port <&"${COPROC[0]}"
}
end_editor() {
    kill "$editor_process"
    wait "$editor_process" 2>/dev/null
}
tell() { printf '%s\n' "$*" >&"${COPROC[1]}"; }
# hears TEXT: waits until the editor prints this.
hears() {
    local said
    while read -r -t 10 said <&"${COPROC[0]}"; do
        [[ $said == "$1"* ]] && return
    done
    fault "the editor does not say '$1'"
}

echo "-- an editor that is not there yet is waited for"
edit
end_editor
start_log 'waiting for one' scene.rt --size 200x150 --depth 2 --rocket --rocket-port "$port"
edit "$port"
await 'connected'
hears 'connected'
hears 'asks zoom'
hears 'asks green'
hears 'asks ball:height'
hears 'row 0'

echo "-- keys are visible at once"
pictured first.png 12 .2 0
shows first.png
tell key 1 0 1 0
await "the editor's change is on the screen after"
awk -v s="${line##* after }" 'BEGIN { exit !(s + 0 < .2) }' || fault "too late: $line"
pictured green.png 12 1 0
shows green.png
tell key 2 8 3 0
tell key 2 0 1 1
tell key 0 8 20 0
pictured raised.png 20 1 1
shows raised.png

echo "-- a moment, and a flight that the editor starts and stops"
tell row 4
hears 'row 4'
pictured middle.png 20 1 2
shows middle.png
tell pause 0
hears 'row 6'
tell pause 1
tell row 1000
hears 'row 1000'
pictured last.png 20 1 3
shows last.png
tell delete 1 0
tell row 0
hears 'row 0'
pictured deleted.png 20 .2 1
shows deleted.png

echo "-- saved, and played without an editor"
tell save
await 'tracks saved: scene.tracks'
grep -q 'track "old"' scene.tracks || fault "a track that the scene does not follow is lost"
"$strahl" check scene.rt | grep -q '3, 2 with keys' || fault "the tracks were not saved: $(cat scene.tracks)"
"$strahl" check scene.rt | grep -q "track 'old' is followed by nothing" || fault "check does not name the track 'old'"
[[ $(cat scene.tracks~) == 'track "old" { 0 1 step }' ]] || fault "there is no copy of the file as it was"
pictured saved.png 20 .2 2
"$strahl" render scene.rt -o moment.png --time 1 --precision float --quiet --size 200x150 --depth 2
[[ $(different_pixels moment.png saved.png) == 0 ]] || fault "saved tracks make another picture"

echo "-- a new track of the edited scene is asked for"
put "$(scene 'track "zoom" 12' 'track "blue" .2' 'track "ball:height"')"
hears 'asks blue'

echo "-- the editor ends, and is started again"
end_editor
await 'the Rocket editor is gone'
edit "$port"
await 'connected'
hears 'asks blue'
quit
finish
