#!/usr/bin/env bash
# strahl render: all options that affect the picture, crops, pipes, formats.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

size=(--size 64x48)
make() { expect 0 "" render scene.rt -o "$1" "${size[@]}" "${@:2}"; }
# equal A B [TOLERANCE], unequal A B [TOLERANCE]
equal() { expect 0 "maximum difference" compare "$1" "$2" --tolerance "${3-0}"; }
unequal() { expect 1 "maximum difference" compare "$1" "$2" --tolerance "${3-0}"; }

make whole.exr
make whole.bmp
make whole.png
make whole16.png --bits 16
equal whole.bmp whole.png
make one.png --samples 1
make one16.png --samples 1 --bits 16
make all.png --error 0 --samples 1
equal all.png one16.png 0.00197 # half an 8-bit step, by rounding
equal one.png one16.png 0.00393 # and half a one that is left out

# An aspectratio that does not fit is warned of, and --fit widens the view: here upwards and downwards only.
for aspect in 2 1.34 1.3333; do sed "s/fov 10 }/fov 10  aspectratio $aspect }/" scene.rt >"aspect-$aspect.rt"; done
expect 0 "strahl: warning: the camera's aspectratio is 2 and that of the picture 1.333, which narrows what it shows; with --fit it shows more instead" \
    render aspect-2.rt -o narrowed.png "${size[@]}"
unequal narrowed.png whole.png 0.1
for aspect in 1.34 1.3333; do
    said=$("$strahl" render "aspect-$aspect.rt" -o fitting.png "${size[@]}" 2>&1)
    [[ ! $said ]] || fault "aspectratio $aspect: $said"
done
said=$("$strahl" render aspect-2.rt -o fitted.png "${size[@]}" --fit 2>&1)
[[ ! $said ]] || fault "with --fit it says: $said"
expect_same fitted.png whole.png

# Rays in a pixel: one by default is another picture than the average, which a fine grid comes close to.
make average.exr --error 1e-4
make fine.exr --samples 32x32
unequal one.png average.exr 0.1
equal fine.exr average.exr 0.02
make coarse.exr --samples 2x2
make centre.exr --samples 2x2+1
unequal coarse.exr centre.exr 0.001
for samples in 0x0 2x3 4 257x257 2x2+2 x -1x-1 ''; do
    expect 2 "--samples" render scene.rt -o x.exr "${size[@]}" --samples "$samples"
done
expect 0 "whole.exr: 64x48, 3 channels, 32 bits" compare whole.exr whole.exr
expect 0 "whole16.png: 64x48, 3 channels, 16 bits" compare whole16.png whole16.png

# The default size is 640x480, also with a crop.
expect 0 "" render scene.rt -o default.png --crop 300,200,9,7
expect 0 "" render scene.rt -o same.png --size 640x480 --crop 300,200,9,7
expect_same default.png same.png
expect 0 "default.png: 9x7" compare default.png same.png

# A crop has the same pixels as the whole picture, at corners and edges too.
for crop in 0,0,64,48 0,0,1,1 63,47,1,1 5,7,20,10 40,0,24,48 0,33,64,1; do
    IFS=, read -r x y w h <<<"$crop"
    make crop.png --bits 16 --crop "$crop"
    cmp <(convert crop.png -depth 16 rgb:-) <(convert whole16.png -crop "${w}x$h+$x+$y" +repage -depth 16 rgb:-) ||
        fault "the crop $crop has other pixels"
done

make one.exr --threads 1
make three.exr --threads 3
expect_same one.exr whole.exr
expect_same three.exr whole.exr

make depth1.exr --depth 1
unequal depth1.exr whole.exr 0.01
make depth20.exr --depth 20
expect_same depth20.exr whole.exr
sed 's/^light/global_settings { max_trace_level 1 } light/;t end;b;:end;n;b end' scene.rt >shallow.rt
expect 0 "" render shallow.rt -o shallow.exr "${size[@]}"
expect_same shallow.exr depth1.exr

make scalar.exr --simd scalar
for simd in auto v2 v3 v4 neon; do
    said=$("$strahl" render scene.rt -o "$simd.exr" "${size[@]}" --simd "$simd" 2>&1)
    case $?/$said in
    0/) if [[ $simd == v2 ]]; then equal v2.exr scalar.exr 1e-6; else expect_same "$simd.exr" scalar.exr; fi ;;
    2/*"this processor does not support"* | 2/*"this program was built without"*) ;; # an older machine, or another kind
    *) fault "--simd $simd: $said" ;;
    esac
done
make double.exr --precision double
make float.exr --precision float
make extended.exr --precision extended
expect_same double.exr whole.exr
equal extended.exr whole.exr 1e-6
unequal float.exr whole.exr
# A few pixels on edges may differ.
said=$("$strahl" compare float.exr whole.exr --tolerance 1e-4)
beyond=$(sed -n 's/^pixels beyond the tolerance.*: \([0-9]*\) of 3072.*/\1/p' <<<"$said")
((${beyond:-9999} < 20)) || fault "float is far from double: $said"

make start.exr --time 0
expect_same start.exr whole.exr
make later.exr --time 2.5
unequal later.exr whole.exr 0.01
make end.exr --time 4
make after.exr --time 1e9
expect_same end.exr after.exr

# From and to pipes; messages do not mix with the picture.
for format in bmp png; do
    "$strahl" render - -o - --format "$format" "${size[@]}" <scene.rt >"piped.$format" 2>said || fault "a pipe: $(<said)"
    expect_same "piped.$format" "whole.$format"
    [[ ! -s said ]] || fault "said without a terminal: $(<said)"
done
"$strahl" render scene.rt -o - --format exr "${size[@]}" >piped.exr || fault "an exr to a pipe"
expect_same piped.exr whole.exr

# Linear light is encoded in 8 and 16 bits, and unchanged in float.
sed '1i global_settings { assumed_gamma 1 }' scene.rt >linear.rt
expect 0 "" render linear.rt -o linear.exr "${size[@]}"
expect 0 "" render linear.rt -o linear.png "${size[@]}"
expect_same linear.exr whole.exr
unequal linear.png whole.png 0.1

# An exposure multiplies what 8 bits show, and compresses what is bright; other files hold light as it is.
printf 'camera { position <0, 0, 0> look_at <0, 1, 0> sky <0, 0, 1> angle 40 } background { color <.25, .5, 4> }\n' >bright.rt
for given in "1 <128,230,254>" "-1 <32,64,248>" "0 <64,128,252>"; do
    read -r stops code <<<"$given"
    for ending in png bmp; do
        expect 0 "" render bright.rt -o "bright.$ending" --size 4x4 --exposure "$stops"
        said=$(convert "bright.$ending" -format '<%[fx:round(255*u.r)],%[fx:round(255*u.g)],%[fx:round(255*u.b)]>' info:)
        [[ $said == "$code" ]] || fault "--exposure $stops makes $said in a .$ending"
    done
done
expect 0 "" render bright.rt -o plain.png --size 4x4
expect_other plain.png bright.png
expect 2 "--exposure is for pictures of 8 bits" render scene.rt -o x.exr --exposure 1
expect 2 "--exposure is for pictures of 8 bits" render scene.rt -o x.png --bits 16 --exposure 1
expect 2 "without --exposure" render scene.rt -o x.png --prove map.png --exposure 1
for stops in nan 21 x; do expect 2 "--exposure" render scene.rt -o x.png --exposure "$stops"; done
# Alpha and layers: what their files hold, what refuses them, and that they can be continued and joined.
mkdir layers && cd layers || exit 1
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
expect_only glass.rt

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
        'cryptomatte/b973c59/manifest: .*sphere 2.*87b966c9'; do
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
