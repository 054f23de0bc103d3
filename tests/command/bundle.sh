#!/usr/bin/env bash
# strahl bundle: a folder that plays a scene, with all its files, wherever it is put.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

# A mesh beside the scene and one elsewhere of the same name, and pictures of every sort.
mkdir demo other
cp "$source_folder/tests/window/clicks.ogg" other
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n' | tee demo/body.obj >other/body.obj
expect 0 "" render scene.rt -o demo/colours.png --size 8x6
expect 0 "" render scene.rt -o other/deep.png --bits 16 --size 8x6
expect 0 "" render scene.rt -o demo/floats.exr --size 8x6
convert demo/colours.png -colorspace gray demo/grey.png
convert demo/colours.png -transparent "$(convert demo/colours.png -format '%[pixel:p{1,1}]' info:)" demo/holes.gif
cat scene.rt - >"demo/a scene's.rt" <<SCENE
// "body.obj" is a mesh, isn't it? " is no name
mesh { file "body.obj"  translate <2, 2, 0> }
mesh { file "$work/other/body.obj"  translate <-2, 2, 0> }
mesh { file "./body.obj"  translate <-2, 3, 0> }
music { sound "../other/clicks.ogg" }
sphere { <0, 4, 1>, 1  material { rgb image { "colours.png" } } }
sphere { <2, 4, 1>, 1  material { rgb image { "../other/deep.png" } } }
sphere { <4, 4, 1>, 1  material { rgb image { "floats.exr" }  bump image { "grey.png"  height .1 } } }
sphere { <6, 4, 1>, 1  material { rgb image { "holes.gif"  opacity 1 } } }
SCENE
expect 0 "/play plays it" bundle "demo/a scene's.rt" -o "to go/"
[[ -x "to go/play" ]] || fault "play is no script"
rm -f said
(cd "to go" && find . -type f -not -path './lib/*' | sort) >found
cat >wanted <<'LIST'
./README.txt
./bin/strahl
./play
./scene/a scene's.rt
./scene/files/body-2.obj
./scene/files/body-3.obj
./scene/files/body.obj
./scene/files/clicks.ogg
./scene/files/colours.png
./scene/files/deep.png
./scene/files/floats.pfm
./scene/files/grey.png
./scene/files/holes.png
LIST
diff wanted found || fault "the bundle's files are others"

# A bundle renders the same picture elsewhere, without the original files and the library that reads pictures.
expect 0 "" render "demo/a scene's.rt" -o before.exr --size 64x48
mv "to go" "$work/moved away"
rm -r demo other
bundled=$work/moved\ away
strahl_here=$strahl
strahl=$bundled/bin/strahl
expect 0 "" render "$bundled/scene/a scene's.rt" -o after.exr --size 64x48
expect_same before.exr after.exr
grep -q "Permission is hereby granted" "$bundled/README.txt" || fault "the licence is not in README.txt"

# The script hands its options on, from any folder and by a link. What of its libraries the machine lacks it finds.
ln -s "$bundled/play" link
for play in "$bundled/play" ./link; do
    [[ $("$play" --frobnicate 2>&1) == *"strahl play --help"* ]] || fault "$play does not start strahl play"
done
[[ -z $(find "$bundled/lib" -name 'libOpenImageIO*') ]] || fault "the library that reads pictures is in the bundle"
for library in $(ldd "$strahl_here" | awk '/=> \// { print $1 }'); do
    case $library in
    lib[cm].* | libstdc++.* | libgcc_s.* | libz.* | libdl.* | libpthread.* | librt.* | libX* | libxcb* | libGL* | libbsd.* | libmd.*) ;;
    *) expect_file "$bundled/lib/$library" ;;
    esac
done
strahl=$strahl_here

# An older bundle is replaced, also by an empty folder's place; nothing else is.
expect 0 "" bundle scene.rt -o "$bundled"
[[ ! -e "$bundled/scene/files" ]] || fault "the older bundle's files are still there"
mkdir empty mine
expect 0 "" bundle scene.rt -o empty
echo "my own" >mine/play
expect 2 "was not made by strahl bundle" bundle scene.rt -o mine
expect 2 "was not made by strahl bundle" bundle scene.rt -o scene.rt
expect 2 "was not made by strahl bundle" bundle scene.rt -o .
[[ $(<mine/play) == "my own" ]] || fault "a folder was overwritten"
# A failure leaves nothing, and an older bundle stays as it was.
echo 'sphere { <0, 0, 0>, 1 }  mesh { file "gone.obj" }' | cat scene.rt - >broken.rt
expect 3 "gone.obj" bundle broken.rt -o empty
expect 3 "gone.obj" bundle broken.rt -o another
expect 1 "No such file" bundle scene.rt -o not/there
expect 2 "a scene file" bundle - -o another
expect_file empty/scene/scene.rt
# Where a file cannot be written, the error names it. No file may have more than 100 kB here.
said=$(ulimit -f 100; "$strahl" bundle scene.rt -o another 2>&1)
(($? == 1)) || fault "bundled without place for the program"
[[ $said == *"cannot write 'another.tmp-"*"/bin/strahl': File too large"* ]] || fault "it says: $said"
[[ -z $(compgen -G '*.tmp-*') && ! -e another ]] || fault "something was left: $(echo ./*)"
finish
