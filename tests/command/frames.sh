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

# Only missing frames are rendered.
cp film-0003.png good.png
rm film-0003.png
echo "not a picture" >film-0004.png
expect 0 '"frames": 1,' render scene.rt -o 'film-%04d.png' --frames 0-8 "${options[@]}" --resume --stats -
expect_same film-0003.png good.png
[[ $(<film-0004.png) == "not a picture" ]] || fault "--resume wrote a frame that was there"
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
