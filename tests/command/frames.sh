#!/usr/bin/env bash
# strahl render --frames: numbered files, their times, and --resume.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

options=(--size 32x24 --fps 2)
expect 0 "" render scene.rt -o 'film-%04d.png' --frames 0-8 "${options[@]}"
expect_only scene.rt film-000{0..8}.png
for moment in 0=0 3=1.5 8=4; do
    expect 0 "" render scene.rt -o still.png --size 32x24 --time "${moment#*=}"
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
expect 0 "film-0004.png' as a picture" render scene.rt -o 'film-%04d.png' --frames 4 "${options[@]}" --resume
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
finish
