#!/usr/bin/env bash
# The launcher, with mocks of the package manager and the compiler: what it installs, when it builds, and how it starts
# the program.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

# A source tree with the launcher, in a folder with a space, and mocks that log their calls.
root="$work/a tree"
tools="$work/tools"
export LOG="$work/log" MISSING=''
mkdir -p "$root/src" "$root/povref" "$root/.ci" "$root/tests" "$tools" "$work/elsewhere"
cp "$source_folder/strahl" "$root/strahl"
cp "$source_folder/.ci/setup.sh" "$root/.ci/setup.sh"
touch "$root/CMakeLists.txt" "$root/CMakePresets.json" "$root/src/a.cpp"
tool() { cat >"$tools/$1" && chmod +x "$tools/$1"; }
tool dpkg-query <<'TOOL'
#!/bin/bash
for package in "${@:3}"; do
    [[ " $MISSING " == *" $package "* ]] && missing=1 || echo "installed $package"
done
[[ -z ${missing-} ]]
TOOL
tool apt-get <<'TOOL'
#!/bin/bash
echo "apt-get $*" >>"$LOG"
[[ " $* " != *" ${FAILING-nothing} "* ]]
TOOL
tool sudo <<'TOOL'
#!/bin/bash
echo "sudo" >>"$LOG"
exec "$@"
TOOL
tool cmake <<'TOOL'
#!/bin/bash
cat >/dev/null # what reads standard input would eat the scene
if [[ $1 == --build ]]; then
    echo "build ${*:2}" >>"$LOG"
    [[ -s $2/build.ninja ]] || { echo "ninja: error: unknown target 'strahl'"; exit 1; }
    [[ $* != *" -n" ]] || exit 0
    [[ -z ${BROKEN-} ]] || { echo "a.cpp:1: error: it is broken"; exit 1; }
    sleep "${SLOW-0}"
    printf '#!/bin/bash\necho "in $PWD:" "$@"\n[[ ${1-} != - ]] || cat\nexit 7\n' >"$2/strahl"
    chmod +x "$2/strahl"
else
    echo "configure ${*:3}" >>"$LOG"
    cache=$2/build/release/CMakeCache.txt
    levels=$(sed -n 's/.*-DSTRAHL_LEVELS=//p' <<<"$*")
    [[ $levels ]] || levels=$(sed -n 's/^STRAHL_LEVELS:STRING=//p' "$cache")
    built=$(sed -n 's/^STRAHL_BUILT_LEVELS:INTERNAL=//p' "$cache" 2>/dev/null)
    case $FLAGS in *avx512*) built+=";v4" ;; *avx2*) built+=";v3" ;; *) built+=";v2" ;; esac
    printf '%s\n' "CMAKE_HOME_DIRECTORY:INTERNAL=$2" "STRAHL_LEVELS:STRING=$levels" \
        "STRAHL_BUILT_LEVELS:INTERNAL=$built" >"$cache"
    echo "build strahl" >"$2/build/release/build.ninja"
fi
TOOL
tool grep <<TOOL
#!/bin/bash
if [[ \$* == *" /proc/cpuinfo" ]]; then echo "flags : \$FLAGS"; else exec $(command -v grep) "\$@"; fi
TOOL
export PATH="$tools:$PATH" FLAGS="sse4_2 fma avx2 abm"

# launch STATUS LOG ARGUMENT...: starts it in another folder; LOG are the expected calls of the mocks.
launch() {
    local status=$1 log=$2
    shift 2
    rm -f "$LOG"
    said=$(cd "$work/elsewhere" && "${by-$root/strahl}" "$@" 2>"$work/stderr" <<<"a scene")
    local got=$? called
    called=$(cat "$LOG" 2>/dev/null)
    ((got == status)) || fault "exit status $got instead of $status: $(<"$work/stderr")"
    # shellcheck disable=SC2053  # the log is a pattern
    [[ $called == $log ]] || fault "called: $called; instead of: $log"
}
says() { [[ $said == "$1" ]] || fault "standard output is '$said' instead of '$1'"; }
warns() { grep -qF -e "$1" "$work/stderr" || fault "standard error does not say '$1' but: $(<"$work/stderr")"; }

first="configure --preset release -DSTRAHL_TESTS=OFF -DSTRAHL_LEVELS=least
build $root/build/release --target strahl*"
launch 7 "$first" render "a b" '*'
says "in $work/elsewhere: render a b *"
warns "building"

# The second start does and prints nothing; the program gets standard input.
launch 7 "" -
says "in $work/elsewhere: -
a scene"
[[ ! -s $work/stderr ]] || fault "said: $(<"$work/stderr")"
ln -s "../a tree/strahl" "$work/elsewhere/link"
by=./link launch 7 "" hello
says "in $work/elsewhere: hello"

# Changed, new and removed sources cause a build; a failed build is reported, and tried again.
again="build $root/build/release --target strahl*"
sleep 0.02
touch "$root/src/a.cpp"
launch 7 "$again"
launch 7 ""
sleep 0.02
touch "$root/src/b.cpp"
launch 7 "$again"
sleep 0.02
rm "$root/src/b.cpp"
BROKEN=1 launch 1 "$again
build $root/build/release --target strahl -- -n"
warns "it is broken"
says ""
launch 7 "$again"
launch 7 ""

# What the first build leaves out is built when an option asks for it, once.
more="configure --preset release -DSTRAHL_LEVELS"
launch 7 "$more=host
$again" render a --prove map.png
for option in --prove=map.png "--simd scalar" "--simd auto" ""; do
    # shellcheck disable=SC2086  # the words are arguments
    launch 7 "" render a $option
done
launch 7 "$more=runnable
$again" render a --simd v2
launch 7 "" render a --simd=v3
launch 7 "" render a --prove map.png
mv "$root/build/release" "$work/whole"
launch 7 "configure --preset release -DSTRAHL_TESTS=OFF -DSTRAHL_LEVELS=host
$again" render a --simd scalar

# On another processor its own kernels are built, and those of the one before are kept.
newer="sse4_2 fma avx2 abm avx512cd avx512bw avx512vl umip"
FLAGS=$newer launch 7 "$more=host
$again"
launch 7 ""
FLAGS="sse4_2 avx2" launch 7 "$more=host
$again"
FLAGS=$newer launch 7 ""
FLAGS=$newer launch 7 "$more=runnable
$again" render a --simd v2
# Where nothing can be built, the program that is there is started.
other=(env)
((EUID != 0)) || other=(setpriv --reuid=65534 --regid=65534 --clear-groups)
chmod a+rx "$work"
chmod a-w "$root/build"
sed -i 's/;v4//g' "$root/build/release/built"
FLAGS=$newer by=${other[0]} launch 7 "" "${other[@]:1}" "$root/strahl"
chmod u+w "$root/build"
rm -r "$root/build/release"
mv "$work/whole" "$root/build/release"
launch 7 ""

# A program that was cut off is built again, and so is one whose build folder was.
printf '#!/bin/bash\n' >"$root/build/release/strahl"
launch 7 "$again"
launch 7 ""
[[ ! -e $root/build/release/built.new && ! -e $root/build/release/built.sized ]] || fault "a stamp is left over"
sleep 0.02
touch "$root/src/a.cpp"
: >"$root/build/release/build.ninja"
launch 7 "$again
build $root/build/release --target strahl -- -n
configure -B $root/build/release
$again"
warns "damaged"
launch 7 ""

# Two at the same time: one builds, the other waits.
sleep 0.02
touch "$root/src/a.cpp"
rm -f "$LOG"
for i in 1 2; do (SLOW=1 "$root/strahl" $i >"$work/out$i" 2>"$work/err$i" </dev/null) & done
wait
[[ $(grep -l "waiting for another build" "$work"/err?) ]] || fault "none says that it waits: $(cat "$work"/err?)"
[[ $(grep -c build "$LOG") == 1 ]] || fault "two at once: $(<"$LOG")"
[[ $(<"$work/out1") == *": 1" && $(<"$work/out2") == *": 2" ]] || fault "two at once: $(cat "$work"/out?)"

# tests/run -N configures, builds nothing, and lists the tests of both presets.
cp "$source_folder/tests/run" "$root/tests/run"
tool ctest <<'TOOL'
#!/bin/bash
echo "ctest $*" >>"$LOG"
printf 'Could not find executable x\n  Test #1: a_test\n\nTotal Tests: 1\n'
TOOL
by="$root/tests/run" launch 0 "configure --preset release -DSTRAHL_TESTS=ON -DSTRAHL_LEVELS=runnable
ctest --test-dir $root/build/release -LE memory -N -R a
ctest --test-dir $root/build/release -LE slow|window|figures -N -R a" -N -R a
says "  Test #1: a_test
Total Tests: 1
  Test #1: a_test
Total Tests: 1"
rm "$root/tests/run"

# A copy of the tree does not use the build of the original.
cp -a "$root" "$work/copy"
root="$work/copy" launch 7 "configure --preset release -DSTRAHL_TESTS=OFF -DSTRAHL_LEVELS=least
build $work/copy/build/release --target strahl*"
rm -r "$work/copy"

# Missing packages are named, then installed, even if the package list cannot be updated.
rm -r "$root/build"
packages="apt-get -q -y * update
apt-get -q -y * install --no-install-recommends cmake libimgui-dev"
sudo=''
((EUID == 0)) || sudo='sudo
'
export MISSING="libimgui-dev cmake"
launch 7 "$sudo${packages/$'\n'/$'\n'$sudo}
$first"
warns "missing here"
warns "cmake libimgui-dev"
rm -r "$root/build"
FAILING=update launch 7 "*install*$first"
rm -r "$root/build"
FAILING=install launch 1 "*install --no-install-recommends cmake libimgui-dev"
warns "could not install them; try it by hand"

# Who is not root is asked first, at a terminal.
rm -rf "$root/build"
as_user=()
if ((EUID == 0)); then
    chmod -R a+rwX "$work"
    as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi
for answer in n y; do
    rm -f "$LOG"
    "${as_user[@]}" script -qec "'$root/strahl' said" "$work/terminal" <<<"$answer" >/dev/null
    grep -qF "install them now?" "$work/terminal" || fault "does not ask before sudo: $(<"$work/terminal")"
    [[ $answer == y || ! -e $LOG ]] || fault "installs in spite of 'n': $(<"$LOG")"
    [[ $answer == n || $(<"$LOG") == *sudo*install* ]] || fault "does not install after 'y': $(<"$LOG")"
done
grep -qF "said" "$work/terminal" || fault "does not go on after 'y': $(<"$work/terminal")"

# On a release whose compiler is too old it says so and installs nothing.
rm -r "$root/build"
for release in "debian 11" "ubuntu 22.04"; do
    printf 'ID=%s\nVERSION_ID="%s"\nPRETTY_NAME="The %s"\n' $release "$release" >"$work/os-release"
    SYSTEMD_OS_RELEASE="$work/os-release" launch 1 ""
    warns "The $release is too old: strahl builds on Debian from 12 on and on Ubuntu from 24.04 on"
done
for release in "debian 13" "debian" "ubuntu 24.04" "other 3"; do
    printf 'ID=%s\nVERSION_ID="%s"\n' $release >"$work/os-release"
    SYSTEMD_OS_RELEASE="$work/os-release" launch 7 "*install*$first"
    rm -r "$root/build"
done

# Without root and sudo it prints what to do.
rm -rf "$tools/sudo" "$root/build" "$LOG"
mkdir "$work/bin"
for program in bash cat chmod dirname env find flock grep mkdir mv readlink rm sed setpriv sleep stat sync tail touch; do
    ln -s "$(command -v "$program")" "$work/bin/$program"
done
PATH="$tools:$work/bin"
"${as_user[@]}" "$root/strahl" 2>"$work/stderr" && fault "went on without the packages"
warns "only root (or sudo) can install them: apt-get install --no-install-recommends cmake libimgui-dev"

# In a tree that it cannot write to it says where to build.
rm -rf "$root/build"
chmod a-w "$root"
"${as_user[@]}" "$root/strahl" 2>"$work/stderr" && fault "built in a tree without permission to write"
grep -qxF "strahl: cannot write to $root/build, where the program is built: copy the tree to a folder of your own and\
 start it there" "$work/stderr" || fault "in a tree without permission to write it says: $(<"$work/stderr")"
chmod u+w "$root"

# On other systems it prints what is needed, in the words of the package manager that is there, and tries to build.
rm "$tools/dpkg-query"
launch 7 "$first"
warns "not a Debian system"
warns "what Debian calls g++ cmake"
for words in "dnf install gcc-c++" "pacman -S --needed gcc" "zypper install gcc-c++"; do
    rm -r "$root/build"
    : | tool "${words%% *}"
    launch 7 "$first"
    warns "    sudo $words cmake ninja"
    grep -q "libopenimageio-dev" "$work/stderr" && fault "a package has Debian's name: $(<"$work/stderr")"
    rm "$tools/${words%% *}"
done
# shellcheck source=../../.ci/setup.sh
source "$root/.ci/setup.sh"
# shellcheck disable=SC2154  # setup.sh sets them
for package in "${build_packages[@]}" "${test_packages[@]}"; do
    read -ra row < <(grep "^$package " <<<"$names_elsewhere")
    ((${#row[@]} == 4)) || fault "of $package there are no names on other systems in names_elsewhere"
done
PATH="$tools:/usr/bin:/bin"
finish
