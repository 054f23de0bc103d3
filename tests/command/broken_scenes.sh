#!/usr/bin/env bash
# Scenes with errors: exit status 3, place, line and caret, and never a crash.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
# Pictures that end early are among the faults.
export LSAN_OPTIONS="suppressions=$source_folder/tests/command/leaks.txt"

camera='camera { position <0,-9,0> look_at <0,0,0> up <0,0,-1> fov 25 }'
# broken PLACE TEXT SCENE: the message begins with the place, quotes the line, has a caret, and contains the text.
broken() {
    printf '%b' "$3" >broken.rt
    local said
    said=$("$strahl" check broken.rt 2>&1)
    local status=$?
    ((status == 3)) || fault "exit status $status instead of 3 for: $3"
    [[ $said == *"broken.rt:$1: "* && $said == *"$2"* && $said == *"^"* ]] ||
        fault "for: $3, without '$1' or '$2', it said: $said"
}

broken 1:1 "camera" ""
broken 2:1 "camera" "$camera\n$camera"
broken 2:1 "did you mean 'sphere'" "$camera\nsphre { <0,0,0>, 1 }"
broken 2:22 "did you mean 'material'" "$camera\nsphere { <0,0,0>, 1  matreial { } }"
broken 2:19 "radius" "$camera\nsphere { <0,0,0>, -1 }"
broken 2:19 "" "$camera\nsphere { <0,0,0>, nan }"
broken 2:19 "" "$camera\nsphere { <0,0,0>, 1e999 }"
broken 2:14 "" "$camera\nsphere { <0,0>, 1 }"
broken 2:1 "" "$camera\nsphere { <0,0,0>, 1"
broken 2:1 "" "$camera\n/* never ends"
broken 2:1 "one line" "$camera\nplane { <0,0,0>, <1,0,0>, <2,0,0> }"
broken 2:1 "same point" "$camera\ncylinder { <0,0,0>, <0,0,0>, 1 }"
broken 2:44 "reflection" "$camera\nsphere { <0,0,0>, 1  material { reflection 1.5 } }"
broken 2:46 "reflection" "$camera\nsphere { <0,0,0>, 1  material { reflection 1 reflection 0 } }"
broken 1:1 "look_at" "camera { position <1,2,3> look_at <1,2,3> up <0,0,-1> fov 25 }"
broken 1:59 "fov" "camera { position <1,2,3> look_at <0,0,0> up <0,0,-1> fov 90 }"
broken 2:27 "scale" "$camera\nsphere { <0,0,0>, 1 scale 0 }"
broken 2:1 "key" "$camera\nflythrough { duration 1 }"
broken 2:1 "" "$camera\n\xff\xfe"
broken 2:1 "" "$camera\n\x00"

# Pictures that are not there, cut off, too wide, forged, not opaque, or of no format that is read.
echo "$camera" >plain.rt
"$strahl" render plain.rt -o whole.png --size 64x48
"$strahl" render plain.rt -o wide.png --size 40000x1
head -c 60 whole.png >cut.png
head -c $(($(wc -c <whole.png) - 30)) whole.png >half.png
head -c 3000 /dev/urandom >noise.png
# 100,000 pixels wide and high, says this header.
{ printf 'BM\x00\x00\x00\x00\x00\x00\x00\x00\x36\x00\x00\x00\x28\x00\x00\x00\xa0\x86\x01\x00\xa0\x86\x01\x00'
  printf '\x01\x00\x18\x00'; head -c 1000 /dev/zero; } >forged.bmp
textured="$camera\nsphere { <0,0,0>, 1  material { rgb image"
broken 2:46 "cannot read 'none.png': there is no such file" "$textured { \"none.png\" } } }"
broken 2:46 "cannot read 'cut.png' as a picture: its header announces more than is in the file" "$textured { \"cut.png\" } } }"
broken 2:46 "cannot read 'half.png' as a picture" "$textured { \"half.png\" } } }"
broken 2:46 "noise.png' is not a .bmp, .png, .exr, .jpg, .gif, .tga, .ppm, .pgm or .pfm file" "$textured { \"noise.png\" } } }"
broken 2:46 "it has 40000x1 pixels; each side may have at most 32768" "$textured { \"wide.png\" } } }"
broken 2:46 "cannot read 'forged.bmp'" "$textured { \"forged.bmp\" } } }"
broken 2:46 "is a folder" "$textured { \".\" } } }"
broken 2:61 "did you mean 'planar'" "$textured { \"whole.png\" map planer } } }"
broken 2:45 "the name of a picture" "$textured { <1,1,1> } } }"
echo -e "$textured { \"whole.png\" } } }" >textured.rt
expect 0 "no errors" check textured.rt
mkdir -p below && echo -e "$textured { \"../whole.png\" } } }" >below/textured.rt
expect 0 "no errors" check below/textured.rt

# Sound that is not there, no sound, or named twice; what is written back names it again.
cp "$source_folder/tests/window/clicks.ogg" .
broken 2:16 "cannot read 'none.ogg': there is no such file" "$camera\nmusic { sound \"none.ogg\" }"
broken 2:16 "noise.png' is not an Ogg Vorbis file" "$camera\nmusic { sound \"noise.png\" }"
broken 2:16 "it is a folder" "$camera\nmusic { sound \"below\" }"
broken 2:15 "the name of a file" "$camera\nmusic { sound 3 }"
broken 2:9 "did you mean 'sound'" "$camera\nmusic { sond \"clicks.ogg\" }"
broken 2:28 "a second 'sound'" "$camera\nmusic { sound \"clicks.ogg\" sound \"clicks.ogg\" }"
echo "$camera music { sound \"clicks.ogg\"  bpm 90 }" >loud.rt
expect 0 'music { bpm 90  rows 8  sound "clicks.ogg" }' check loud.rt --print

# Up to ten errors at once.
for ((i = 0; i < 30; ++i)); do echo "sphere { <0,0,0>, -1 }"; done >many.rt
count=$("$strahl" check many.rt 2>&1 | grep -c 'many.rt:[0-9]*:[0-9]*: ')
((count == 10)) || fault "$count errors reported at once instead of 10"

# Hostile files: no crash, no hang, no unbounded memory (exit status 124 is the time limit).
hostile() {
    timeout 60 "$strahl" check hostile.rt >/dev/null 2>said
    (($? == 3)) || fault "$1: $(head -c 300 said)"
    (($(wc -c <said) < 10000)) || fault "$1: a message of $(wc -c <said) bytes"
}
yes '{' | head -c 1000000 >hostile.rt && hostile "a million braces"
head -c 1000000 /dev/zero | tr '\0' '9' >hostile.rt && hostile "a number of a million digits"
head -c 1000000 /dev/zero | tr '\0' 'a' >hostile.rt && hostile "a word of a million letters"
head -c 1000000 /dev/urandom >hostile.rt && hostile "noise"
expect 3 "" render hostile.rt -o x.bmp
expect 3 "" check /dev/null
finish
