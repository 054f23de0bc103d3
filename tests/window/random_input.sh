#!/usr/bin/env bash
# Random keys, mouse moves, window sizes and file changes for a while; most useful with a sanitized build.
#
#   tests/window/random_input.sh STRAHL SECONDS [SEED]
#
# Exit status: 0 the window survived and the sanitizers reported nothing, 1 otherwise, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
seconds=$2 seed=${3-1}
own_display 800x600 cc "$@"
trap '[[ -n $pid ]] && kill -9 "$pid" 2>/dev/null; rm -rf "$work"' EXIT
# The gallery opens installed scenes, of which F2 makes copies.
mkdir -p bin share/strahl
cp "$strahl" bin/strahl && cp -r "$here/../../scenes" share/strahl/ || exit 1
cp "$here/../../scenes/flythrough.rt" good.rt
cp "$here/../../scenes/"{article.rt,beat.rt,beat.ogg} .
cp "$here/../../scenes/beat.tracks" scene.tracks
cp good.rt scene.rt
sed 's/{/{ {/' good.rt >broken.rt

# Memory that an OpenGL driver keeps until the end looks leaked once its library is unloaded; so libraries stay loaded.
echo 'int dlclose(void *library) { return !library; }' | cc -shared -fPIC -x c - -o keep.so || exit 77
export ASAN_OPTIONS=verify_asan_link_order=0:log_path=$work/report UBSAN_OPTIONS=print_stacktrace=1:log_path=$work/report
export TSAN_OPTIONS=log_path=$work/report:print_suppressions=0:suppressions=$here/races.txt
export EDITOR=true ALSOFT_DRIVERS=null
width=96 height=72
LD_PRELOAD=$PWD/keep.so bin/strahl scene.rt --size ${width}x$height --still-size 64x48 --verbose >log 2>&1 &
pid=$!
for ((i = 0; i < 600; ++i)); do
    grep -q 'first picture' log && break
    sleep 0.1
done
id=$(xdotool search --pid "$pid" | tail -n 1)

RANDOM=$seed
keys=(m m l o o ctrl+a ctrl+a ctrl+d ctrl+d ctrl+z w a s d q e f space p r c h i Tab comma period bracketleft bracketright 1 2 3 shift+1 shift+2 shift+3 F11 F12 ctrl+s
    shift+w shift+c n v t t x F2 Home End Left Right Prior Next Insert Delete ctrl+z ctrl+y ctrl+n shift+Right Return F4
    ctrl+r ctrl+r ctrl+t o g g shift+g ctrl+shift+s plus minus 0 BackSpace F1 Down Up b KP_1 KP_3 KP_7 KP_9 shift+t)
change_file() {
    case $((RANDOM % 8)) in
        0) cp broken.rt new && mv new scene.rt ;;
        1 | 2) cp good.rt scene.rt ;;
        3) if ((RANDOM % 2)); then cp article.rt scene.rt; else cp beat.rt scene.rt; fi ;;
        4) sed "s/fov .*/fov $((RANDOM % 40 + 5))/" good.rt >scene.rt ;;
        5) head -c $((RANDOM % 3000)) good.rt >scene.rt ;;
        6) rm -f scene.rt ;;
        7) sed "s/key { time 0 .*//; s/duration .*/duration $((RANDOM % 40 + 1))/" good.rt >scene.rt ;;
    esac
}
act() {
    local key=${keys[RANDOM % ${#keys[@]}]}
    case $((RANDOM % 12)) in
        0)
            width=$((RANDOM % 200 + 1)) height=$((RANDOM % 150 + 1))
            xdotool windowsize "$id" $width $height
            ;;
        1) xdotool mousemove --window "$id" $((RANDOM % width)) $((RANDOM % height)) mousedown $((RANDOM % 3 ? 1 : 2)) ;;
        2) xdotool mousemove_relative -- $((RANDOM % 60 - 30)) $((RANDOM % 60 - 30)) ;;
        3) xdotool mouseup 1 mouseup 2 mousemove --window "$id" $((width / 2)) $((height / 2)) ;;
        4)
            if ((RANDOM % 3)); then
                xdotool click $((RANDOM % 2 + 4))
            else # chooses one more body, drags onto a surface, or moves across the view
                xdotool keydown Shift_L click $((RANDOM % 2 + 1)) mousedown 1 mousemove_relative 7 -9 mouseup 1 keyup Shift_L
            fi
            ;;
        5) xdotool keydown "$key" && sleep 0.$((RANDOM % 4)) && xdotool keyup "$key" ;;
        6) change_file ;;
        *) xdotool key "$key" ;;
    esac 2>/dev/null
}
end=$((SECONDS + seconds))
for ((actions = 0; SECONDS < end; ++actions)); do
    kill -0 "$pid" 2>/dev/null || break
    act
done
xdotool mouseup 1 mouseup 2 mousemove --window "$id" 0 0
# For a path that is not written, for stills that are not done, and to drop those.
for ((i = 0; i < 8; ++i)); do
    kill -0 "$pid" 2>/dev/null && xdotool key Escape ctrl+q d
    sleep 0.5
done
wait "$pid"
status=$?
pid=
count() { grep -c "$1" log; }
echo "$actions actions in $seconds s, seed $seed: $(count 'rest after') motions, $(count 'read again') files read," \
    "$(count 'has an error') faulty ones, $(count 'still saved') stills; exit status $status"
((status == 0)) && ! compgen -G 'report*' >/dev/null && exit 0
tail -n 3 log
cat report* | head -n 200
exit 1
