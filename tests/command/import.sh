#!/usr/bin/env bash
# strahl import: what it writes and tells, and that nothing is lost when a file is wrong.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

cat >balls.nff <<'NFF'
# Two balls.
v
from 0 -9 3
at 0 0 1
up 0 0 1
angle 40
hither 1
resolution 64 48
b .1 .2 .3
l 5 -5 9
f 1 .3 .1 .8 .2 30 0 0
s -1 0 1 1
s 1.2 0 1 1
c 0 2 0 1 0 2 3 .5
NFF
cat >ball.dat <<'DAT'
BEGIN_SCENE
RESOLUTION 64 48
CAMERA ZOOM 1 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 4 CENTER 0 0 -5 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA
DIRECTIONAL_LIGHT DIRECTION 0 -1 1 COLOR 1 1 1
SPHERE CENTER 1 0 0 RAD 1 TEXTURE AMBIENT .1 DIFFUSE .9 SPECULAR 0 OPACITY 1
OUTLINE 1 OUTLINE_WIDTH .5 COLOR 1 .3 .1 TEXFUNC 0
END_SCENE
DAT

expect 0 "strahl: warning: balls.nff:14: cones and cylinders are open tubes" import balls.nff -o balls.rt
expect 0 "balls.nff:7: 'hither'" import balls.nff
expect 0 "// Imported from balls.nff. Its picture: --size 64x48" import balls.nff
expect 0 "3: 2 spheres, 1 cone" check balls.rt
"$strahl" import balls.nff >printed.rt 2>told.txt
expect_same printed.rt balls.rt
[[ $(wc -l <told.txt) == 2 ]] || fault "these are not two warnings: $(cat told.txt)"
"$strahl" import - <balls.nff 2>/dev/null | grep -q '^camera {' || fault "standard input is not imported"
expect 0 "" render balls.rt -o balls.bmp --size 64x48

expect 0 "ball.dat:6: OUTLINE: bodies have no outlines here" import ball.dat -o ball.rt
expect 0 "1 sphere" check ball.rt
# The ball is to the right, and lit from above.
expect 0 "" render ball.rt -o ball.bmp --size 64x48
expect 0 "" render ball.rt -o right.bmp --size 64x48 --crop 38,24,1,1
expect 0 "" render ball.rt -o left.bmp --size 64x48 --crop 25,24,1,1
expect 0 "" render ball.rt -o corner.bmp --size 64x48 --crop 0,0,1,1
expect_other right.bmp corner.bmp
expect_same left.bmp corner.bmp

# A file that is wrong leaves what is there.
sed 's/^s 1.2/s x/' balls.nff >wrong.nff
cp balls.rt before.rt
expect 3 "wrong.nff:13:3: a number expected for the centre, but found 'x'" import wrong.nff -o balls.rt
expect_same before.rt balls.rt
expect 3 "cannot read" import none.nff
expect 3 "no camera" import /dev/null
expect 3 "there is nothing to convert" import scene.rt
cp scene.rt scene.nff
expect 3 "scene.nff is a scene in Strahl's own language; there is nothing to convert" import scene.nff
cp balls.bmp picture.nff
expect 3 "picture.nff is a picture, not a scene" import picture.nff
rm scene.nff picture.nff
for command in check "render -o x.png" "stability -o x.png" "pov -o x.pov"; do
    # shellcheck disable=SC2086  # words of an option
    expect 3 "balls.bmp is a picture, not a scene" $command balls.bmp
done
expect 2 "would overwrite the file to import" import balls.nff -o ./balls.nff
expect 1 "its folder does not exist" import balls.nff -o none/balls.rt
expect 2 "FILE is required" import
expect_only balls.nff ball.dat wrong.nff scene.rt balls.rt before.rt ball.rt printed.rt told.txt balls.bmp ball.bmp right.bmp left.bmp corner.bmp
finish
