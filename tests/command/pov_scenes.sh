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
sphere { <clock, 0, 0>, 1 pigment { Blue } finish { diffuse .6 reflection { .1 exponent 2 } } }
sphere { 0, 1 pigment { Blue } interior { media { emission .1 } } hollow }
POV
sed -e 's| reflection { .1 exponent 2 }||' -e '/media/d' ball.pov >whole.pov

expect 3 "cannot find 'blue.inc'" check ball.pov
expect 0 "ball.pov:4: approximated: 'exponent' of a reflection" check ball.pov --library shared
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
# The size that a scene asks for is that of its picture, in every command.
sed 's|camera {|camera { right x*image_width/image_height|' whole.pov >sized.pov
expect 0 "| sized.pov" crosscheck sized.pov --library shared --size 64x36
"$strahl" import sized.pov --library shared -o sized.rt 2>/dev/null
for size in 64x36 36x64 40x40; do
    expect 0 "" render sized.pov --library shared -o sized.png --size $size
    expect 0 "" render sized.rt -o same.png --size $size
    expect_same sized.png same.png
done
# A loop that makes bodies for ever ends long before memory does.
echo '#declare I = 0; #while (I >= 0) sphere { I, 1 pigment { rgb 1 } } #declare I = I + 1; #end' >endless.pov
if (ulimit -v 2000000 && "$strahl" --version >/dev/null 2>&1); then
    said=$(ulimit -v 2000000; "$strahl" check endless.pov 2>&1) && fault "an endless loop opened"
    [[ $said == *"endless.pov:1:33: the scene's bodies need too much memory; more than "*"half of the memory that is"* ]] ||
        fault "an endless loop in little memory: $said"
else
    left_out "this build of strahl does not run in 2 GB of address space"
fi
expect 2 "convert ball.pov with strahl import first" bundle ball.pov -o bundle
echo 'sphere { 0, 1 colour Unknown }' >wrong.pov
expect 3 "wrong.pov:1:" render wrong.pov -o wrong.png
[[ ! -e wrong.png ]] || fault "a scene with an error has a picture"

# The clock runs during a film, as the .ini file says; no command of that is run.
cat >film.ini <<'INI'
Input_File_Name=moving.pov
Width=32
Height=24
Initial_Frame=1
Final_Frame=3
Pre_Scene_Command=touch commanded
[late]
Initial_Clock=5
INI
sed 's/include.*/declare Blue = pigment { rgb z }/' whole.pov >moving.pov
expect 0 "Pre_Scene_Command: commands are never run" check film.ini
expect 0 "0.12 s, by the clock of POV-Ray" check film.ini
expect 0 "10 s, by the clock" check moving.pov
expect 3 "there is no section 'none'" check 'film.ini[none]'
expect 0 "" render film.ini -o 'film-%d.png' --frames 0-2
for frame in 0 1 2; do
    expect 0 "" render moving.pov -o still.png --size 32x24 --clock "$((frame / 2)).$((frame % 2 * 5))"
    expect_same still.png film-$frame.png
done
expect 0 "--frames 0-2 makes all frames" render film.ini -o still.png
expect 0 "" render film.ini -o still.png --time .04
expect_same still.png film-1.png
expect 0 "" render 'film.ini[late]' -o still.png --size 16x12
"$strahl" render moving.pov -o five.png --size 16x12 --clock 5 --quiet
expect_same still.png five.png
expect_no_file commanded
cat >moving.flight <<'FLIGHT'
flythrough {
  duration 2
  key { time 0  position <0, 0, -6>  look_at <0, 0, 0> }
  key { time 2  position <1, 0, -6>  look_at <0, 0, 0> }
}
FLIGHT
expect 0 "2 s, 2 keys" check moving.pov
expect 0 "" render moving.pov -o flown.png --size 32x24 --time 1
expect_other flown.png film-1.png
finish
