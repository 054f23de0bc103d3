#!/usr/bin/env bash
# strahl sheet: its pictures are those of strahl render, in their places; bad options.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
set -m # a shell without job control starts what it puts into the background with SIGINT ignored

# rows FILE WIDTH FIRST COUNT: the bytes of rows of a .bmp, counted from the top; WIDTH is a multiple of 4.
rows() { tail -c $((3 * $2 * ($3 + $4))) "$1" | head -c $((3 * $2 * $4)); }

# Below each picture is a strip of 20 pixels for its time, and 4 pixels are between pictures.
expect 0 "" sheet scene.rt -o sheet.bmp --pictures 3 --columns 1 --size 32x24
for picture in 0 1 2; do
    expect 0 "" render scene.rt -o still.bmp --size 32x24 --time $((2 * picture))
    cmp <(rows sheet.bmp 32 $((48 * picture)) 24) <(rows still.bmp 32 0 24) || fault "picture $picture is another one"
done
[[ $(stat -c %s sheet.bmp) == $((54 + 3 * 32 * (3 * 48 - 4))) ]] || fault "the sheet has another size"
expect_only scene.rt sheet.bmp still.bmp

# Exposure and depth are those of render; a path that loops has its end only once.
sed 's/duration 4/duration 5 loop/' scene.rt >loop.rt
expect 0 "" sheet loop.rt -o sheet.bmp --pictures 4 --columns 1 --size 32x24 --exposure 1 --depth 2
expect 0 "" render loop.rt -o still.bmp --size 32x24 --time 3.75 --exposure 1 --depth 2
cmp <(rows sheet.bmp 32 144 24) <(rows still.bmp 32 0 24) || fault "the last picture is another one"

# By default there are 12, in 4 columns, as wide as the camera's aspectratio says.
sed 's/fov 10/fov 10 aspectratio 2/' scene.rt >wide.rt
expect 0 "" sheet wide.rt -o sheet.png --depth 1
expect 3 "1292x548 and 32x24" compare sheet.png still.bmp

sed '/flythrough/,$d' scene.rt >still.rt
expect 2 "strahl sheet needs a scene with a flythrough" sheet still.rt -o sheet.bmp
expect 2 "Add -o FILE" sheet scene.rt
expect 2 ".bmp, .png or .exr" sheet scene.rt -o sheet.mp4
cp scene.rt scene.bmp
expect 2 "would overwrite" sheet scene.bmp -o scene.bmp
expect 2 "--pictures" sheet scene.rt -o sheet.bmp --pictures 0
expect 2 "too many for a sheet" sheet scene.rt -o sheet.bmp --pictures 10000 --size 1000x1000
expect 3 "broken.rt" sheet broken.rt -o sheet.bmp
expect 1 "its folder does not exist" sheet scene.rt -o folder/sheet.bmp

# Interrupted, it leaves the older file.
cat >slow.rt <<<"$mirrors
flythrough { duration 1 key { time 0 position <0, 0, 0> look_at <0, 1, 0> } key { time 1 position <0, 1, 0> look_at <0, 2, 0> } }"
cp sheet.bmp before.bmp
for delay in .1 .5 1 2 4 8; do # too early, signals are not yet handled, and it says nothing
    "$strahl" sheet slow.rt -o sheet.bmp --size 1000x1000 --depth 256 2>said &
    sleep "$delay"
    kill -INT $!
    wait $!
    status=$?
    [[ ! -s said ]] || break
done
[[ $status == 130 && $(<said) == *"no sheet was written"* ]] || fault "interrupted, it says: $(<said)"
expect_same sheet.bmp before.bmp
finish
