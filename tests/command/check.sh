#!/usr/bin/env bash
# strahl check: its summary of a scene, and that the scene it prints is the same.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

for line in "scene.rt: no errors" "4: 2 spheres, 1 plane, 1 cylinder" "transparent  1 body" "lights       2" \
    "flythrough   4 s, 2 keys" "bounds       <-3.7, -3, 0> to <3.5, 2, 4>, and unbounded bodies" "depth        20"; do
    expect 0 "$line" check scene.rt
done
[[ $("$strahl" check - <scene.rt) == "standard input: no errors"* ]] || fault "standard input is not checked"

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

# check must start at once: the picture library is not linked.
if ldd "$strahl" | grep -q OpenImageIO; then fault "strahl links OpenImageIO"; fi
finish
