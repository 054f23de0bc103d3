# shellcheck shell=bash
# Sourced by the tests of the window: runs them on a virtual display in a folder of their own, opens the window, waits for
# what it logs, and compares what it shows with pictures of `strahl render`.

strahl=$(readlink -f -- "$1")
# shellcheck disable=SC2034  # for the tests
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
faults=0
fault() {
    printf 'FAULT: %s\n' "$*"
    ((++faults))
}

# own_display SIZE "TOOL..." ARGUMENT...: starts the script again with ARGUMENT... under Xvfb, unless it already runs
# there, and then enters an empty folder. Exits with status 77 (skipped) if a tool is missing.
own_display() {
    if [[ -n ${STRAHL_OWN_DISPLAY-} ]]; then
        work=$(mktemp -d)
        pid=
        trap '[[ -n $pid ]] && kill "$pid" 2>/dev/null; rm -rf "$work"' EXIT
        cd "$work" || exit 1
        export XDG_STATE_HOME=$work/state XDG_CONFIG_HOME=$work/config XDG_CACHE_HOME=$work/cache
        # Pictures of the window are compared whole; tools.sh shows the toolbar.
        mkdir -p state/strahl && : >state/strahl/no_toolbar
        return
    fi
    local size=$1 tools tool
    read -ra tools <<<"$2"
    for tool in xvfb-run xauth xdotool "${tools[@]}"; do
        command -v "$tool" >/dev/null && continue
        echo "skipped: $tool is missing (Debian packages xvfb, xauth, xdotool, imagemagick, libgl1-mesa-dri)"
        exit 77
    done
    STRAHL_OWN_DISPLAY=yes exec xvfb-run -a -s "-screen 0 ${size}x24" bash "$0" "${@:3}"
}

# start ARGUMENT...: opens the window and waits for its first picture.
start() { start_log 'first picture' "$@"; }
# start_log TEXT ARGUMENT...: opens the window, with the file $input if that is set as its standard input, and waits for
# this in its log.
start_log() {
    : >log
    read_lines=0
    "$strahl" "${@:2}" --verbose <"${input-/dev/null}" >log 2>&1 &
    pid=$!
    await "$1" || {
        cat log
        exit 1
    }
    # The window may not be there yet, and one that another program closes meanwhile ends the search.
    until id=$(xdotool search --pid "$pid" 2>/dev/null | tail -n 1) && [[ -n $id ]] || ! kill -0 "$pid"; do
        sleep 0.05
    done
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

# becomes COMMAND...: makes pictures of the window, each shot.png, until the command succeeds with one of them. Fails
# after 15 seconds: notes have disappeared by then.
becomes() {
    local i
    for ((i = 0; i < 60; ++i)); do
        import -window "$id" shot.png
        "$@" && return
        sleep 0.25
    done
    return 1
}

different_pixels() { compare -metric AE "$1" "$2" null: 2>&1; }
# differs FILE: puts into $different how many pixels of shot.png differ from this picture. Fails if none does.
differs() {
    different=$(different_pixels shot.png "$1")
    [[ $different != 0 ]]
}
is_same() { ! differs "$1"; }

# shows FILE: after a while the window shows exactly this picture.
shows() {
    becomes is_same "$1" && return
    fault "the window does not show $1: $different pixels differ"
    [[ -n ${STRAHL_KEEP-} ]] && cp shot.png "$1" "$STRAHL_KEEP"
}
shows_other() { becomes differs "$1" || fault "the window still shows $1"; }

# still FILE ARGUMENT...: renders what the window should show.
still() { "$strahl" render scene.rt -o "$1" --precision float --quiet "${@:2}" || fault "render $*"; }

# point X Y [BUTTON]: clicks there with this button, or the left one.
point() { xdotool mousemove --window "$id" "$1" "$2" click "${3-1}"; }
# drag X Y DX DY: drags from there, in two steps.
drag() {
    xdotool mousemove --window "$id" "$1" "$2" mousedown 1
    xdotool mousemove_relative -- "$3" "$4" mousemove_relative -- "$3" "$4" mouseup 1
}
# type_at X Y TEXT: types it into a field, after a click with Ctrl, at once: the window keeps the order of events.
type_at() {
    xdotool mousemove --window "$id" "$1" "$2" keydown Control_L click 1 keyup Control_L
    xdotool type --delay 1 -- "$3"
    xdotool key Return
}
# change X Y TEXT: types it into a field for a number of the text.
change() {
    type_at "$@"
    await 'the changed text is shown'
}
# writes PATTERN: F2 writes a file with a line that matches.
writes() {
    xdotool key F2
    written "$1"
}
# written PATTERN: a file with a line that matches is written.
written() {
    await 'written into'
    grep -qE -e "$1" scene.rt || fault "no line has '$1': $(<scene.rt)"
}

# quit [KEY]: closes the window by this key and waits until the program has ended.
quit() {
    xdotool key "${1-ctrl+q}"
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
# put TEXT...: replaces the content of the scene file, a line or several for each TEXT.
put() {
    printf '%s\n' "$@" >scene.new
    mv scene.new scene.rt
}

# finish: ends the test with its exit status.
finish() {
    ((faults == 0)) || exit 1
    echo "as expected"
}
