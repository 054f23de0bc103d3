#!/usr/bin/env bash
# Films: what ffmpeg is given, and what is left when it fails or the program is interrupted. ffmpeg itself is not needed.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
set -m # a shell without job control starts what it puts into the background with SIGINT ignored

# Replaces ffmpeg: writes its input as the film, or fails after some bytes.
mkdir bin
cat >bin/ffmpeg <<'SCRIPT'
#!/usr/bin/env bash
printf '%s\n' "$@" >arguments
file=${!#}
[[ -s no_codec ]] && { echo "no such codec" >&2; exit 1; }
[[ -s full ]] && { head -c 3000 >"${file#file:}"; echo "no space left" >&2; exit 1; }
exec cat >"${file#file:}"
SCRIPT
chmod +x bin/ffmpeg
system_path=$PATH
export PATH="$work/bin:$PATH"
options=(--size 32x24 --fps 2 --samples 1)

# The whole flight by default; a list of frames as well.
"$strahl" render scene.rt -o - --format y4m --frames 0-7 "${options[@]}" >whole
"$strahl" render scene.rt -o - --format y4m --frames 5,1-3 "${options[@]}" >some
for ending in mp4=mp4 mkv=matroska webm=webm MP4=mp4; do
    expect 0 '"frames": 8,' render scene.rt -o "film.${ending%=*}" "${options[@]}" --stats -
    expect_same "film.${ending%=*}" whole
    tail -2 arguments | head -1 | grep -qx "${ending#*=}" || fault "ffmpeg is asked for: $(tail -2 arguments)"
done
grep -qx yuv4mpegpipe arguments && grep -q colorspace=bt709 arguments || fault "ffmpeg's arguments: $(<arguments)"
expect 0 "" render scene.rt -o film.mp4 --frames 5,1-3 "${options[@]}"
expect_same film.mp4 some
expect 0 "" render scene.rt -o ./-film.mp4 --size 64x48 --crop 2,4,6,8 --frames 3 --fps 2
"$strahl" render scene.rt -o - --format y4m --size 64x48 --crop 2,4,6,8 --frames 3 --fps 2 | cmp - ./-film.mp4 ||
    fault "the crop is not in the film"
# Rates of video are fractions, in the stream and in ffmpeg's call.
for rate in 119.88=120000:1001 23.98=24000:1001 25=25:1; do
    expect 0 "" render scene.rt -o film.mp4 --frames 0 --size 16x16 --fps "${rate%=*}"
    head -1 film.mp4 | grep -q " F${rate#*=} " || fault "the stream of ${rate%=*} begins: $(head -1 film.mp4)"
    fraction=${rate#*=}
    grep -A 1 -x -e -r arguments | grep -qx "${fraction/:/\/}" || fault "ffmpeg's arguments for $rate: $(<arguments)"
done
rm film.* ./-film.mp4 arguments

# The scene's sound, from the first frame on.
mkdir 'a folder'
cp "$source_folder/tests/window/clicks.ogg" 'a folder/clicks: 1.ogg'
echo 'music { sound "clicks: 1.ogg" }' | cat scene.rt - >'a folder/loud.rt'
expect 0 "" render 'a folder/loud.rt' -o loud.mp4 --frames 3-5 "${options[@]}"
tr '\n' ' ' <arguments >sound
grep -qF -- "-i pipe:0 -ss 1.5 -i file:a folder/clicks: 1.ogg -map 0:v -map 1:a -af apad -shortest" sound ||
    fault "ffmpeg's arguments: $(<sound)"
expect 0 "without sound" render 'a folder/loud.rt' -o loud.mp4 --frames 5,1-3 "${options[@]}"
expect_same loud.mp4 some
! grep -q clicks arguments || fault "frames that do not follow each other have sound"
rm -r sound loud.mp4 arguments 'a folder'

# ffmpeg fails at once, or halfway: its message is shown, and an older film stays.
echo "an older film" >film.mp4
echo yes >no_codec
expect 1 "ffmpeg failed: no such codec" render scene.rt -o film.mp4 "${options[@]}"
expect_only bin bin/ffmpeg scene.rt whole some film.mp4 no_codec arguments
rm no_codec
echo yes >full
expect 1 "ffmpeg failed: no space left
the film so far is in 'film.part.mp4'" render scene.rt -o film.mp4 --samples 1 --size 320x240
head -c 3000 <("$strahl" render scene.rt -o - --format y4m --samples 1 --size 320x240 --frames 0) | cmp - film.part.mp4
expect_only bin bin/ffmpeg scene.rt whole some film.mp4 film.part.mp4 full arguments
[[ $(<film.mp4) == "an older film" ]] || fault "the older film is gone"
rm full film.part.mp4 arguments

# No ffmpeg.
mkdir none
PATH=$work/none expect 1 "strahl: cannot make 'film.mp4': there is no ffmpeg in PATH, which films need (ffmpeg.org; on Debian: apt install ffmpeg)" render scene.rt -o film.mp4
rmdir none
# Options that do not fit a film are refused.
refuse() { expect 2 "$1" render scene.rt "${@:2}"; }
refuse "even, and not 31x24" -o a.mp4 --size 31x24
refuse "even, and not 3x2" -o a.mkv --size 32x24 --crop 0,0,3,2
refuse "-o 'a b-%04d.png'" -o "a b.mp4" --resume
refuse "a file for each frame" -o a.mp4 --part 1/2
refuse "many moments" -o a.mp4 --time 1
refuse "8 bits" -o a.mp4 --bits 16
refuse ".mp4, .mkv and .webm" -o a.avi
sed '/^flythrough/,$d' scene.rt >still.rt
expect 2 "a film needs a scene with a flythrough" render still.rt -o a.mp4
cp scene.rt scene.mp4
expect 2 "overwrite the scene" render scene.mp4 -o scene.mp4
mkdir folder.mp4
expect 1 "is a folder" render scene.rt -o folder.mp4
mkfifo pipe.mp4
expect 1 "it is not a regular file" render scene.rt -o pipe.mp4 "${options[@]}"
rm -r still.rt scene.mp4 folder.mp4 pipe.mp4
expect_only bin bin/ffmpeg scene.rt whole some film.mp4

# begun SIZE: starts a film that would take minutes, and waits until ffmpeg has got some of it.
begun() {
    local waited
    "$strahl" render scene.rt -o film.mp4 --size "$1" --fps 100000 --samples 1 2>said &
    pid=$!
    for ((waited = 0; waited < 1200; ++waited)); do
        compgen -G '.strahl-*.tmp' >/dev/null && (($(stat -c %s .strahl-*.tmp) > 300000)) && return
        sleep .05
    done
    fault "no film was begun: $(<said)"
}
# frames_in FILE SIZE: whole frames, as many as the program says
frames_in() {
    local last head
    last=$(sed -n "s/.*'film.part.mp4' ends with frame \([0-9]*\) of 399999$/\1/p" said)
    [[ $last ]] || fault "after an interruption it said: $(<said)"
    head=$(head -1 "$1" | wc -c)
    (($(stat -c %s "$1") == head + (last + 1) * (6 + 3 * $2))) || fault "$1 has $(stat -c %s "$1") bytes, $(<said)"
}
for signal in INT TERM HUP; do
    begun 32x24
    kill -s "$signal" -- -"$pid" # to the group, as a terminal does
    wait "$pid"
    (($? == 130)) || fault "exit status $? after SIG$signal; it said: $(<said)"
    frames_in film.part.mp4 $((32 * 24))
    rm film.part.mp4
done
[[ $(<film.mp4) == "an older film" ]] || fault "the older film is gone"
# Killed: the next run removes what is left.
begun 32x24
kill -s KILL "$pid"
wait "$pid" 2>/dev/null
compgen -G '.strahl-*' >/dev/null || fault "there was nothing to remove"
expect 0 "" render scene.rt -o film.mp4 "${options[@]}"
expect_same film.mp4 whole
! compgen -G '.strahl-*' || fault "a killed run's film stays"

# ffmpeg itself: its film has the colours of the frames.
PATH=$system_path
command -v ffmpeg >/dev/null || fault "ffmpeg is not installed"
if command -v ffmpeg >/dev/null; then
    expect 0 "" render scene.rt -o long.mp4 --size 16x16 --fps 119.88 --samples 1
    length=$(ffmpeg -i long.mp4 2>&1 | sed -n 's/ *Duration: \([^,]*\),.*/\1/p')
    [[ $length == 00:00:04.00 ]] || fault "480 frames at 120000/1001 last $length"
    [[ $(ffmpeg -i long.mp4 2>&1) == *" 119.88 fps"* ]] || fault "the film of 119.88: $(ffmpeg -i long.mp4 2>&1)"
    for ending in mp4 mkv webm; do
        expect 0 "" render scene.rt -o "real.$ending" --size 96x72 --fps 3 --samples 1
        rm -f ./*.png
        ffmpeg -v error -i "real.$ending" frame-%02d.png || fault "ffmpeg cannot read real.$ending"
        [[ $(echo frame-*.png) == *frame-12.png ]] || fault "real.$ending has the frames $(echo frame-*.png)"
        expect 0 "" render scene.rt -o still.png --size 96x72 --time 3 --samples 1
        error=$(compare -metric RMSE frame-10.png still.png null: 2>&1 | sed 's/.*(\(.*\))/\1/')
        awk -v e="$error" 'BEGIN { exit !(e < .02) }' || fault "real.$ending differs by $error from its frames"
        # The tones of this file begin every half second; the film ends with its frames, after 3 s.
        cp "$source_folder/tests/window/clicks.ogg" .
        echo 'music { sound "clicks.ogg" }' | cat scene.rt - >loud.rt
        expect 0 "" render loud.rt -o "loud.$ending" --size 32x24 --fps 8 --samples 1 --frames 2-25
        ffmpeg -v error -i "loud.$ending" -ac 1 -ar 44100 -f s16le - 2>/dev/null | od -An -v -td2 -w2 |
            awk '$1 > 2000 || $1 < -2000 { if (NR - last > 8000) print NR / 44100; last = NR }' >tones
        awk -v n=0 '{ d = $1 - (.25 + .5 * n++); if (d < -.005 || d > .005) n = 99 } END { exit n != 6 }' tones ||
            fault "the tones of loud.$ending begin at $(tr '\n' ' ' <tones)"
    done
fi
finish
