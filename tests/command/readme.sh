#!/usr/bin/env bash
# The README: its scene is one, its picture shows it, its message is told so, and what it points to is there.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

sed -n '/^\/\/ Two balls/,/^```$/{/^```$/!p}' "$source_folder/README.md" >balls.rt
expect 0 "2 spheres, 1 plane, 1 cylinder" check balls.rt
expect 0 "" render balls.rt -o balls.png
expect 0 "0 of 307200" compare balls.png "$source_folder/assets/balls.png" --tolerance 0.004

sed 's/^sphere { <-1/shpere { <-1/' balls.rt >wrong.rt
told=$("$strahl" check wrong.rt 2>&1 | sed s/wrong.rt/balls.rt/)
[[ $(<"$source_folder/README.md") == *"$told"* ]] || fault "the README tells another message than: $told"

while read -r link; do
    [[ -e $source_folder/$link ]] || fault "the README points to $link, which is not there"
done < <(grep -oP '\]\(\K[^)]+' "$source_folder/README.md" | grep -v '^https:')
while read -r scene; do
    [[ -e $source_folder/$scene ]] || fault "the README renders $scene, which is not there"
done < <(grep -oP '\./strahl (render )?\Kscenes/[a-z_]+\.rt' "$source_folder/README.md")
finish
