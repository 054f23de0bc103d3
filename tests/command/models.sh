#!/usr/bin/env bash
# Models in place of scenes: pictures of them, the scenes that strahl import writes, and errors.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

# A cube of two objects: its front is red, and has a picture on its top.
cat >cube.obj <<'OBJ'
mtllib cube.mtl
v -1 0 1
v 1 0 1
v 1 2 1
v -1 2 1
v -1 0 -1
v 1 0 -1
v 1 2 -1
v -1 2 -1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
o walls
usemtl red
f 1 2 3 4
usemtl dull
f 2 6 7 3
f 6 5 8 7
f 5 1 4 8
f 1 5 6 2
o roof
usemtl tiles
f 4/1 3/2 7/3 8/4
OBJ
printf 'newmtl red\nKd 1 0 0\nnewmtl dull\nKd .5 .5 .5\nnewmtl tiles\nmap_Kd tiles.png\n' >cube.mtl
expect 0 "" render scene.rt -o tiles.png --size 8x8 # any picture

expect 0 "" render cube.obj -o cube.png --size 80x60
expect 0 "4: 1 plane, 3 meshes" check cube.obj
expect 0 "16 s, 16 keys, looping" check cube.obj
# color FILE X Y: red, green and blue of a pixel.
color() { convert "$1" -format "%[fx:int(255*p{$2,$3}.r+.5)] %[fx:int(255*p{$2,$3}.g+.5)] %[fx:int(255*p{$2,$3}.b+.5)]" info:; }
read -r red green _ < <(color cube.png 36 36)
((red > 60 && green == 0)) || fault "the front is not red but $red $green"
[[ $(color cube.png 1 1) == "231 231 231" ]] || fault "the background is $(color cube.png 1 1)"
# The floor is as bright as the background: there is no horizon.
[[ $(color cube.png 79 58) == "$(color cube.png 1 1)" ]] || fault "the floor is $(color cube.png 79 58)"

# What import writes is the same picture, also from another folder.
mkdir other
expect 0 "" import cube.obj -o other/cube.rt
expect 0 "" render other/cube.rt -o again.png --size 80x60
expect 0 "" compare cube.png again.png
grep -q 'image { "../tiles.png"' other/cube.rt || fault "the picture has no name in the scene"
grep -q '// Imported from cube.obj.' other/cube.rt || fault "the scene does not say what it is from"

# So is a picture with holes, whatever its colour is multiplied by: import writes what is in no file.
convert tiles.png \( -size 8x8 xc:white -fill black -draw 'rectangle 2,2 5,5' \) -alpha off -compose CopyOpacity \
    -composite holes.png
cp cube.obj holes.obj
sed -i 's/cube.mtl/holes.mtl/' holes.obj
for kd in 1 .3; do
    printf 'newmtl red\nKd 1 0 0\nnewmtl dull\nKd .5 .5 .5\nnewmtl tiles\nKd 1 %s 1\nmap_Kd -s 2 2 1 holes.png\n' $kd >holes.mtl
    expect 0 "" render holes.obj -o holes_shown.png --size 80x60
    expect 0 "" import holes.obj -o other/holes.rt
    expect 0 "" render other/holes.rt -o again.png --size 80x60
    expect 0 "" compare holes_shown.png again.png --tolerance 1
done
grep -q 'image { "holes-1.exr"  map uv  opacity 1' other/holes.rt || fault "the holes are not in the scene"
! cmp -s holes_shown.png cube.png || fault "holes are not seen"

# Colours of points have no file of their own: import writes one.
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n' >tri.ply
printf 'property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n' >>tri.ply
printf 'property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 255 255 0\n0 1 0 255 0 255\n3 0 1 2\n' >>tri.ply
expect 0 "" render tri.ply -o tri.png --size 80x60
expect 0 "" import tri.ply -o tri.rt
[[ -e tri-1.exr ]] || fault "there is no picture of the colours"
expect 0 "" render tri.rt -o again.png --size 80x60
expect 0 "" compare tri.png again.png --tolerance 1
expect 2 "add -o SCENE.rt" import tri.ply

# glTF: the triangle as text, with its numbers beside it.
printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0' >tri.bin
cat >tri.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "buffers": [{"uri": "tri.bin", "byteLength": 36}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]}
GLTF
expect 0 "" render tri.gltf -o gltf.png --size 80x60
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >tri.obj
printf 'solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n' >tri.stl
expect 0 "" render tri.stl -o stl.png --size 80x60
expect 0 "" sheet tri.obj -o sheet.png --size 20x15

# Other commands take models as well.
expect 0 "" pov cube.obj -o cube.pov
grep -q 'mesh' cube.pov || fault "there is no mesh for POV-Ray"

# Errors say where.
sed -i 's/"count": 3/"count": 4/' tri.gltf
expect 3 "tri.gltf: accessors[0]: 4 elements reach beyond their view of 36 bytes" render tri.gltf -o gltf.png
expect 3 "tri.gltf: accessors[0]" check tri.gltf
sed -i 's/newmtl dull/newmtl dull\nNs much/' cube.mtl
expect 3 "cube.mtl:4: 'much' should be a number" check cube.obj
rm cube.mtl tri.bin
expect 0 "cube.obj: materials are left out: cannot read 'cube.mtl': there is no such file" check cube.obj
expect 3 "cannot read 'tri.bin'" import tri.gltf -o tri.rt
cp cube.obj a.gltf
expect 3 "a.gltf:1: syntax error" check a.gltf

finish
