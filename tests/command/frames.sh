#!/usr/bin/env bash
# strahl render --frames: numbered files, their times, and --resume.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

options=(--size 32x24 --fps 2 --samples 1)
expect 0 "" render scene.rt -o 'film-%04d.png' --frames 0-8 "${options[@]}"
expect_only scene.rt film-000{0..8}.png
for moment in 0=0 3=1.5 8=4; do
    expect 0 "" render scene.rt -o still.png --size 32x24 --samples 1 --time "${moment#*=}"
    expect_same still.png "film-000${moment%=*}.png"
done
expect_other film-0000.png film-0003.png

# Only what is missing, or not a whole picture, is made again.
export LSAN_OPTIONS="suppressions=$source_folder/tests/command/leaks.txt"
cp film-0003.png good.png
mkdir good
cp film-0004.png film-0005.png film-0006.png good
rm film-0003.png
: >film-0004.png
head -c 400 good/film-0005.png >film-0005.png
head -c "$(stat -c %s good/film-0006.png)" /dev/zero >film-0006.png
touch -d yesterday film-0007.png
date=$(stat -c %y film-0007.png)
expect 0 '"frames": 4,' render scene.rt -o 'film-%04d.png' --frames 0-8 "${options[@]}" --resume --stats -
expect_same film-0003.png good.png
for frame in 4 5 6; do expect_same film-000$frame.png good/film-000$frame.png; done
[[ $(stat -c %y film-0007.png) == "$date" ]] || fault "--resume wrote a frame that was there"
: >film-0004.png
expect 0 "film-0004.png' is not a .bmp" render scene.rt -o 'film-%04d.png' --frames 4 "${options[@]}" --resume
expect 2 "32x24 pixels and not 64x48" render scene.rt -o 'film-%04d.png' --frames 0-8 --size 64x48 --resume
expect_same film-0003.png good.png
rm -r good
expect 0 '"frames": 0,' render scene.rt -o 'film-%04d.png' --frames 0-8 "${options[@]}" --resume --stats -
expect 0 '"frames": 9,' render scene.rt -o 'film-%04d.png' --frames 0-8 "${options[@]}" --stats -

# Other forms of the number.
rm -f ./*.png
expect 0 "" render scene.rt -o x.bmp --frames 7 "${options[@]}"
expect 0 "" render scene.rt -o 'a%db.bmp' --frames 9-10 "${options[@]}"
expect 0 "" render scene.rt -o '50%-%3d%s.bmp' --frames 12345-12345 "${options[@]}"
expect 0 "" render scene.rt -o '%03d.bmp' --frames 7 "${options[@]}"
expect_only scene.rt x-0007.bmp a9b.bmp a10b.bmp '50%-12345%s.bmp' 007.bmp
# Without --frames a % in the name has no meaning.
expect 0 "" render scene.rt -o '%04d.bmp' --size 4x3
expect_file '%04d.bmp'
rm -f ./*.bmp

# Lists: each frame once, and the shares of a list are all of it.
expect 0 '"frames": 10,' render scene.rt -o 'a%d.bmp' --frames 1-3,5,2-4,7-12:2,20-25x4 "${options[@]}" --stats -
expect_only scene.rt a{1,2,3,4,5,7,9,11,20,24}.bmp
rm a{3,7}.bmp
for part in 1 2 3; do
    expect 0 "" render scene.rt -o 'b%d.bmp' --frames 1,2,4,5-24x19,9-11:2,20 --part "$part/3" "${options[@]}"
    echo b*.bmp >>said
done
[[ $(<said) == "b1.bmp b11.bmp b5.bmp
b1.bmp b11.bmp b2.bmp b20.bmp b24.bmp b5.bmp
b1.bmp b11.bmp b2.bmp b20.bmp b24.bmp b4.bmp b5.bmp b9.bmp" ]] || fault "the shares are: $(<said)"
for file in a*.bmp; do expect_same "$file" "b${file#a}"; done
rm said ./*.bmp
for list in '' , 1, 1-2-3 1:0 2-1 1-3:x 1x 5-3x2 -1 1000000000 1-2:99999999999; do
    expect 2 "--frames" render scene.rt -o x.bmp --frames "$list"
done

# Streams.
expect 0 "" render scene.rt -o 'a%d.png' --frames 1-3 "${options[@]}"
"$strahl" render scene.rt -o - --format ppm --frames 1-3 "${options[@]}" >stream || fault "no stream"
for frame in 1 2 3; do convert "a$frame.png" ppm:-; done | cmp - stream || fault "the stream has other frames"
echo 'camera { position <0, 0, 0>  look_at <0, 1, 0>  sky <0, 0, 1>  fov 40 }  background { color <1, 0, 0> }' >red.rt
"$strahl" render red.rt -o - --format y4m --size 3x65 --fps 25 >still || fault "no picture for a stream"
"$strahl" render scene.rt -o - --format y4m --frames 0-1 --size 3x65 --fps 29.97002997 >stream || fault "no stream"
head -1 stream | grep -q '^YUV4MPEG2 W3 H65 F30000:1001 .*C444' || fault "it begins with $(head -c 80 stream)"
(($(stat -c %s stream) == $(head -1 stream | wc -c) + 2 * (6 + 3 * 3 * 65))) || fault "it has $(stat -c %s stream) bytes"
# Red in BT.709.
for plane in 0 1 2; do od -An -tu1 -N195 -j$((6 + 195 * plane)) -w195 -v still | tr -s ' ' '\n' | sort -u | tr -d '\n'; done |
    grep -qx 63102240 || fault "red is not 63, 102, 240"
expect 2 "can only go to standard output" render scene.rt -o x.ppm
finish
