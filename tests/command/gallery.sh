#!/usr/bin/env bash
# The gallery and the tutorial show their scenes as they are: made anew and small, pictures and page are the same.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

scenes=$source_folder/scenes
"$scenes/make_pictures" "$strahl" 40x30 "$work" >log 2>&1 || fault "make_pictures: $(<log)"
without_times() { sed 's/^[0-9.]* s\.$//' "$1"; }
diff <(without_times README.md) <(without_times "$scenes/README.md") || fault "scenes/README.md is out of date"
expect_pictures() { # FOLDER
    [[ $(ls "$1"/*.jpg) == "$(cd "$scenes" && ls "$1"/*.jpg)" ]] || fault "scenes/$1 has other pictures: $(ls "$1")"
    local picture difference
    for picture in "$1"/*.jpg; do
        convert "$scenes/$picture" -resize 40x30 stored.png
        difference=$(compare -metric RMSE "$picture" stored.png null: 2>&1 | sed 's/.*(\(.*\))/\1/')
        awk -v difference="$difference" 'BEGIN { exit !(difference < .09) }' ||
            fault "$picture is another picture now, by $difference: run scenes/make_pictures"
    done
}
expect_pictures tutorial
expect_pictures gallery
finish
