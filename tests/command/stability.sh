#!/usr/bin/env bash
# strahl stability: the pixels in which float, double and long double disagree.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

expect 0 "|   all |" stability scene.rt --size 32x24 --depth 2 -o map.png
picture=$(oiiotool --info map.png) && [[ $picture == *"32 x"*24* ]] || fault "the map is $picture"

# A ball ten million radii away: float renders another picture.
cat >far.rt <<'RT'
camera { position <0, 0, 0> look_at <0, 0, 1> up <0, -1, 0> fov 0.00001 }
light { position <-1e7, 1e7, -1e7> color <1, 1, 1> }
sphere { <0, 0, 1e7>, 1 }
RT
expect 0 "|     1 |" stability far.rt --size 64x48

# A value in the middle between two 8-bit steps is rounded one way or the other; that is no difference.
cat >tie.rt <<'RT'
camera { position <0, 0, 0> look_at <0, 1, 0> up <0, 0, -1> fov 25 }
background { color <.1, .3, .7> }
RT
expect 0 "|   all |         0 |   0.0000 % |          0 |   0.0000 % |" stability tie.rt --size 8x6
expect 2 "ending" stability scene.rt -o map.txt
expect 3 "nowhere.rt" stability nowhere.rt
finish
