#!/usr/bin/env bash
# strahl check: its summary of a scene, and that the scene it prints is the same.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

for line in "scene.rt: no errors" "4: 2 spheres, 1 plane, 1 cylinder" "transparent  1 body" "lights       2" \
    "flythrough   4 s, 2 keys" "bounds       <-3.7, -3, 0> to <3.5, 2, 4>, and unbounded bodies" "depth        20"; do
    expect 0 "$line" check scene.rt
done
[[ $("$strahl" check - <scene.rt) == "standard input: no errors"* ]] || fault "standard input is not checked"

# Of several scenes each is reported, also after one with an error.
echo 'ball {' >wrong.rt
expect 3 "wrong.rt:1:1" check scene.rt wrong.rt scene.rt
[[ $("$strahl" check scene.rt wrong.rt scene.rt 2>/dev/null | grep -c 'no errors') == 2 ]] ||
    fault "an error ends the check of other scenes"

expect 0 "camera {" check --print scene.rt
"$strahl" check --print scene.rt >printed.rt
"$strahl" check --print printed.rt >again.rt
expect_same printed.rt again.rt
expect 0 "" render scene.rt -o scene.exr --size 32x24
expect 0 "" render printed.rt -o printed.exr --size 32x24
expect_same scene.exr printed.exr

# Bounds follow transformations.
echo 'camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 } sphere { <0,0,0>, 1 scale 2 rotate <0,0,90> translate <10,0,0> }' >moved.rt
expect 0 "bounds       <8, -2, -2> to <12, 2, 2>" check moved.rt
echo 'camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 }' >empty.rt
expect 0 "no bodies" check empty.rt

# What is hardly meant is warned of, on standard error, and nothing is where all is well.
warned() { # WARNING SCENE
    echo "$2" >odd.rt
    expect 0 "strahl: warning: $1" check odd.rt
    "$strahl" check odd.rt 2>/dev/null | grep -q warning && fault "the warning is on standard output"
    [[ $("$strahl" check odd.rt 2>&1 >/dev/null | wc -l) == 1 ]] || fault "more than one warning: $("$strahl" check odd.rt 2>&1)"
}
eye='camera { position <0,-9,0> look_at <0,0,0> sky <0,0,1> angle 50 }'
light='light { position <0,-9,9> color <1,1,1> }'
ball='sphere { <0,0,0>, 1 }'
[[ ! $("$strahl" check scene.rt 2>&1 >/dev/null) ]] || fault "warned: $("$strahl" check scene.rt 2>&1 >/dev/null)"
warned "the scene has no light" "$eye $ball"
nothing="the camera sees no body; all are behind it or beside its picture"
warned "$nothing" "$eye $light sphere { <0,-12,0>, 1 }"
warned "$nothing" "$eye $light sphere { <8,0,0>, 1 } sphere { <0,0,-8>, 1 }"
warned "$nothing" "$eye $light plane { <0,-12,0>, <1,-12,0>, <0,-12,1> }"
warned "$nothing" "${eye/angle 50/angle 50 aspectratio 4} $light sphere { <0,0,2.5>, 1 }"
for body in "sphere { <3.5,0,0>, 1 }" "plane { <0,-12,0>, <1,-12,0>, <0,-10,-.4> }" "plane { <0,0,-1>, <1,0,-1>, <0,1,-1> }" \
    "box { <-20,-20,-20>, <20,20,20> }" "sphere { <0,-12,0>, 1 motion { key { time 0 translate <0,9,0> } key { time 1 } } }"; do
    echo "$eye $light $body" >odd.rt
    [[ ! $("$strahl" check odd.rt 2>&1 >/dev/null) ]] || fault "$body: $("$strahl" check odd.rt 2>&1 >/dev/null)"
done
warned "the colour <255, 128, 0> of a material is far above 1" "$eye $light sphere { <0,0,0>, 1 material { rgb <255,128,0> } }"
warned "the colour <200, 0, 0> of a light" "$eye $ball light { position <0,-9,9> color <200,0,0> }"
warned "the colour <0, 0, 255> of the background" "$eye $light $ball background { color <0,0,255> }"

# check must start at once: the picture library is not linked.
if ldd "$strahl" | grep -q OpenImageIO; then fault "strahl links OpenImageIO"; fi
finish
