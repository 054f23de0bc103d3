#!/usr/bin/env bash
# Pictures with alpha and layers: what their files hold, what refuses them, and that they can be continued and joined.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

cat >glass.rt <<'SCENE'
camera { position <0, -9, 1> look_at <0, 0, 0> up <0, 0, -1> fov 20 }
background { color <.2, .4, .8> }
light { position <-5, -9, 9> color <1, 1, 1> }
light { position <9, -5, 3> color <.5, .2, .2> }
sphere { <-1.5, 0, 0>, 1 material { rgb <.9, .5, .2> reflection .3 ambient .2 } }
sphere { <.8, 0, 0>, .9 material { rgb <1, 1, 1> reflection .1 refraction .7 ior 1.3 diffuse .1 } }
box { <1.5, 1, -1>, <2.5, 2, 1> }
SCENE
size=(--size 90x150)
layers=(--layers alpha,depth,normal,position,body,material,light)

# Formats that cannot hold them are refused before anything is traced, and wrong names are told the right ones.
expect 2 "holds no alpha; choose .png or .exr" render glass.rt -o a.bmp --alpha
expect 2 "films hold no alpha" render glass.rt -o a.mp4 --alpha
expect 2 "holds no alpha" render glass.rt -o - --format ppm --alpha
expect 2 "--layers is for .exr files" render glass.rt -o a.png --layers depth
expect 2 "layers are alpha, depth, normal, position, body, material, light" render glass.rt -o a.exr --layers dept
expect 2 "leave --alpha and --layers out" render glass.rt -o a.png --prove map.png --alpha
expect_only glass.rt scene.rt

# A part of a layered picture, an interrupted one and a whole one are the same.
expect 0 "" render glass.rt "${size[@]}" "${layers[@]}" -o whole.exr
for part in 1 2; do expect 0 "" render glass.rt "${size[@]}" "${layers[@]}" -o parts.exr --part "$part/2"; done
expect 0 "" join parts.exr.part-* -o parts.exr
expect_same parts.exr whole.exr
"$strahl" render glass.rt "${size[@]}" "${layers[@]}" -o again.exr --checkpoint 0 --threads 1 2>said &
pid=$!
for ((i = 0; i < 200; ++i)); do [[ -s again.exr.checkpoint || -s again.exr ]] && break || sleep .02; done
kill -s KILL "$pid" 2>/dev/null
wait "$pid" 2>/dev/null
if [[ -s again.exr.checkpoint ]]; then
    expect 2 "was begun with other options" render glass.rt "${size[@]}" -o again.exr --layers alpha --resume
    expect 2 "was begun with other options" render glass.rt "${size[@]}" -o again.exr --resume
fi
expect 0 "" render glass.rt "${size[@]}" "${layers[@]}" -o again.exr --resume
expect_same again.exr whole.exr

# Frames that were made without alpha do not go into a film with it.
{
    cat glass.rt
    echo "sphere { <0, -2, 0>, .1 motion { key { time 0 } key { time 1 translate <0, 0, 1> } } }"
} >moving.rt
expect 0 "" render moving.rt --size 20x10 -o f-%d.png --frames 0-1
expect 2 "is a picture without alpha" render moving.rt --size 20x10 -o f-%d.png --frames 0-1 --alpha --resume

# OpenImageIO reads the file back; the layers of light that it takes apart add up to the picture, bit for bit.
# shellcheck disable=SC2046  # it prints words
taken() { printf '%s\n' whole.exr --ch "$1R,$1G,$1B" --chnames R,G,B; }
if command -v oiiotool >/dev/null; then
    oiiotool --info -v whole.exr >info || fault "oiiotool does not read whole.exr"
    for text in 'cryptomatte/.*/hash: "MurmurHash3_32"' 'cryptomatte/.*/name: "CryptoBody"' \
        'cryptomatte/.*/manifest: .*sphere 2'; do
        grep -q "$text" info || fault "its header lacks '$text': $(<info)"
    done
    mapfile -t sum < <(taken own.)
    for layer in light1. light2. reflected. refracted.; do
        oiiotool $(taken "$layer") --printstats | grep -q "Max: 0.000000 0.000000 0.000000" &&
            fault "there is no light in $layer"
        mapfile -t -O "${#sum[@]}" sum < <(taken "$layer" && echo --add)
    done
    oiiotool "${sum[@]}" $(taken "") --fail 0 --warn 0 --diff >difference || fault "light does not add up: $(<difference)"
    oiiotool $(taken own.) $(taken "") --fail 0 --warn 0 --diff >difference && fault "own light alone is the picture"
else
    left_out "without oiiotool no file of layers is read back"
fi
finish
