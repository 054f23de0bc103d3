#!/usr/bin/env bash
# The README's pictures of the window are what the window shows: one with its timeline, one with the flight from
# outside, one with handles and lights, and one beside POV-Ray's.
#
#   tests/window/screenshot.sh STRAHL [FOLDER]
#
# With FOLDER it writes the pictures anew: tests/window/screenshot.sh build/release/strahl assets
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
[[ -z ${2-} ]] || set -- "$1" "$(readlink -f -- "$2")"
own_display 960x600 "import compare montage" "$@"
rm state/strahl/no_toolbar

# same NAME ROWS: the window shows this picture of assets in its upper rows; or this becomes what the window shows.
same() {
    if [[ -n ${folder-} ]]; then
        sleep 40 # notes have disappeared, and POV-Ray is done
        import -window "$id" shot.png
        convert shot.png -strip -quality 90 "$folder/$1"
        return
    fi
    # Small differences come from the versions of fonts and of OpenGL. A panel less is a tenth of the picture.
    convert "$here/../../assets/$1" -crop "x$2+0+0" +repage wanted.png
    pixels=$(convert wanted.png -format '%[fx:w*h]' info:)
    becomes is_similar "$2" || fault "$different of $pixels pixels differ from assets/$1"
}
# is_similar ROWS: do at most a hundredth of the pixels in the window's upper rows differ clearly from wanted.png?
is_similar() {
    different=$(convert shot.png -crop "x$1+0+0" +repage miff:- | compare -metric AE -fuzz 15% - wanted.png null: 2>&1)
    ((different <= pixels / 100))
}
folder=${2-}

start "$here/../../scenes/flythrough.rt" --size 960x600 --time 25.4
await 'finished 960x600'
xdotool key t
same window.jpg 600
quit

start "$here/../../scenes/flythrough.rt" --size 960x600 --time 6.8
xdotool key t g g g g g r
await 'second picture: the camera of the flight'
same outside.jpg 600
quit

start "$here/../../scenes/spotlights.rt" --size 960x600
xdotool mousemove --window "$id" 430 400 click 1 key l
same handles.jpg 600
quit

: >state/strahl/no_toolbar
command -v povray >/dev/null || fault "povray is not installed"
if command -v povray >/dev/null; then
    start "$here/../../scenes/article.rt" --size 640x480
    await 'finished 640x480'
    xdotool key g
    await 'second picture: POV-Ray' # of one ray in each pixel; the words at the bottom will change
    same beside.jpg 440
    quit
fi
if [[ -n $folder ]] && command -v povray >/dev/null; then
    for scene in flythrough spotlights mirror_ball; do
        start "$here/../../scenes/$scene.rt" --size 640x480
        await "finished 640x480"
        xdotool key g
        await 'second picture: POV-Ray'
        sleep 60 # its edges are smooth by then, if the machine has nothing else to do
        import -window "$id" "$scene.png"
        quit
    done
    montage flythrough.png spotlights.png mirror_ball.png -tile 3x1 -geometry 480x360+2+2 -strip -quality 85 \
        "$folder/beside_scenes.jpg"
fi
finish
