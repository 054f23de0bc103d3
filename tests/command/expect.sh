# shellcheck shell=bash
# Shared by the tests of the commands: a temporary folder, and expectations.
# A test is started as: bash TEST.sh STRAHL SOURCE-FOLDER BUILD-FOLDER

strahl=$1
# shellcheck disable=SC2034  # for the tests
source_folder=$2 build_folder=$3
faults=0
[[ -x $strahl ]] || exit 1

# Where the picture library is loaded, the leak check of g++ 12 takes a wrong address for that library's thread-local
# memory, and ends in a segmentation fault.
export ASAN_OPTIONS=intercept_tls_get_addr=0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

# Between two mirrors: a picture that takes long.
# shellcheck disable=SC2034  # for the tests
mirrors="camera { position <0, 0, 0>  look_at <0, 1, 0>  up <0, 0, -1>  fov 40 }
light { position <0, 0, .5>  color <1, 1, 1> }
defaultmaterial { reflection .999  diffuse .1 }
plane { <0, 3, 0>, <1, 3, 0>, <0, 3, 1> }
plane { <0, -3, 0>, <1, -3, 0>, <0, -3, 1> }"

fault() {
    printf 'FAULT: %s\n' "$*"
    ((++faults))
}

# left_out TEXT: says that a part of a test is left out and why; tests/run says so in the end.
left_out() { printf '%s: %s\n' "$(basename "$0" .sh)" "$*" | tee -a "${STRAHL_LEFT_OUT:-/dev/null}"; }

# expect STATUS TEXT ARGUMENT...: strahl with these arguments ends with the status, and its output contains the text.
expect() {
    local status=$1 text=$2 said
    shift 2
    said=$("$strahl" "$@" 2>&1 </dev/null)
    local got=$?
    ((got == status)) || fault "strahl $*: exit status $got instead of $status; it said: $said"
    [[ $said == *"$text"* ]] || fault "strahl $*: does not say '$text' but: $said"
}

# expect_same A B: two files have the same bytes.
expect_same() { cmp "$1" "$2" || fault "$1 and $2 differ"; }
# expect_other A B: two files have different bytes.
expect_other() { ! cmp -s "$1" "$2" || fault "$1 and $2 are the same"; }
expect_file() { [[ -s $1 ]] || fault "there is no file $1"; }
expect_no_file() { [[ ! -e $1 ]] || fault "there is a file $1"; }

# expect_only FILE...: the folder holds only these files, no temporary ones.
expect_only() {
    local found
    found=$(find . -mindepth 1 -printf '%P\n' | sort | tr '\n' ' ')
    [[ $found == "$(printf '%s\n' "$@" | sort | tr '\n' ' ')" ]] || fault "files here: $found, instead of: $*"
}

finish() {
    ((faults == 0)) || exit 1
    echo "as expected"
}

# A small scene with mirrors, glass, shadows and a flythrough.
cat >scene.rt <<'SCENE'
camera { position <5, -20, 18>  look_at <0, 0, 0>  up <0, 0, -1>  fov 10 }
light { position <-5, 0, 10>  color <.9, .9, .9> }
light { position <8, -9, 12>  color <.2, .3, .4> }
background { color <.1, .1, .3> }
sphere { <0, 0, 2>, 2  material { rgb <1, .2, .2> } }
sphere { <2.5, -2, 1>, 1  material { rgb <.2, 1, .2>  refraction .6  ior 1.3 } }
cylinder { <-3, -1, 0>, <-3, -1, 2>, .7  material { ambient .2  reflection 0 } }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
flythrough {
  duration 4
  key { time 0  position <5, -20, 18>  look_at <0, 0, 0> }
  key { time 4  position <15, -20, 10>  look_at <0, 0, 0> }
}
SCENE
