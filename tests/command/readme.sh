#!/usr/bin/env bash
# The README: its scene renders to its picture, its error message is current, and no page has a broken link.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

sed -n '/^\/\/ Two balls/,/^```$/{/^```$/!p}' "$source_folder/README.md" >balls.rt
expect 0 "2 spheres, 1 plane, 1 cylinder" check balls.rt
expect 0 "" render balls.rt -o balls.png
expect 0 "0 of 307200" compare balls.png "$source_folder/assets/balls.png" --tolerance 0.004

sed 's/^sphere { <-1/shpere { <-1/' balls.rt >wrong.rt
told=$("$strahl" check wrong.rt 2>&1 | sed s/wrong.rt/balls.rt/)
[[ $(<"$source_folder/README.md") == *"$told"* ]] || fault "the README quotes another message than: $told"

# Links of every page, relative to its folder; anchors are not checked.
while read -r page; do
    while read -r link; do
        [[ -e $(dirname "$page")/${link%%#*} ]] || fault "$page points to $link, which is not there"
    done < <(grep -oP '\]\(\K[^)]+' "$page" | grep -v '^https:')
done < <(find "$source_folder" -name '*.md' -not -path '*/build/*')
while read -r scene; do
    [[ -e $source_folder/$scene ]] || fault "the README renders $scene, which is not there"
done < <(grep -oP '\./strahl (render )?\Kscenes/[a-z_]+\.rt' "$source_folder/README.md")
finish
