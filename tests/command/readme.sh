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

# The page of commands lists the commands and the options of render, and the defaults that it states are theirs.
readme=$source_folder/README.md commands=$source_folder/src/main/commands.md
documented() { grep -oP '^\| `strahl \K[a-z]+' "$commands" | sort -u; }
offered() { "$strahl" --help | sed '1,/^Subcommands/d' | grep -oP '^  \K[a-z]+' | sort -u; }
[[ $(documented) == "$(offered | grep -vx view)" ]] || fault "$commands has the commands: $(documented | xargs)"
"$strahl" render --help >help
while read -r option; do
    meaning=$(grep -m 1 -e "^  \(-o,\)\?$option " help) || fault "$commands has $option, which render does not know"
    default=$(grep -e "^| \`$option" "$commands" | grep -oP '[^ ;]+(?= by default)')
    [[ $meaning == *"$default by default"* || -z $default ]] || fault "by default $option is not $default: $meaning"
done < <(grep -oP '^\| `\K--[a-z]+' "$commands")
while read -r option; do
    grep -q "^| \`$option[ \`]" "$commands" || fault "$commands lacks $option of render"
done < <(grep -oP '^  (-[a-z],)?\K--[a-z]+' help | grep -vx -e --help)
statuses=$(grep -o 'Exit status: 0 done.*interrupted' "$commands")
[[ -n $statuses && $("$strahl" --help) == *"$statuses"* ]] || fault "$commands has other exit statuses: $statuses"

# The page of keys has the keys and the help of all commands, and no others.
own_keys() { sed -nE 's/^\| (`.*` \| .*) \|$/\1/p' "$source_folder/src/show/keys.md"; }
known_keys() { XDG_CONFIG_HOME=$work "$strahl" view --list-keys | sed -nE 's/^[a-z-]+ = (.*[^ ]) +\/\/ (.*)$/`\1` | \2/p'; }
difference=$(diff <(own_keys) <(known_keys)) || fault "the page of keys is not what --list-keys says: $difference"
(($(known_keys | wc -l) > 50)) || fault "--list-keys lists few keys"

# Pages list the formats of pictures that are read and written.
endings() { grep -oE '\.[a-z]{3}\b' | sort -u | xargs; }
echo text >text.png
read_formats=$("$strahl" compare text.png text.png 2>&1 | grep -o 'is not a \..*' | endings)
written=$("$strahl" render balls.rt -o x.nothing 2>&1 | grep -oP 'are written as \K.*(?=; give)' | endings)
[[ $read_formats == *.exr* && $written == *.exr* ]] || fault "no formats: $read_formats; $written"
listed() { # NAME PAGE FIRST LAST: the endings in the page from one word to another one
    local own
    own=$(tr '\n' ' ' <"$source_folder/$2" | grep -oP "$3.*?$4" | head -1 | endings)
    [[ $own == "$1" ]] || fault "$2 lists $own; the program has $1"
}
listed "$read_formats" tests/attack/promises.md 'Pictures are read by' 'recognised by'
listed "$read_formats" src/text/README.md 'An `image` is a picture file' 'With the map'
listed "$read_formats" assets/FAQ.md 'It reads' 'files'
listed "$written" assets/FAQ.md 'Can it write JPEG' 'convert'
listed "$written" src/main/commands.md 'renders a picture' 'or a \[film'
# Those that OpenImageIO decodes; models; films.
constants() { grep -oP "$2" "$source_folder/src/$1" | grep -oP '"\.?\K[a-z0-9]+(?=")' | sed 's/openexr/exr/; s/^/./' | sort -u | xargs; }
endings() { grep -oP '(?<!\w)\.[a-z]+[0-9]?\b' | sort -u | xargs; }
by_library=$(constants image/recognise.cpp 'nullptr, "[a-z]+"')
models=$(constants import/models/model.cpp 'endings\{.*\}')
films=$(constants image/film.cpp 'ending == "[.a-z0-9]+"')
[[ $by_library == *.exr* && $models == *.obj* && $films == *.mp4* ]] || fault "no formats: $by_library; $models; $films"
listed "$by_library" src/building.md 'To read' 'and to write'
listed "$by_library" tests/attack/promises.md 'are decoded by OpenImageIO:' '\. '
listed "$models" README.md 'camera, light and floor for' 'files'
listed "$models" src/main/commands.md 'a \[model\]\(../import/models/README.md\),' '\. '
listed "$films" src/main/commands.md 'or a \[film' '\|'

# Options of Strahl that pages for users name are those of some command, and keys those of the window.
for command in '' $(offered); do "$strahl" $command --help; done | grep -oP '(?<![\w-])--[a-z][a-z-]*' | sort -u >options
(($(wc -l <options) > 40)) || fault "there are few options: $(xargs <options)"
known_keys | grep -oP '^`\K[^`]*' | tr ' ' '\n' | sed 's/1-9$/1\n&/' >keys
users_pages=(README.md assets/{FAQ,CHANGELOG}.md src/{show,pov,import,import/models,main/lsp}/README.md src/main/*.md
    scenes/README.md scenes/tutorial/README.md povref/README.md tests/{proof,stability}/README.md tests/attack/promises.md)
for page in "${users_pages[@]}"; do
    own=$(grep -ohP '(?<![\w-])--[a-z][a-z-]*' "$source_folder"/$page | sort -u | comm -23 - options | xargs)
    [[ -z $own ]] || fault "$page names options that no command has: $own"
done
while read -r key; do
    grep -qxF "$key" keys || fault "the window's page names the key $key, which does nothing"
done < <(grep -v '^    ' "$source_folder/src/show/README.md" | grep -oP '(?<![\w+])((Ctrl|Shift)\+)+([A-Z0-9]|F[0-9]+)\b|(?<![\w+/])F[0-9]+\b' | sort -u)

# The tests that the promises name are there.
ctest --test-dir "$build_folder" -N | grep -oP '#\d+: \K.*' >tests
while read -r test; do
    grep -qx "$test" tests || fault "promises.md names the test $test, which is not there"
done < <(tr '\n' ' ' <"$source_folder/tests/attack/promises.md" | grep -oP '\*\([^*]*\)\*' | grep -oP '`\K[a-z_]+(?=`)' | sort -u)

# Limits that the promises state are those of the code.
promises=$(tr '\n' ' ' <"$source_folder/tests/attack/promises.md" | tr -s ' ')
while IFS='|' read -r words file code; do
    [[ $promises == *"$words"* ]] || fault "promises.md does not say '$words'"
    grep -qF "$code" "$source_folder/src/$file" || fault "promises.md says '$words'; $file has no '$code'"
done <<'END'
nested at most 32 levels deep|text/parser.cpp|most_levels = 32;
at most 100,000 simple bodies, of which 1024|scene/kinds/composite.h|most_parts = 100'000, most_leaves = 1024;
at most 1 GiB|files/read_file.h|limit = std::size_t(1) << 30
5,000,000 bodies, 1000 transformations|text/reading/text_limits.h|primitives = 5'000'000;
1000 transformations of one body|text/reading/text_limits.h|transformations = 1000;
65,536 lights|text/reading/text_limits.h|lights = 1 << 16;
1,048,576 keys|text/reading/text_limits.h|keys = 1 << 20;
5,000,000 bodies, nested at most 2000 levels|pov/reading/reader.h|most_bodies = 5'000'000, most_levels = 2000;
nested at most 400 levels|pov/language/interpreter_options.h|nesting = 400;
at most 200,000,000 words|pov/language/interpreter_options.h|steps = 200'000'000;
may take 4 GiB|pov/language/interpreter_options.h|bytes = std::size_t(4) << 30;
at most 2^28 values|image/picture.h|most_values_read = std::uint64_t(1) << 28;
at most 2^27 values|image/pixels.cpp|most_values = std::uint64_t(1) << 27;
32,768 pixels along a side|image/pixels.cpp|most_pixels = 1 << 15;
a mesh 20,000,000 triangles|mesh/read_mesh.h|most_triangles = 20'000'000;
60,000,000 points|mesh/read_mesh.h|most_points = 60'000'000;
may be at most 1000|mesh/split.h|most_concave = 1000;
the JSON of a glTF file 128 MiB|import/models/gltf_file.cpp|most_text = 128 << 20;
1,000,000,000 numbers|import/models/gltf_file.cpp|most_numbers = 1'000'000'000;
nodes at most 100 levels|import/models/gltf.cpp|most_depth = 100;
at most 1,000,000 pixels|main/render/values.cpp|longest_side = 1'000'000;
depth at most 256|text/reading/parameter.h|depths{1, 256,
Each band of 64 rows|image/encoder.h|band_rows = 64;
END

# The README's figures are those of the measured tables.
comparison=$source_folder/tests/bench/scenes/table.md
read -r count float < <(grep -oP '^[0-9]+ scenes; POV-Ray over float: median [0-9.]+' "$comparison" | head -1 | tr -cd '0-9. \n')
grep -q "the $count scenes" "$readme" && grep -q "is $(printf %.0f "$float") times as fast as POV-Ray" "$readme" ||
    fault "the README's speed is not that of $comparison: $count scenes, $float"
for row in 'Strahl reads them' 'within scope' 'of these open whole' 'agree off the edges'; do
    figure=$(grep -oP "^\| $row[^|]*\| \K[0-9]+" "$source_folder/tests/bench/pov_corpus.md" | head -1)
    tr '\n' ' ' <"$readme" | grep -q "scenes as they are.*[^0-9]$figure[^0-9].*as fast as" ||
        fault "the README lacks the figure of pov_corpus.md: $row $figure"
done

flown=$(grep -oP '^\| article\.rt, 960x720 \| \K[0-9.]+(?= \|)' "$source_folder/tests/bench/window.md" | tail -1)
grep -q "show $flown pictures" "$readme" || fault "the README's flight is not that of tests/bench/window.md: $flown"

# The scenes of the language's page, and its blocks in front of a camera, have no errors; files that they name are not there.
eye='camera { position <0, -9, 4>  look_at <0, 0, 1>  sky <0, 0, 1>  angle 40 }'
awk -v eye="$eye" '/^```/ { if (inside && text ~ /^(camera|\/\/|[a-z_]+ +\{|define)/ && text !~ /\.(png|obj)|^material/)
        printf "%s", (text ~ /camera \{/ ? "" : eye "\n") text > ("page" ++n ".rt")
    inside = !inside; text = ""; next }
    inside { text = text $0 "\n" }' "$source_folder/src/text/README.md"
(($(find . -name 'page*.rt' | wc -l) > 15)) || fault "the language's page has few scenes"
for scene in page*.rt; do expect 0 "no errors" check "$scene"; done

# Figures: the kinds of bodies, the scenes compared with POV-Ray.
bodies=$(tr '\n[:upper:]' ' [:lower:]' <"$readme" | grep -oP 'bodies are \K[^.]*')
for kind in "$source_folder"/scenes/kinds/*.rt; do
    kind=$(basename "$kind" .rt | tr _ ' ' | sed 's/us$/i/')
    [[ ", $bodies" =~ [,\ ]$kind(s|es)?([,\ ]|$) ]] || fault "the README does not name the body $kind"
done
comparison=$source_folder/povref/README.md
read -r scenes compared < <(grep -oP '^Of the \K[0-9]+ scenes .* [0-9]+(?= are compared)' "$comparison" | sed 's/ .* / /')
(($(find "$source_folder/scenes" -name '*.rt' | wc -l) == scenes)) || fault "$comparison speaks of $scenes scenes"
rows=$(grep -cE '^\| [a-z_/0-9]+ \| [0-9]+ \| [0-9]+ \| [0-9]+ \|' "$source_folder/povref/results.md")
left_out=$(awk '!/^#/ && $3 == 1' "$source_folder/povref/allowed.txt" | wc -l)
((rows == compared && compared == scenes - left_out)) || fault "$comparison: $compared compared, $rows rows, $left_out left out"
finish
