#!/usr/bin/env bash
# strahl crosscheck with scenes of strangers: it fails if POV-Ray sees anything else than Strahl, and no file is written
# but in temporary folders.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

# tampered SIZE LINE SCENE: crosscheck fails if POV-Ray gets the text changed by this line of sed, unless that is empty.
mkdir tools
cat >tools/povray <<'TEXT'
#!/bin/bash
for word; do
    case $word in
    +I*) input=$(tr -d '"' <<<"${word:2}") ;;
    *) others+=("$word") ;;
    esac
done
sed "$TAMPER" "$input" >seen.pov
exec "$POVRAY" +Iseen.pov "${others[@]}"
TEXT
chmod +x tools/povray
POVRAY=$(command -v povray) || fault "povray is missing"
export POVRAY
tampered() {
    local status=0 name="$1 $3 $BASHPID"
    sed "s=RATIO=${1/x//}=" "$3.txt" >"$name.pov"
    TAMPER=$2 PATH=$work/tools:$PATH "$strahl" crosscheck "$name.pov" --size "$1" >"$name.said" 2>&1 || status=$?
    local wanted=1
    [[ $2 ]] || wanted=0
    ((status == wanted)) || fault "$1 $3, '$2': exit status $status: $(<"$name.said")" >>"$work/faults"
}
# A body with soft edges before black, all of whose values change smoothly, and bodies with edges.
cat >soft.txt <<'TEXT'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, -4> right x*RATIO up y look_at <0, 0, 0> angle 60 }
plane { -z, 0 pigment { spherical color_map { [0 rgb 0] [.2 rgb <0, .02, .05>] [1 rgb <1, .6, .2>] } }
    finish { ambient 1 diffuse 0 } }
TEXT
cat >hard.txt <<'TEXT'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.5, -6> right x*RATIO up y look_at <0, 0, 0> angle 45 }
light_source { <-3, 5, -4>, rgb <1, 1, 1> }
background { rgb <.1, .2, .4> }
plane { y, -1 pigment { checker rgb 1 rgb .3 } }
sphere { <.2, 0, 0>, .9 pigment { rgb <.3, .6, .9> } finish { phong .5 reflection .2 } }
TEXT
# All at once: POV-Ray sleeps most of the second that it takes for a small picture.
tampered 160x90 '' soft &
tampered 160x90 's/<0, 0, -4>/<.03, 0, -4>/' soft &
tampered 90x160 's/up y/up y*1.02/' soft &
tampered 16x9 's/right x/right .98*x/' soft &
tampered 210x90 '$a camera { location -4*z look_at 0 }' soft &
tampered 90x90 '' hard &
tampered 160x90 's/rgb <.3, .6/rgb <.3, .61/' hard &
tampered 210x90 's/sphere { <.2/sphere { <.21/' hard &
tampered 90x160 's/rgb <1, 1, 1>/rgb <1, .99, 1>/' hard &
tampered 8x5 's/angle 45/angle 46/' hard &

# What a scene writes beside itself it can read; elsewhere it cannot write. It reads files of its folder, of one above
# it and of the library.
mkdir -p above/scenes/sub library tmp
cd above/scenes || exit 1
export TMPDIR=$work/tmp
echo '#declare A = 1;' >sub/a.inc
echo '#declare B = 1;' >../b.inc
echo '#declare C = 1;' >"$work/library/c.inc"
echo kept >../kept.txt
echo kept >beside.txt
rest='camera { location -4*z right 16/9*x look_at 0 } light_source { -5*z, 1 } sphere { 0, 1 pigment { rgb 1 } }'
cat >reads.pov <<TEXT
#fopen G "made.inc" write #write(G, "#declare D = 1;") #fclose G
#include "made.inc" #include "sub/a.inc" #include "../b.inc" #include "c.inc" #include "colors.inc"
$rest sphere { 1, A*B*C*D pigment { Red } }
TEXT
expect 0 "| reads.pov " crosscheck reads.pov --size 32x18 --library .. --library "$work/library"
writes() { # NAME MODE FILE
    echo "#version 3.7; #fopen G \"$3\" $2 #write(G, \"hello\") #fclose G" >"$1.inc"
    echo "#include \"$1.inc\" $rest" >"$1.pov"
    "$strahl" crosscheck "$1.pov" --size 32x18 >"$1.said" 2>&1
}
writes up write ../written.txt &
writes far write "$work/written.txt" &
writes append append ../kept.txt &
writes absolute append "$work/above/kept.txt" &
writes own append beside.txt &
writes through write own/written.txt &
wait
[[ $(<../kept.txt) == kept && $(<beside.txt) == kept ]] || fault "a scene changed a file"
[[ -z $(find "$work" -name '*written*' -o -name 'made.inc') ]] || fault "a scene made a file"
[[ -z $(ls -A "$TMPDIR") ]] || fault "left behind: $(ls -A "$TMPDIR")"
grep -q 'written.txt' far.said || fault "it does not say what could not be written: $(<far.said)"
[[ ! -e $work/faults ]] || fault "$(<"$work/faults")"
finish
