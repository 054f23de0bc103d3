#!/usr/bin/env bash
# Ways in which changes could be lost, each pressed by hand: see tests/window/README.md; with real keys on a virtual
# display.
#
#   tests/window/lost.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 640x480 import "$@"
mkdir bin
printf '#!/bin/sh\nexit 127\n' | tee bin/zenity >bin/kdialog
chmod +x bin/*
export PATH=$work/bin:$PATH

# has PATTERN FILE: a line of the file matches.
has() { grep -qE -- "$1" "$2" || fault "no '$1' in $2: $(<"$2")"; }

echo "-- F2 after the timeline was shown keeps all keys of tracks; nothing was changed, and nothing is written"
put "$camera" "$world" 'sphere { <0, 0, 0>, 1  translate <0, 0, track "height" 1> }'
printf 'track "height" {\n  0 1 linear\n  4 2 smooth\n}\n' >scene.tracks
cp scene.rt first.rt && cp scene.tracks first.tracks
start scene.rt --size 640x400 --depth 2
await 'finished'
xdotool key t F2
await 'nothing to write'
cmp first.rt scene.rt && cmp first.tracks scene.tracks || fault "F2 without a change has written"
[[ ! -e scene.rt~ && ! -e scene.tracks~ ]] || fault "F2 without a change has made a copy"

echo "-- a key of the path is written with the tracks as they are; the picture goes on"
xdotool key p KP_3 p
await 'finished'
finished=$(grep -c finished log)
xdotool key F2
await 'path written into scene.rt'
cmp first.tracks scene.tracks || fault "writing the path has changed the tracks"
! grep -q 'other keys of tracks' log || fault "the window takes its own writing for that of others"
(($(grep -c finished log) == finished)) || fault "the picture began again"

echo "-- another scene, and then the end, ask: Esc stays, Enter writes first"
cp first.rt other.rt
printf '#!/bin/sh\necho other.rt\n' >bin/zenity
xdotool key p ctrl+o
await 'scene.rt is not written: Enter writes it'
xdotool key Escape ctrl+z
await 'undone: key 3 added'
xdotool key ctrl+y ctrl+q
await 'scene.rt is not written: Enter writes it'
xdotool key Escape BackSpace
await 'gallery of'
xdotool key ctrl+o
await 'scene.rt is not written: Enter writes it'
xdotool key Return
await 'path written into scene.rt'
await 'opened other.rt'
has 'key \{ time 6' scene.rt

echo "-- a file that is gone is written again; where nothing can be written, it is saved elsewhere, and watched there"
rm other.rt
xdotool key p KP_3 p F2
await 'other.rt, which was gone'
has 'key \{ time 3' other.rt
printf '#!/bin/sh\necho mine.rt\n' >bin/zenity
xdotool key ctrl+shift+s
await 'scene written into mine.rt'
has 'key \{ time 3' mine.rt
cmp other.rt mine.rt || fault "the copy is another scene"
echo '// theirs' >>mine.rt
await 'read again: mine.rt'
[[ $(xdotool getwindowname "$id") == mine.rt* ]] || fault "the title is $(xdotool getwindowname "$id")"

echo "-- the dialog of Save As is closed: nothing is written; D drops what is not written, and prints it"
printf '#!/bin/sh\nexit 1\n' >bin/zenity
cp mine.rt before.rt
files=$(ls)
xdotool key p ctrl+shift+s
await 'no file was chosen'
xdotool key ctrl+q
await 'mine.rt is not written'
quit d
await 'a path that was not written'
cmp before.rt mine.rt && [[ $(ls) == "$files" && $(grep -c 'scene written into' log) == 1 ]] ||
    fault "a closed dialog wrote: $(ls)"
printf '#!/bin/sh\necho mine.rt\n' >bin/zenity

echo "-- a scene of the program stays as it is, and a copy of it becomes the user's, with names of files that still lead"
scenes=$(readlink -f -- "$here/../../scenes")
cp "$scenes/beat.rt" beat.before
start "$scenes/beat.rt" --size 64x48 --depth 2
xdotool key p KP_3 p
await 'key 2 added'
xdotool key F2
await 'this scene belongs to the program'
await 'scene written into mine.rt'
cmp beat.before "$scenes/beat.rt" || fault "a scene of the program was written"
has 'sound "[^"]*/beat.ogg"' mine.rt
has 'key \{ time 3' mine.rt
[[ -e mine.rt~ ]] || fault "no copy of the older file is kept"
xdotool key F2
await 'nothing to write'

echo "-- the question before the end also saves elsewhere, and then goes on"
printf '#!/bin/sh\necho kept.rt\n' >bin/zenity
cp mine.rt before.rt
xdotool key KP_3 p
await 'key 3 added'
xdotool key ctrl+q
await 'mine.rt is not written'
quit ctrl+shift+s
await 'scene written into kept.rt'
has 'key \{ time 6' kept.rt
cmp before.rt mine.rt || fault "saving elsewhere wrote the scene, too"
"$strahl" check mine.rt >checked 2>&1 || fault "the copy has errors: $(<checked)"
finish
