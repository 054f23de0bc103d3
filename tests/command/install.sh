#!/usr/bin/env bash
# The installed program works on its own, in any folder.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

cmake --install "$build_folder" --prefix "$work/a prefix" >log || fault "cmake --install: $(<log)"
mv "a prefix" moved
strahl=$work/moved/bin/strahl
expect 0 "strahl " --version
expect 0 "" render scene.rt -o x.png --size 8x6
expect_file x.png
expect_file moved/share/doc/strahl/LICENSE
for scene in moved/share/strahl/scenes/*.rt; do expect 0 "no errors" check "$scene"; done
finish
