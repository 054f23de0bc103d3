#!/usr/bin/env bash
# Random keys, mouse moves, sizes and changes of the file for a while; meant for a build with sanitizers.
#
#   tests/window/monkey.sh SECONDS STRAHL SCENE [SEED]
#
# Exit status: 0 if the window lived and ended without a report, 1 if not.
set -uo pipefail

seconds=$1 strahl=$(readlink -f -- "$2") scene=$(readlink -f -- "$3") seed=${4-1}
if [[ -z ${STRAHL_OWN_DISPLAY-} ]]; then
    STRAHL_OWN_DISPLAY=yes exec xvfb-run -a -s "-screen 0 1280x1024x24" bash "${BASH_SOURCE[0]}" "$@"
fi
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
pid=
trap '[[ -n $pid ]] && kill -9 "$pid" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work" || exit 1
cp "$scene" scene.rt
cp "$scene" good.rt
sed 's/{/{ {/' "$scene" >broken.rt

# The display's own libraries are not instrumented, and Mesa keeps memory until the process ends.
export ASAN_OPTIONS=detect_leaks=1:exitcode=99 LSAN_OPTIONS=suppressions=$here/leaks.txt:print_suppressions=0
export TSAN_OPTIONS=exitcode=99:suppressions=$here/races.txt
"$strahl" scene.rt --size 96x72 --still-size 64x48 --verbose >log 2>&1 &
pid=$!
for ((i = 0; i < 600; ++i)); do
    grep -q 'first picture' log && break
    sleep 0.1
done
id=$(xdotool search --pid "$pid" | tail -n 1)

RANDOM=$seed
keys=(w a s d q e f space p r c h i Tab comma period bracketleft bracketright 1 2 3 shift+1 shift+2 shift+3 F11 s ctrl+s
    shift+w)
end=$((SECONDS + seconds))
actions=0
while ((SECONDS < end)) && kill -0 "$pid" 2>/dev/null; do
    key=${keys[RANDOM % ${#keys[@]}]}
    case $((RANDOM % 12)) in
        0) xdotool windowsize "$id" $((RANDOM % 160 + 1)) $((RANDOM % 120 + 1)) ;;
        1) xdotool mousemove --window "$id" $((RANDOM % 96)) $((RANDOM % 72)) mousedown 1 ;;
        2) xdotool mousemove_relative -- $((RANDOM % 60 - 30)) $((RANDOM % 60 - 30)) ;;
        3) xdotool mouseup 1 ;;
        4) xdotool click $((RANDOM % 2 + 4)) ;;
        5) xdotool keydown "$key" && sleep 0.$((RANDOM % 4)) && xdotool keyup "$key" ;;
        6) case $((RANDOM % 8)) in
            0) cp broken.rt new && mv new scene.rt ;;
            1) cp good.rt scene.rt ;;
            2) sed "s/fov .*/fov $((RANDOM % 40 + 5))/" good.rt >scene.rt ;;
        esac ;;
        *) xdotool key "$key" ;;
    esac 2>/dev/null
    ((++actions))
done
xdotool mouseup 1 key Escape
sleep 1
kill -0 "$pid" 2>/dev/null && xdotool key Escape
wait "$pid"
status=$?
pid=
echo "$actions actions in $seconds s, seed $seed; exit status $status; $(grep -c 'still saved' log) stills"
((status == 0)) && ! grep -qE 'ERROR: |WARNING: |runtime error' log && exit
grep -v '^//' log | head -n 60
exit 1
