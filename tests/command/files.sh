#!/usr/bin/env bash
# Files that cannot be read or written: exit status 3 and 1; existing files survive a failure.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

make() { expect "$1" "$2" render "$3" -o "$4" --size 8x6 "${@:5}"; }

make 3 "cannot read" missing.rt x.bmp
mkdir folder
make 3 "directory" folder x.bmp
expect 3 "missing.rt" check missing.rt
make 1 "its folder does not exist" scene.rt no/such/x.bmp
make 1 "not a folder" scene.rt scene.rt/x.bmp
mkdir x.bmp
make 1 "name a file in it" scene.rt x.bmp
rmdir x.bmp folder
make 1 "cannot write '/proc/x.bmp'" scene.rt /proc/x.bmp
make 1 "its folder does not exist" scene.rt x.bmp --stats no/such/stats.json
expect_only scene.rt
"$strahl" check scene.rt >/dev/full 2>said && fault "a full disk went unnoticed"
grep -q "standard output" said || fault "of a full disk it said: $(<said)"
"$strahl" render scene.rt -o - --format bmp --size 8x6 >/dev/full 2>said
(($? == 1)) || fault "a full disk went unnoticed: $(<said)"
for words in --help "stability scene.rt --size 4x3" "compare $source_folder/assets/balls.png $source_folder/assets/balls.png"; do
    # shellcheck disable=SC2086  # the words are arguments
    "$strahl" $words >/dev/full 2>said
    (($? == 1)) || fault "strahl $words: a full disk went unnoticed: $(<said)"
    grep -q "standard output" said || fault "of a full disk it said: $(<said)"
done
rm said

# Root may write everywhere, so another user tries.
mkdir sealed
make 0 "" scene.rt sealed/x.bmp
chmod 555 sealed
as_user=()
if ((EUID == 0)); then
    chmod 755 .
    as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi
if "${as_user[@]}" "$strahl" --version >/dev/null 2>&1; then
    "${as_user[@]}" "$strahl" render scene.rt -o sealed/y.bmp --size 8x6 >said 2>&1
    (($? == 1)) || fault "a sealed folder: $(<said)"
    grep -q "cannot write 'sealed/y.bmp'" said || fault "a sealed folder: $(<said)"
    rm said
fi
chmod 755 sealed
rm -r sealed

# A file that the command also reads or writes is not overwritten, under any name.
cp scene.rt kept.rt
cp scene.rt kept.png
cp scene.rt kept.flight
echo 'sphere { 0, 1 }' >kept.pov
echo 'Input_File_Name=kept.pov' >kept.ini
cp kept.ini kept-before.ini
cp scene.rt film-0007.png
mkdir same
ln -s ../kept.rt same/link.rt
ln kept.rt hard.rt
keep() { expect 2 "would overwrite" "$@"; }
for name in kept.rt ./kept.rt same/../kept.rt same/link.rt hard.rt; do keep render kept.rt -o x.png --stats "$name"; done
for name in x.png ./x.png same/../x.png "$PWD/x.png"; do keep render kept.rt -o x.png --stats "$name"; done
ln -s ../x.png same/dangling
keep render kept.rt -o x.png --stats same/dangling
keep render kept.png -o kept.png
keep render film-0007.png -o film-%04d.png --frames 0-99
keep render kept.rt -o film.png --frames 0-99 --stats film-0012.png
keep stability kept.png -o kept.png
keep pov kept.ini -o kept.pov
cp kept.pov other.pov
echo 'Input_File_Name=other.pov' >film.ini
keep pov film.ini -o film.pov
keep render kept.ini -o x.png --stats kept.ini
keep render kept.pov -o x.png --stats kept.ini
keep render kept.pov -o x.png --stats kept.flight
keep crosscheck kept.png --sheet kept.png
keep crosscheck kept.rt same/kept.rt --sheet x.png
for name in kept.rt kept.png kept.flight film-0007.png hard.rt; do expect_same scene.rt "$name"; done
expect_same kept-before.ini kept.ini
make 0 "" scene.rt one.png
make 0 "" scene.rt two.png --depth 1
cp two.png three.png
keep compare one.png two.png --heatmap two.png
keep compare one.png two.png --heatmap ./one.png
expect_same two.png three.png
make 0 "" scene.rt film-0012.png --stats film-12.json
rm -r same hard.rt kept.* kept-before.ini other.pov film.ini film-* one.png two.png three.png

# Control characters in names do not reach the terminal.
csi=$'\xc2\x9b'  # U+009B in UTF-8, whatever the locale
steering=$'red\e[31m'${csi}2J.rt
cp scene.rt "$steering"
"$strahl" render scene.rt -o $'\e[1m.png' --size 8x6
for words in "check $steering" "check no$steering" "render $steering -o no/$steering.png" "render -o $steering $steering" \
    "compare "$'\e[1m.png '$'\e[1m.png' "compare $steering $steering" "pov $steering -o x$steering.pov" "$steering$steering" \
    "render $steering -o x.png --$steering"; do
    # shellcheck disable=SC2086  # the words are arguments
    said=$("$strahl" $words 2>&1)
    [[ -n $said && $said != *$'\e'* && $said != *$csi* ]] || fault "strahl $words: $(od -c <<<"$said" | head -5)"
done
cat scene.rt >"$steering"
echo "sphere {" >>"$steering"
"$strahl" check "$steering" 2>&1 | grep -q $'\e' && fault "a fault's place steers the terminal"
rm -f -- red* xred* $'\e[1m.png'

# A failure keeps the older picture.
echo "an older picture" >x.bmp
cp x.bmp older
echo "sphere { oops" >broken.rt
make 3 "broken.rt:1:" broken.rt x.bmp
make 2 "exclude" scene.rt x.bmp --frames 0-1 --time 1
make 1 "no/such" scene.rt x.bmp --stats no/such/stats.json
expect_same x.bmp older
make 0 "" scene.rt x.bmp
expect_other x.bmp older

# Unusual names, and a symbolic link that stays one.
ln -s x.bmp link.bmp
cp older x.bmp
make 0 "" scene.rt link.bmp
[[ -L link.bmp ]] || fault "the link is gone"
expect_other x.bmp older
make 0 "" scene.rt "a name with ' and ä.bmp"
make 0 "" scene.rt X.BMP
cp scene.rt -- -scene.rt
make 0 "" ./-scene.rt ./-x.bmp
expect_only scene.rt broken.rt older x.bmp link.bmp "a name with ' and ä.bmp" X.BMP -scene.rt -x.bmp
finish
