#!/usr/bin/env bash
# The README's picture of the window with its timeline is what the window shows.
#
#   tests/window/screenshot.sh STRAHL [FILE]
#
# With FILE it writes the picture anew: tests/window/screenshot.sh build/release/strahl assets/window.jpg
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
[[ -z ${2-} ]] || set -- "$1" "$(readlink -f -- "$2")"
own_display 960x600 "import compare" "$@"

start "$here/../../scenes/flythrough.rt" --size 960x600 --time 25.4
await 'finished 960x600'
xdotool key t
if [[ -n ${2-} ]]; then
    sleep 12 # notes have disappeared
    import -window "$id" shot.png
    convert shot.png -strip -quality 90 "$2"
else
    # Small differences come from the versions of fonts and of OpenGL. A panel less is a tenth of the picture.
    different=576000
    for ((i = 0; i < 60 && different > 5760; ++i)); do
        import -window "$id" shot.png
        different=$(compare -metric AE -fuzz 15% shot.png "$here/../../assets/window.jpg" null: 2>&1)
        sleep 0.25
    done
    ((different <= 5760)) || fault "$different of 576000 pixels differ from assets/window.jpg"
fi
quit
finish
