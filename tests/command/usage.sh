#!/usr/bin/env bash
# Wrong command lines: exit status 2 and a helpful message; --help and --version.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
unset DISPLAY WAYLAND_DISPLAY

expect 0 "Usage: strahl" --help
expect 0 "--size WxH" render --help
for columns in 60 100; do
    long=$(COLUMNS=$columns "$strahl" render --help | sed '1,/^Options:/d; /^Still:/,$d' | awk -v "most=$columns" 'length > most')
    [[ -z $long ]] || fault "--help is wider than $columns columns: $long"
done
expect 0 "--print" check --help
expect 0 "--benchmark" play --help
expect 0 "--tolerance" compare --help
[[ $("$strahl" --version) =~ ^strahl\ [0-9]+\.[0-9]+\.[0-9]+\ for\ (Linux|Windows)\ \(.+,\ [0-9]+\ float\ lanes,\ [0-9]+\ double\)$ ]] ||
    fault "the version reads: $("$strahl" --version)"

# The usual words for both.
expect 0 "Usage: strahl" help
expect 0 "--size WxH" help render
for word in version -v -V; do
    [[ $("$strahl" $word) == "$("$strahl" --version)" ]] || fault "strahl $word prints: $("$strahl" $word 2>&1)"
done

# An option of another command.
expect 2 "'-o' is not expected here; did you mean strahl render scene.rt -o x.png?" scene.rt -o x.png
expect 2 "did you mean strahl render scene.rt --samples 4x4 -o 'a b.png'?" scene.rt --samples 4x4 -o 'a b.png'
expect 2 "'--output=x.png' is not expected here; did you mean strahl render scene.rt --output=x.png?" scene.rt --output=x.png
expect 2 "'--tolerance' is not expected here; strahl compare has it" render scene.rt -o x.bmp --tolerance 1
expect 2 "; strahl play has it" scene.rt --benchmark
expect 1 "cannot open a window" view

expect 2 "Usage: strahl"
expect 2 "did you mean 'render'?" rendr scene.rt
expect 2 "there is no command 'frobnicate'; the commands are view, play, render, " frobnicate
expect 2 "strahl --help" --frobnicate
expect 2 "SCENE is required" render
expect 2 "SCENE is required" check
expect 2 "--benchmark" play scene.rt --stats x.json
expect 2 "not expected" stability scene.rt scene.rt
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
for word in single float32 flaot; do refuse "$word not in {float,double,extended}; did you mean 'float'?" -o x.bmp --precision $word; done
refuse "long double not in {float,double,extended}; did you mean 'extended'?" -o x.bmp --precision "long double"
refuse "did you mean 'v3'?" -o x.bmp --simd avx2
refuse "9 not in {8,16,32}" -o x.bmp --bits 9
# No program has the instructions of both architectures.
if [[ $(uname -m) == x86_64 ]]; then
    refuse "this program was built without neon" -o x.bmp --simd neon
else
    refuse "this program was built without x86-64-v3" -o x.bmp --simd v3
fi
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
sed 's/camera {/camera { orthographic/' scene.rt >parallel.rt
expect 2 "perspective cameras with one eye only" render parallel.rt -o x.bmp --prove map.png
rm parallel.rt
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

expect 0 "--compression is for .png files" render still.rt -o x.bmp --size 8x6 --compression small
rm x.bmp

# A line says at a terminal what was written, in place of the progress if that was shown.
script -qec "'$strahl' render still.rt -o x.bmp --size 8x6" said </dev/null >/dev/null
grep -qE $'(^|\e\\[K)x.bmp: 8x6, [0-9.]* s' said || fault "does not say what was written: $(<said)"
script -qec "'$strahl' render still.rt -o x.bmp --size 8x6 --quiet" said </dev/null >/dev/null
! grep -q '8x6, ' said || fault "--quiet says: $(<said)"
[[ -z $("$strahl" render still.rt -o x.bmp --size 8x6 2>&1) ]] || fault "says something without a terminal"
rm said x.bmp

rm still.rt
expect_only scene.rt
finish
