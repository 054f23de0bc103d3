#!/usr/bin/env bash
# Scenes of POV-Ray: the commands that open them, what they tell, and that options reach them.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

mkdir -p shared
echo '#declare Blue = pigment { rgb z }' >shared/blue.inc
cat >ball.pov <<'POV'
#include "blue.inc"
camera { location -6*z look_at 0 angle 40 }
light_source { <-5, 5, -9> rgb 1 }
sphere { <clock, 0, 0>, 1 pigment { Blue } finish { diffuse .6, .2 } }
sphere { 0, 1 pigment { Blue } interior { media { emission .1 } } hollow }
POV
sed -e 's|, .2 }| }|' -e '/media/d' ball.pov >whole.pov

expect 3 "cannot find 'blue.inc'" check ball.pov
expect 0 "ball.pov:4: approximated: light from behind" check ball.pov --library shared
expect 0 "ball.pov:5: left out: media" check ball.pov --library shared
expect 0 "approximated in 1 place, left out in 1 place" check ball.pov --library shared
expect 0 "opens whole" check whole.pov --library shared
expect 3 "the scene cannot be shown as it is meant" check ball.pov --library shared --strict
expect 0 "" check whole.pov --library shared --strict
expect 0 "position <0, 0, 6>" check ball.pov --library shared --print
expect 0 "sphere { <0.5, 0, 0>, 1" import whole.pov --library shared --clock .5
expect 0 "strahl: warning: ball.pov:5: left out" render ball.pov --library shared -o ball.png --size 64x48
"$strahl" import ball.pov --library shared -o same.rt 2>/dev/null
"$strahl" render same.rt -o same.png --size 64x48 --quiet
expect_same ball.png same.png
expect 2 "convert ball.pov with strahl import first" bundle ball.pov -o bundle
echo 'sphere { 0, 1 colour }' >wrong.pov
expect 3 "wrong.pov:1:" render wrong.pov -o wrong.png
[[ ! -e wrong.png ]] || fault "a scene with an error has a picture"
finish
