#!/usr/bin/env bash
# strahl crosscheck, most of it with stand-ins for povray: what it makes of nonsense, and that nothing is left when it is
# stopped.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
set -m # a shell without job control starts what it puts into the background with SIGINT ignored

# POV-Ray itself, with spaces in the names of a file and of a folder of included ones.
mkdir "in cluded"
echo '#declare Radius = 1;' >"in cluded/radius.inc"
echo '#include "radius.inc" camera { location -5*z look_at 0 } light_source { <-5,5,-5> 1 } sphere { 0, Radius }' \
    >"two words.pov"
expect 0 "| two words.pov " crosscheck "two words.pov" --size 32x24 --library "in cluded"

# Random meshes, whose bumps and fine patterns show where the planes of triangles are to 1e-7.
seed=$RANDOM
cat >planes.pov <<TEXT
camera { location <50, 55, -20> look_at <50, 42, 0> } light_source { <20, 90, -50> 1 } sky_sphere { pigment { granite } }
#declare R = seed($seed);
#macro P() <40 + 20*rand(R), 36 + 12*rand(R), 8*rand(R)> #end
#macro N() <rand(R) - .5, 2, rand(R) - .5> #end
#declare Look = texture { pigment { granite scale .05 } normal { bumps .3 scale .02 } finish { reflection .6 } }
mesh { #for (I, 1, 20) triangle { P(), P(), P() } smooth_triangle { P(), N(), P(), N(), P(), N() } #end texture { Look } }
mesh2 { vertex_vectors { 30, #for (I, 1, 30) P() #end }
        face_indices { 10, #for (I, 0, 9) <3*I, 3*I + 1, 3*I + 2> #end } texture { Look } rotate 9*y scale 1.1 }
TEXT
said=$("$strahl" crosscheck planes.pov --size 64x48 2>&1)
awk -F'|' '$2 ~ /planes/ { found = $5 < 9 } END { exit !found }' <<<"$said" || fault "seed $seed: $said" # of 3072 pixels

echo 'camera { location -5*z look_at 0 } light_source { <-5,5,-5> 1 } sphere { clock*x, 1 + clock_on/2 }' >clock.pov
expect 0 "| clock.pov " crosscheck clock.pov --size 32x24
expect 0 "| clock.pov " crosscheck clock.pov --size 32x24 --clock .3

# Pictures with holes: by their own alpha channel and by another picture, repeated and once.
convert -size 4x4 xc:red -fill '#2060c0' -draw 'point 0,0 point 3,2' leaf.png
convert leaf.png \( -size 4x4 gradient: \) -alpha off -compose CopyOpacity -composite holes.png
{ echo 'camera { position <1,-6,1> look_at <0,0,0> sky <0,0,1> angle 50 } light { position <-5,-5,5> color <1,1,1> }
    defaultmaterial { reflection 0 } sphere { <0,3,0>, 2 }'
  for place in '-2.1 -2.1 "holes.png" opacity .9 translate <.2,0,0>' '.1 -2.1 "holes.png" mask .5' \
      '-2.1 .1 "leaf.png" opacity_of "holes.png" once <1,1,0> translate <.1,.1,0>' \
      '.1 .1 "holes.png" opacity_of "leaf.png"'; do
      read -r x z image <<<"$place"
      echo "box { <0,0,0>, <2,.1,2> material { rgb image { $image rotate <90,0,0> } } translate <$x,0,$z> }"
  done; } >holes.rt
expect 0 "| holes " crosscheck holes.rt --size 64x48

# Pictures through a lens are made of rays that each program chooses for itself.
echo 'camera { position <0,-5,0> look_at <0,0,0> sky <0,0,1> angle 50  aperture .3  focus 2 }
    light { position <-5,-5,5> color <1,1,1> } sphere { <0,0,0>, 1 }' >lens.rt
expect 0 "lens.rt: compared through the middle of its lens" crosscheck lens.rt --size 32x24
sed -e 's/aperture .3  focus 2/shutter .1/' -e 's/, 1 }/, 1 motion { key { time 0 } key { time 1 translate <9,0,0> } } }/' \
    lens.rt >shutter.rt
expect 0 "shutter.rt: compared in the middle of the time its shutter is open" crosscheck shutter.rt --size 32x24
expect 0 "POV-Ray has no shutter" pov shutter.rt -o shutter.pov
grep -q "POV-Ray has no shutter" shutter.pov || fault "shutter.pov has no word about its shutter"
sed 's/aperture .3  focus 2/side_by_side .1/' lens.rt >eyes.rt
expect 0 "eyes.rt: compared as seen from between its two eyes" crosscheck eyes.rt --size 32x24
expect 0 "POV-Ray has no pictures for two eyes" pov eyes.rt -o eyes.pov
expect 2 "two eyes need an even width" render eyes.rt -o eyes.png --size 33x24
echo 'camera { location -5*z look_at 0 aperture 1 focal_point 2*z blur_samples 9 } sphere { 0, 1 }' >lens.pov
expect 1 "lens.pov: its camera has an aperture" crosscheck lens.pov --size 32x24

# Clear cylinders end in one plane: POV-Ray shows the one or the other.
glass='pigment { rgbt <1, 0, 0, .5> }'
echo "camera { location -5*z look_at 0 } light_source { <-5,5,-5> 1 }
    cylinder { 0, x, .5 $glass rotate <10,60,30> } cylinder { 0, -x, .5 pigment { rgbt <0,1,0,.5> } rotate <10,60,30> }" \
    >ends.pov
said=$("$strahl" crosscheck ends.pov --size 32x24 --threads 1)
awk -F'|' '$2 ~ /ends/ { found = $5 == 0 && $7 > 2 } END { exit !found }' <<<"$said" || fault "ends.pov: $said"

mkdir tools tmp
export PATH="$work/tools:$PATH" TMPDIR="$work/tmp"
# povray LINES: the stand-in, which runs in the folder with scene.pov.
povray() { printf '#!/bin/bash\n%s\n' "$1" >tools/povray && chmod +x tools/povray; }
nothing_left() { [[ -z $(ls -A tmp) ]] || fault "left behind: $(ls -A tmp)"; }
check() { expect "$1" "$2" crosscheck scene.rt --size 32x24 --depth 2; }

expect 0 "" render scene.rt -o "$work/right.png" --size 32x24 --depth 2 --bits 16 --samples 1
expect 0 "" render scene.rt -o "$work/wrong.png" --size 24x32 --depth 2 --bits 16 --samples 1
povray "cp $work/right.png scene.ppm"
check 0 " 0.000 |"
for seconds in ...... 1.2.3 . 1e999 99999999999999999999999999999999999999999; do
    povray "cp $work/right.png scene.ppm; echo 'Trace Time:   0 hours (${seconds} seconds)'"
    check 0 "| scene "
done
said=$("$strahl" crosscheck scene.rt --size 32x24 --depth 2 2>&1)
[[ $said != *stod* ]] || fault "it says: $said"
povray ":"
check 1 "its picture is not the requested one"
povray "cp $work/wrong.png scene.ppm"
check 1 "24x32 pixels"
povray "echo nonsense >scene.ppm"
check 1 "is not a .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm or .pfm file"
povray $'printf "\\e[31mred\\n"; exit 3'
said=$("$strahl" crosscheck scene.rt 2>&1)
[[ $said == *red* && $said != *$'\e'* ]] || fault "povray's words steer the terminal"
nothing_left

povray "echo \$\$ >'$work/started'; exec sleep 60"
for signal in TERM INT HUP; do
    rm -f started
    "$strahl" crosscheck scene.rt >said 2>&1 &
    pid=$!
    for ((i = 0; i < 100; ++i)); do
        [[ -s started ]] && break
        sleep .05
    done
    kill -s "$signal" "$pid"
    wait "$pid"
    status=$?
    ((status == 130)) || fault "exit status $status after SIG$signal: $(<said)"
    if kill -0 "$(<started)" 2>/dev/null; then
        fault "povray goes on after SIG$signal"
        kill "$(<started)"
    fi
    nothing_left
    rm -rf tmp/*
done
finish
