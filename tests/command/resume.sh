#!/usr/bin/env bash
# Checkpoints of stills, parts and strahl join: always the same file as in one run, bit for bit.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

# Tall and narrow: 10 bands.
size=(--size 60x600)

# killed SECONDS ARGUMENT...: kill -9 after so long, or later if there is no checkpoint of $least bytes yet.
least=1
killed() {
    local pid waited
    "$strahl" render scene.rt "${size[@]}" "${@:2}" --threads 1 --checkpoint 0 2>said &
    pid=$!
    sleep "$1"
    for ((waited = 0; waited < 100; ++waited)); do
        [[ $(find . -name '*.checkpoint' -size "+$((least - 1))c") ]] && break
        kill -s 0 "$pid" 2>/dev/null || break
        sleep .02
    done
    kill -s KILL "$pid" 2>/dev/null
    wait "$pid" 2>/dev/null
}

for ending in png bmp exr; do
    slow=(--samples 8x8)
    expect 0 "" render scene.rt "${size[@]}" "${slow[@]}" -o "whole.$ending"
    for delay in 0 .05 .1 .2; do
        killed "$delay" "${slow[@]}" -o "a.$ending"
        expect 0 "" render scene.rt "${size[@]}" "${slow[@]}" -o "a.$ending" --resume
        expect_same "a.$ending" "whole.$ending"
        expect_no_file "a.$ending.checkpoint"
        rm "a.$ending"
    done
done

# Kept bands are not traced again, and fit this scene, these options and this program only. The file's first lines,
# some 300 bytes, stand there before the first band does.
least=2000 killed 0 --samples 8x8 -o a.png
for bytes in 1 200; do
    cp a.png.checkpoint torn.png.checkpoint
    truncate -s "-$bytes" torn.png.checkpoint
    expect 0 "" render scene.rt "${size[@]}" --samples 8x8 -o torn.png --resume
    expect_same torn.png whole.png
done
for other in "--depth 3" "--size 60x601" "--crop 0,0,60,599" "--samples 4x4" "--precision float" "--time 1" "--error .1"; do
    # shellcheck disable=SC2086  # the words are arguments
    expect 2 "was begun with other options" render scene.rt "${size[@]}" --samples 8x8 -o a.png --resume $other
done
expect 2 "for another kind or size of file" render scene.rt "${size[@]}" --samples 8x8 -o a.png --resume --compression small
sed 's/<1, .2, .2>/<1, .2, .3>/' scene.rt >other.rt
expect 2 "was begun from another scene" render other.rt "${size[@]}" --samples 8x8 -o a.png --resume
cp "$strahl" another
printf x >>another
"$PWD/another" render scene.rt "${size[@]}" --samples 8x8 -o a.png --resume 2>said
(($? == 2)) || fault "another program went on: $(<said)"
grep -q "by another version" said || fault "of another program it said: $(<said)"
echo "no bands" >b.png.checkpoint
expect 0 "" render scene.rt "${size[@]}" -o b.png --resume
"$strahl" render scene.rt "${size[@]}" --samples 8x8 -o a.png --resume --stats stats.json || fault "no --resume"
camera=$(sed -n 's/.*"camera": \([0-9]*\).*/\1/p' stats.json)
((camera < 60 * 600 * 64)) || fault "all of it was traced again: $camera camera rays"
expect_same a.png whole.png
expect_no_file a.png.checkpoint
expect 2 "need a file" render scene.rt -o - --format png --resume
rm -f ./*.png ./*.checkpoint another other.rt stats.json

# The files of triangles and of pixels count as the scene.
cat >triangle.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 0 1 2
f 1 2 3
OBJ
expect 0 "" render scene.rt -o dots.png --size 4x4
cat scene.rt - >files.rt <<'SCENE'
mesh { file "triangle.obj" }
sphere { <0, 0, 5>, 1 material { rgb image { "dots.png" } } }
SCENE
for changed in triangle.obj dots.png; do
    "$strahl" check files.rt >/dev/null || fault "$("$strahl" check files.rt 2>&1)"
    "$strahl" render files.rt "${size[@]}" --part 1/1 -o a.png || fault "no part"
    cp "$changed" kept
    if [[ $changed == dots.png ]]; then
        expect 0 "" render scene.rt -o dots.png --size 4x4 --depth 1 --time 3
    else
        sed -i 's/v 0 1 2/v 0 1 3/' triangle.obj
    fi
    expect 2 "from another scene" render files.rt "${size[@]}" --part 1/1 -o a.png --resume
    mv kept "$changed"
    expect 0 "" render files.rt "${size[@]}" --part 1/1 -o a.png --resume
    rm a.png.part-1-of-1
done
rm files.rt dots.png triangle.obj

# Killed between a frame's own name and the end of its checkpoint: the next run finds the frame, and takes that away.
killed 0 --samples 8x8 -o a.png
expect 0 "" render scene.rt -o 'film-%d.png' --frames 0-1 --size 4x4
mv a.png.checkpoint film-0.png.checkpoint
expect 0 "" render scene.rt -o 'film-%d.png' --frames 0-1 --size 4x4 --resume
expect_no_file film-0.png.checkpoint
rm -f ./*.png

# Parts: any number, made in any order, of any format, some of them killed.
for ending in png bmp exr; do
    expect 0 "" render scene.rt "${size[@]}" -o "whole.$ending"
    for parts in 1 3 12; do
        for ((part = parts; part > 0; --part)); do
            ((part % 2)) || killed 0 -o "a.$ending" --part "$part/$parts"
            expect 0 "" render scene.rt "${size[@]}" -o "a.$ending" --part "$part/$parts" --resume
        done
        expect_no_file "a.$ending"
        expect 0 "" join "a.$ending".part-* -o "a.$ending"
        expect_same "a.$ending" "whole.$ending"
        ((parts == 3)) && mkdir "$ending" && mv "a.$ending".part-* "$ending"
        rm -f "a.$ending" "a.$ending".part-*
    done
done
expect 3 "bands are missing: 1 and 3 of 3" join png/*.part-2-of-3 -o a.png
expect 3 "they differ in the kind or size of file" join png/*.part-[12]-* bmp/*.part-3-* -o a.png
expect 3 "not a file of bands" join whole.png -o a.png
expect 2 ".png file; give -o that ending" join png/* -o a.bmp
expect 2 "would overwrite a part" join png/* -o png/a.png.part-1-of-3
truncate -s -9 png/a.png.part-2-of-3
expect 3 "bands are missing: 2 of 3" join png/* -o a.png
expect_no_file a.png
for part in 0/3 4/3 3 1/0 -1/3 1/1000001; do expect 2 "--part" render scene.rt -o a.png --part "$part"; done
finish
