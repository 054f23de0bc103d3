#!/usr/bin/env bash
# Files that can't be read or written: exit status 3 and 1; and what was there before a failure is there after it.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

make() { expect "$1" "$2" render "$3" -o "$4" --size 8x6 "${@:5}"; }

make 3 "can't be read" missing.rt x.bmp
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
rm said

# Root may write everywhere: then someone else tries.
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

# What a name holds does not steer the terminal.
steering=$'red\e[31m\u009b2J.rt'
cp scene.rt "$steering"
"$strahl" render scene.rt -o $'\e[1m.png' --size 8x6
for words in "check $steering" "check no$steering" "render $steering -o no/$steering.png" "render -o $steering $steering" \
    "compare "$'\e[1m.png '$'\e[1m.png' "compare $steering $steering" "pov $steering -o x$steering.pov" "$steering$steering" \
    "render $steering -o x.png --$steering"; do
    # shellcheck disable=SC2086  # the words are arguments
    said=$("$strahl" $words 2>&1)
    [[ -n $said && $said != *[$'\e\u009b']* ]] || fault "strahl $words: $(od -c <<<"$said" | head -5)"
done
cat scene.rt >"$steering"
echo "sphere {" >>"$steering"
"$strahl" check "$steering" 2>&1 | grep -q $'\e' && fault "a fault's place steers the terminal"
rm -f -- red* xred* $'\e[1m.png'

# A failure leaves the older picture alone.
echo "an older picture" >x.bmp
cp x.bmp older
echo "sphere { oops" >broken.rt
make 3 "broken.rt:1:" broken.rt x.bmp
make 2 "exclude" scene.rt x.bmp --frames 0-1 --time 1
make 1 "no/such" scene.rt x.bmp --stats no/such/stats.json
expect_same x.bmp older
make 0 "" scene.rt x.bmp
expect_other x.bmp older

# Names that need care, and a link that stays one.
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
