#!/usr/bin/env bash
# The pages: the README's scene renders to its picture, its error message is current, no page has a broken link, and
# commands, options and figures are those of the program and of the tree.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

sed -n '/^\/\/ Two balls/,/^```$/{/^```$/!p}' "$source_folder/README.md" >balls.rt
expect 0 "2 spheres, 1 plane, 1 cylinder" check balls.rt
expect 0 "" render balls.rt -o balls.png
expect 0 "0 of 307200" compare balls.png "$source_folder/assets/balls.png" --tolerance 0.004

sed 's/^sphere { <-1/shpere { <-1/' balls.rt >wrong.rt
told=$("$strahl" check wrong.rt 2>&1 | sed s/wrong.rt/balls.rt/)
[[ $(<"$source_folder/README.md") == *"$told"* ]] || fault "the README quotes another message than: $told"

# Links of every page, relative to its folder, and the headings that they name.
headings() { grep -oP '^#+ \K.*' "$1" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-'; }
while read -r page; do
    while read -r link; do
        target=$(dirname "$page")/${link%%#*}
        [[ $link != \#* ]] || target=$page
        [[ -e $target ]] || fault "$page points to $link, which is not there"
        [[ $link != *#* || $(headings "$target") =~ (^|$'\n')"${link#*#}"($'\n'|$) ]] || fault "$page: no heading for $link"
    done < <(grep -oP '\]\(\K[^)]+' "$page" | grep -v '^https:')
done < <(find "$source_folder" -name '*.md' -not -path '*/build/*')
while read -r scene; do
    [[ -e $source_folder/$scene ]] || fault "the README names $scene, which is not there"
done < <(grep -oP '\./strahl ([a-z]+ )?\Kscenes/[a-z_]+\.rt' "$source_folder/README.md")

# The tables of commands and options, and the defaults that they state, agree with --help.
readme=$source_folder/README.md
documented() { grep -oP '^\| `strahl \K[a-z]+' "$readme" | sort -u; }
offered() { "$strahl" --help | sed '1,/^Subcommands/d' | grep -oP '^  \K[a-z]+' | sort -u; }
[[ $(documented) == "$(offered | grep -vx view)" ]] || fault "the README has the commands: $(documented | xargs)"
"$strahl" render --help >help
while read -r option; do
    meaning=$(grep -m 1 -e "^  \(-o,\)\?$option " help) || fault "the README has $option, which render does not know"
    default=$(grep -e "^| \`$option" "$readme" | grep -oP '[^ ;]+(?= by default)')
    [[ $meaning == *"$default by default"* || -z $default ]] || fault "by default $option is not $default: $meaning"
done < <(grep -oP '^\| `\K--[a-z]+' "$readme")
statuses=$(grep -o 'Exit status: 0 done.*interrupted' "$readme")
[[ -n $statuses && $("$strahl" --help) == *"$statuses"* ]] || fault "the README has other exit statuses: $statuses"

# Figures: the frames of the film, the kinds of bodies, the scenes compared with POV-Ray.
frames=$(grep -oP 'its \K[0-9]+(?= pictures)' "$readme")
seconds=$("$strahl" check "$source_folder/scenes/demo.rt" | grep -oP 'flythrough +\K[0-9]+(?= s)')
((frames == 25 * seconds)) || fault "the README says $frames pictures, and scenes/demo.rt has $seconds s at 25 a second"
bodies=$(tr '\n[:upper:]' ' [:lower:]' <"$readme" | grep -oP 'bodies are \K[^.]*')
for kind in "$source_folder"/scenes/kinds/*.rt; do
    kind=$(basename "$kind" .rt | tr _ ' ' | sed 's/us$/i/')
    [[ ", $bodies" =~ [,\ ]$kind(s|es)?([,\ ]|$) ]] || fault "the README does not name the body $kind"
done
comparison=$source_folder/povref/README.md
read -r scenes compared < <(grep -oP '^Of the \K[0-9]+ scenes .* [0-9]+(?= are compared)' "$comparison" | sed 's/ .* / /')
(($(find "$source_folder/scenes" -name '*.rt' | wc -l) == scenes)) || fault "$comparison speaks of $scenes scenes"
rows=$(sed -n '/results: begin/,/results: end/p' "$comparison" | grep -cE '^\| [a-z_/0-9]+ \| [0-9]')
left_out=$(awk '!/^#/ && $3 == 1' "$source_folder/povref/allowed.txt" | wc -l)
((rows == compared && compared == scenes - left_out)) || fault "$comparison: $compared compared, $rows rows, $left_out left out"
finish
