#!/usr/bin/env bash
# Sound in time with the picture: with OpenAL's null driver, which plays at the speed of a device but silently, and with
# its wave driver, which writes what would be heard into a file.
#
#   tests/window/sound.sh STRAHL
#
# Exit status: 0 all as expected, 1 not, 77 a tool is missing.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
own_display 400x300 "" "$@"

export XDG_STATE_HOME=$work
cp "$here/clicks.ogg" .
cat >scene.rt <<'SCENE'
camera { position <0, -9, 2>  look_at <0, 0, 1>  sky <0, 0, 1>  angle 40 }
light { position <5, -5, 9>  color <1, 1, 1> }
sphere { <0, 0, 1>, 1 }
music { sound "clicks.ogg" }
flythrough { duration 3.2
  key { time 0  position <0, -9, 2>  look_at <0, 0, 1> }
  key { time 3.2  position <2, -9, 2>  look_at <0, 0, 1> } }
SCENE

play() { "$strahl" play scene.rt --size 160x120 --verbose "$@" >log 2>&1 || fault "strahl play ends with $?: $(<log)"; }

echo "-- pictures are those of the moment heard"
ALSOFT_DRIVERS=null play
grep 'with sound' log
if ! grep -q 'built without sound' log; then
    read -r pictures median <<<"$(sed -n 's/.*; \([0-9]*\) with sound, ahead of it by \(.*\) ms (median).*/\1 \2/p' log)"
    [[ ${median-} ]] || fault "nothing was heard: $(<log)"
    ((pictures > 50)) || fault "only $pictures pictures had sound"
    awk -v m="$median" 'BEGIN { exit !(m > -10 && m < 10) }' || fault "pictures are $median ms ahead of the sound"

    echo "-- what is heard is the file from the start of the flight"
    printf '[wave]\nfile = %s/heard.wav\n[general]\nfrequency = 44100\nsample-type = int16\nchannels = stereo\n' "$work" >conf
    ALSOFT_CONF=$work/conf ALSOFT_DRIVERS=wave play
    # The first tone and the next one, half a second later, in samples of 4 bytes.
    od -An -v -td2 -w4 -j44 heard.wav | awk '
        function abs(x) { return x < 0 ? -x : x }
        abs($1) > 2000 { if (NR - last > 8000) print NR; last = NR }' >tones
    echo "tones begin at: $(tr '\n' ' ' <tones)"
    (($(wc -l <tones) >= 5)) || fault "of 6 tones $(wc -l <tones) were heard"
    awk 'NR > 1 { d = $1 - last; if (d < 21850 || d > 22250) exit 1 } { last = $1 }' tones || fault "tones are not half a second apart"
fi

echo "-- no device: silence, and the flight goes on"
ALSOFT_DRIVERS=alsa ALSA_CONFIG_PATH=/dev/null play
grep -q 'no sound: ' log || fault "silence is not reported: $(<log)"
grep -E 'ALSA|AL lib' log && fault "the libraries' own messages are on the terminal"
grep -q 'rest after' log || fault "the flight did not end: $(<log)"
finish
