#!/usr/bin/env bash
# Wrong command lines: exit status 2 and a helpful message; --help and --version.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

expect 0 "Usage: strahl" --help
expect 0 "--size WxH" render --help
expect 0 "--print" check --help
expect 0 "--benchmark" play --help
expect 0 "--tolerance" compare --help
[[ $("$strahl" --version) =~ ^strahl\ [0-9]+\.[0-9]+\.[0-9]+\ \(.+,\ [0-9]+\ float\ lanes,\ [0-9]+\ double\)$ ]] ||
    fault "the version reads: $("$strahl" --version)"

expect 2 "Usage: strahl"
expect 2 "did you mean 'render'?" rendr scene.rt
expect 2 "there is no command 'frobnicate'; the commands are view, play, render, join, check" frobnicate
expect 2 "strahl --help" --frobnicate
expect 2 "SCENE is required" render
expect 2 "SCENE is required" check
expect 2 "--benchmark" play scene.rt --stats x.json
expect 2 "not expected" check scene.rt scene.rt
expect 2 "did you mean '--size'?" render scene.rt -o x.bmp --sizes 5x5

# refuse TEXT OPTION...: options that `strahl render` refuses.
refuse() { expect 2 "$1" render scene.rt "${@:2}"; }
refuse "Add -o FILE"
refuse ".bmp, .png or .exr" -o x.jpg
refuse ".bmp, .png or .exr" -o x
refuse "--format bmp, png, exr, ppm or y4m" -o -
refuse "the file's ending chooses its format" -o x.png --format png
refuse "--format" -o - --format jpg
refuse "choose .png for 16" -o x.bmp --bits 16
refuse "float" -o x.exr --bits 16
refuse "--bits" -o x.bmp --bits 9
for size in 640 0x5 5x0 -3x5 3x x3 3x3x3 1e3x5 99999999999x5 1000001x1 ''; do refuse "--size" -o x.bmp "--size=$size"; done
refuse "TB of memory" -o - --format png --size 1000000x1000000
refuse "too many for a .bmp" -o x.bmp --size 30000x30000
for crop in 1,2,3 0,0,0,5 0,0,5,0 -1,0,5,5 1,2,3,4,5 a 60,0,5,5 0,40,5,9 99999999999,0,1,1 2147483647,0,2147483647,1; do
    refuse "--crop" -o x.bmp --size 64x48 "--crop=$crop"
done
for depth in 0 257 x 1.5 -1; do refuse "--depth" -o x.bmp --depth "$depth"; done
for threads in 0 -1 x 1000000; do refuse "--threads" -o x.bmp --threads "$threads"; done
refuse "{float,double,extended}" -o x.bmp --precision half
refuse "{auto,scalar,v2,v3,v4,neon}" -o x.bmp --simd v5
for time in -1 nan inf x; do refuse "--time" -o x.bmp --time "$time"; done
for fps in 0 -1 nan inf x; do refuse "--fps" -o x.bmp --frames 0-1 --fps "$fps"; done
for frames in 5-2 1- -1 x 1-2-3 0-9999999999; do refuse "--frames" -o x.bmp "--frames=$frames"; done
refuse "exclude each other" -o x.bmp --frames 0-1 --time 1
refuse "need a file" -o - --format bmp --resume
refuse "need a file" -o - --format bmp --part 1/2
refuse "numbered files" -o - --format bmp --frames 0-1
refuse "standard output" -o - --format bmp --stats -
refuse "in double" -o x.bmp --prove map.png --precision float
refuse "one ray in each pixel" -o x.bmp --prove map.png --samples 2x2
refuse "one picture" -o x.bmp --prove map.png --frames 0-1
refuse ".png or .bmp" -o x.bmp --prove map.exr
refuse "overwrite the picture" -o x.png --prove x.png
sed '/^flythrough/,$d' scene.rt >still.rt
expect 2 "needs a scene with a flythrough" render still.rt -o x.bmp --time 1
expect 2 "needs a scene with a flythrough" render still.rt -o x.bmp --frames 0-1
expect 2 "needs a scene with a flythrough" crosscheck still.rt --time 1
expect 2 "needs a scene with a flythrough" pov still.rt -o x.pov --animation
expect 2 "needs a scene with a track" view still.rt --rocket
expect 2 "--rocket-port" view still.rt --rocket --rocket-port 70000
expect 2 "--rocket" view still.rt --rocket-port 1338
sed 's/^camera/fog { distance 99  color <0, 0, track "sky"> }\n&/' still.rt >tracks.rt
expect 2 "cannot follow the tracks of tracks.rt" pov tracks.rt -o x.pov --animation
rm tracks.rt

rm still.rt
expect_only scene.rt
finish
