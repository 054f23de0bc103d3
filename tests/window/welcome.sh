#!/usr/bin/env bash
# The gallery that the window shows without a scene: by keys and by clicks, with real ones on a virtual display.
#
#   tests/window/welcome.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 800x600 import "$@"
export PATH=$work/bin:$PATH
mkdir bin

# closed: the window has ended well.
closed() {
    wait "$pid"
    local status=$?
    ((status == 0)) || fault "the window ended with status $status"
    pid=
}

echo "-- without a scene there is a gallery; without a file dialog a template becomes untitled.rt, which is opened"
printf '#!/bin/sh\nexit 127\n' | tee bin/zenity >bin/kdialog
chmod +x bin/*
start_log 'gallery of' view --size 640x480
xdotool key Return
await 'a new scene: untitled.rt'
await 'finished 640x480'
cmp untitled.rt "$here/../../scenes/templates/empty_floor.rt" || fault "the new scene is not the template"

echo "-- back in the gallery, no key flies; Esc leads back to the scene; another template, to be saved where the dialog says"
xdotool key BackSpace
await 'gallery of'
xdotool key w Escape BackSpace
printf '#!/bin/sh\necho "$@" >words\necho mine\n' >bin/zenity
await 'gallery of'
xdotool key Right Return
await 'a new scene: mine.rt'
await 'opened mine.rt'
cmp mine.rt "$here/../../scenes/templates/short_flight.rt" || fault "the new scene is not the template"
grep -q -e --save words || fault "the dialog does not ask for a new file: $(<words)"

echo "-- no file is overwritten"
echo '// mine' >>mine.rt
xdotool key BackSpace
await 'gallery of'
xdotool key Right Return
await "'mine.rt' exists"
tail -n 1 mine.rt | grep -q mine || fault "mine.rt was overwritten"

echo "-- no dialog's answer: nothing happens; another scene below"
printf '#!/bin/sh\nexit 1\n' >bin/zenity
xdotool key Return Down Return
await 'opened '
quit
[[ $line == *beat.rt ]] || fault "below the templates there is: $line"
[[ ! -e untitled-2.rt ]] || fault "a scene was made though the dialog was closed"
[[ $(head -n 1 state/strahl/recent) == */scenes/beat.rt && $(wc -l <state/strahl/recent) == 3 ]] ||
    fault "these files were opened last: $(<state/strahl/recent)"

echo "-- the next time the files opened last are there, but for one that is gone; a click opens one"
rm untitled.rt
start_log 'gallery of' view --size 640x480
xdotool key Down Right Return
await 'first picture'
await 'finished'
[[ $(xdotool getwindowname "$id") == mine.rt* ]] || fault "opened was $(xdotool getwindowname "$id")"
xdotool key BackSpace
await 'gallery of'
xdotool mousemove --window "$id" 100 300 click 1
await 'opened '
[[ $line == *beat.rt ]] || fault "the click opened: $line"
quit

echo "-- a file with an error is waited for, as if it had been named; the gallery is still there"
echo 'shpere { }' >broken.rt
printf '#!/bin/sh\necho broken.rt\n' >bin/zenity
start_log 'gallery of' view --size 640x480
xdotool key ctrl+o
await 'broken.rt:1:1'
put "$camera" "$world"
mv scene.rt broken.rt
await 'finished 640x480'
xdotool key BackSpace
await 'gallery of'
xdotool key Escape Escape
closed

echo "-- Esc leaves"
start_log 'gallery of' view --size 640x480
xdotool key BackSpace Escape
closed

echo "-- a program that was copied to elsewhere says where it has looked for scenes"
installed=$strahl
mkdir copied
cp "$strahl" copied/strahl
strahl=$work/copied/strahl
start_log "none in $work/share/strahl/scenes" view --size 640x480
strahl=$installed
xdotool key Escape
closed

echo "-- the user's keys apply, in the help as well; an error in their file is told"
mkdir -p config/strahl
printf 'add-key = F3\nopen = F3\n' >config/strahl/keys
put "$camera" "$world"
start_log 'keys:2:8: F3 is the key of '"'add-key' in line 1 already" scene.rt --size 320x240
await 'first picture'
xdotool key p F3
await 'key 1 added'
xdotool key F1 p q Escape p ctrl+n # typed for the help
await 'new path'
! tail -n +4 log | grep -q 'key 2 added' || fault "what is typed for the help is a command, too"
quit
"$strahl" view --list-keys >keys 2>faults
(($? == 3)) && grep -q '^add-key = F3 ' keys && grep -q '^open =  ' keys && grep -q 'keys:2:8' faults ||
    fault "the list of keys: $(cat keys faults)"

echo "-- strahl alone shows it, too; without a display it says how it is used"
"$strahl" >log 2>&1 &
pid=$!
until id=$(xdotool search --pid "$pid" 2>/dev/null | tail -n 1) && [[ -n $id ]] || ! kill -0 "$pid"; do sleep 0.05; done
xdotool mousemove --window "$id" 100 100
while kill -0 "$pid" 2>/dev/null; do xdotool key Escape sleep 0.1; done
closed
env -u DISPLAY -u WAYLAND_DISPLAY "$strahl" >log 2>&1
(($? == 2)) && grep -q 'Usage: strahl' log || fault "without a display: $(head -n 3 log)"
finish
