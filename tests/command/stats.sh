#!/usr/bin/env bash
# The statistics: valid JSON with the right values.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

cat >read.cmake <<'CMAKE'
file(READ stats.json json)
string(JSON value GET "${json}" ${KEY})
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${value}")
CMAKE
# value KEY...
value() { cmake "-DKEY=$(printf '%s;' "$@" | sed 's/;$//')" -P read.cmake; }
is() { [[ $(value "${@:2}") == "$1" ]] || fault "${*:2} is '$(value "${@:2}")' instead of '$1' in $(<stats.json)"; }

expect 0 "" render scene.rt -o x.bmp --size 64x48 --crop 20,14,30,20 --depth 7 --precision float --simd scalar --threads 2 \
    --samples 1 --stats stats.json
is ON finished
is 64 width
is 48 height
is 30 crop 2
is 1 frames
is 7 depth
is float precision
is scalar simd
is 1 lanes
is 2 threads
is 600 rays camera
is 1 samples in_each_pixel
(($(value rays total) == $(value rays camera) + $(value rays reflected) + $(value rays refracted) + $(value rays shadow))) ||
    fault "the rays do not add up in $(<stats.json)"
for stage in parse build trace write; do
    [[ $(value "${stage}_seconds") =~ ^[0-9.e-]+$ ]] || fault "${stage}_seconds in $(<stats.json)"
done
for type in reflected refracted shadow; do (($(value rays $type) > 0)) || fault "no $type rays in $(<stats.json)"; done

# One pixel is a tie, which nothing decides.
expect 0 "" render scene.rt -o x.bmp --size 64x48 --crop 2,14,30,20 --prove map.png --stats stats.json
is 8 proof bits
is double precision
is 1 samples in_each_pixel
(($(value proof proved) + $(value proof undecided) == 600 && $(value proof proved) > 300 && $(value proof undecided) > 0)) || fault "proof in $(<stats.json)"
[[ -s map.png ]] || fault "there is no map"

# Extended precision decides some of the pixels that double leaves undecided. The picture is whole, and the same.
article=$source_folder/scenes/article.rt
expect 0 "" render "$article" -o proved.png --bits 16 --size 320x240 --crop 90,90,100,80 --prove map.png --stats stats.json
(($(value proof in_extended) > 5 && $(value proof proved) + $(value proof undecided) == 8000)) || fault "proof in $(<stats.json)"
expect 0 "" render "$article" -o plain.png --bits 16 --size 320x240 --crop 90,90,100,80 --samples 1 --error 0
expect 0 "0 of 8000" compare proved.png plain.png --tolerance 1.6e-5

expect 0 "" render scene.rt -o x.bmp --size 64x48 --error 1e-3 --stats stats.json
[[ $(value samples aimed) == 0.001 ]] || fault "$(value samples aimed) is aimed at"
[[ $(value samples estimated) == 0.00* ]] || fault "the error is thought to be $(value samples estimated)"
is ON samples reached
(($(value samples checked) > 100)) || fault "$(value samples checked) pixels are checked"
(($(value samples median) >= 1 && $(value samples most) > $(value samples median))) || fault "samples in $(<stats.json)"

# A floor with sharp spots far smaller than a pixel, in a mirror and a mirror ball.
expect 0 "strahl: warning: the error of averages over pixels is about 0.00" \
    render "$source_folder/tests/bench/sampling/worlds/mirrored_noise.rt" -o x.bmp --size 64x48 --stats stats.json
is OFF samples reached

expect 0 "" render scene.rt -o x.bmp --size 64x48 --depth 1 --stats stats.json
is 0 rays reflected
is 0 rays refracted
is double precision
[[ $(value error allowed) == 0.00196* ]] || fault "error allowed is $(value error allowed)"

# --error: a larger error needs fewer rays.
expect 0 "" render scene.rt -o x.bmp --size 64x48 --samples 1 --error 1e-1 --stats stats.json
is float precision
awk "BEGIN { exit !(0 < $(value error dropped) && $(value error dropped) < .0501) }" || fault "dropped in $(<stats.json)"
few=$(value rays total)
expect 0 "" render scene.rt -o x.bmp --size 64x48 --samples 1 --error 1e-6 --stats stats.json
is double precision
(($(value rays total) > few)) || fault "--error 1e-6 takes no more rays than --error 1e-1"
expect 0 "" render scene.rt -o x.bmp --size 64x48 --samples 1 --error 0 --stats stats.json
is 0.0 error allowed
printf 'camera { position <0, -5, 1>  look_at <0, 0, 0>  up <0, 0, -1>  fov 20 } light { position <0, 0, 9>  color <1, 1, 1> }
sphere { <0, 0, 0>, 1  material { reflection .1 } }' >one.rt
expect 0 "" render one.rt -o x.bmp --size 64x48 --samples 1 --error 0 --stats stats.json
is 0.0 error omitted  # a ball alone: no ray meets it twice, nothing is cut off
expect 0 "" render one.rt -o x.bmp --size 64x48 --samples 1 --depth 1 --error 0 --stats stats.json
[[ $(value error omitted) == 0.1* ]] || fault "what the second generation brings is $(value error omitted)"
expect 2 "--error" render scene.rt -o x.bmp --error -1
expect 2 "--error" render scene.rt -o x.bmp --error nan
expect 0 '"rays"' render scene.rt -o x.bmp --size 8x6 --quiet --stats -
finish
