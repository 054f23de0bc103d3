# shellcheck shell=bash
# Functions that `strahl`, `tests/run` and `tests/attack/run` share: they install Debian packages and build a preset.
# shellcheck disable=SC2034  # the lists are for those scripts

build_packages=(g++ cmake ninja-build pkg-config libglfw3-dev libgl-dev libglm-dev libopenimageio-dev zlib1g-dev
    libpng-dev libturbojpeg0-dev libfreetype-dev libimgui-dev libcli11-dev nlohmann-json3-dev libopenal-dev
    libvorbis-dev)
# Debian 12's own clang is older than 16, which the sanitize preset needs; 13 has no 16.
clang=$(
    # shellcheck source=/dev/null
    source "${SYSTEMD_OS_RELEASE-/etc/os-release}" 2>/dev/null || true
    [[ ${ID-} == debian && ${VERSION_ID-} != 12 ]] && echo 19 || echo 16
)
test_packages=(doctest-dev povray povray-includes ffmpeg xvfb xauth libgl1-mesa-dri xdotool imagemagick
    openimageio-tools parallel dpkg-dev clang-format "clang-$clang" "libclang-rt-$clang-dev")
# Lists the names of each package in Debian, Fedora, Arch and openSUSE; "-" stands where a system may have none.
names_elsewhere="
g++               gcc-c++                 gcc              gcc-c++
cmake             cmake                   cmake            cmake
ninja-build       ninja-build             ninja            ninja
pkg-config        pkgconf-pkg-config      pkgconf          pkg-config
libglfw3-dev      glfw-devel              glfw             libglfw-devel
libgl-dev         mesa-libGL-devel        libglvnd         Mesa-libGL-devel
libglm-dev        glm-devel               glm              glm-devel
libopenimageio-dev OpenImageIO-devel      openimageio      OpenImageIO-devel
zlib1g-dev        zlib-devel              zlib             zlib-devel
libpng-dev        libpng-devel            libpng           libpng16-devel
libturbojpeg0-dev turbojpeg-devel         libjpeg-turbo    libjpeg8-devel
libfreetype-dev   freetype-devel          freetype2        freetype2-devel
libimgui-dev      -                       imgui            imgui-devel
libcli11-dev      cli11-devel             cli11            cli11-devel
nlohmann-json3-dev json-devel             nlohmann-json    nlohmann_json-devel
libopenal-dev     openal-soft-devel       openal           openal-soft-devel
libvorbis-dev     libvorbis-devel         libvorbis        libvorbis-devel
doctest-dev       doctest-devel           doctest          doctest-devel
povray            -                       povray           povray
povray-includes   -                       povray           povray
ffmpeg            ffmpeg                  ffmpeg           ffmpeg
xvfb              xorg-x11-server-Xvfb    xorg-server-xvfb xorg-x11-server-Xvfb
xauth             xorg-x11-xauth          xorg-xauth       xauth
libgl1-mesa-dri   mesa-dri-drivers        mesa             Mesa-dri
xdotool           xdotool                 xdotool          xdotool
imagemagick       ImageMagick             imagemagick      ImageMagick
openimageio-tools -                       openimageio      -
parallel          parallel                parallel         gnu_parallel
dpkg-dev          -                       dpkg             -
clang-format      clang-tools-extra       clang            clang
clang-$clang          clang                   clang            clang
libclang-rt-$clang-dev compiler-rt            compiler-rt      -
"

say() { printf 'strahl: %s\n' "$*" >&2; }
die() {
    say "$@"
    exit 1
}

# Makes the build folder, takes its lock, and leaves it in $lock. Says so if another build holds it.
lock_build() { # ROOT
    mkdir -p "$1/build" 2>/dev/null || true
    [[ -w $1/build ]] ||
        die "cannot write to $1/build, where the program is built:" \
            "copy the tree to a folder of your own and start it there"
    exec {lock}>"$1/build/lock"
    flock -n "$lock" && return
    say "waiting for another build of this tree to end"
    flock "$lock"
}

# Runs a command with its output in a log; shows the log's end if it fails. Standard input stays the caller's scene.
logged() {
    local log=$1
    shift
    "$@" >"$log" 2>&1 </dev/null && return
    tail -n 40 "$log" >&2
    say "this failed: $*"
    say "the whole log is $log"
    return 1
}

# Says what a system without apt calls the given Debian packages, and how it installs them.
name_packages() { # PACKAGE...
    local column=0 install='' names=() others=() row package name
    if command -v dnf >/dev/null; then
        column=1 install='dnf install'
    elif command -v pacman >/dev/null; then
        column=2 install='pacman -S --needed'
    elif command -v zypper >/dev/null; then
        column=3 install='zypper install'
    fi
    for package; do
        name=-
        while read -ra row; do
            [[ ${row[0]-} != "$package" || $column == 0 ]] || name=${row[column]}
        done <<<"$names_elsewhere"
        if [[ $name != - ]]; then names+=("$name"); else others+=("$package"); fi
    done
    say "not a Debian system: nothing is installed. These packages are needed, if they are not there yet:"
    [[ -z $install ]] || say "    sudo $install ${names[*]}"
    ((${#others[@]} == 0)) || say "    ${install:+and }what Debian calls ${others[*]}"
    [[ -z $install || " ${others[*]} " != *" libimgui-dev "* ]] ||
        say "without Dear ImGui there is no window; once, before this: cmake --preset release -D STRAHL_WINDOW=OFF"
}

# Stops on releases whose compiler and libraries are too old, before anything is installed.
require_release() {
    local ID='' VERSION_ID='' PRETTY_NAME='' first=0
    # shellcheck source=/dev/null
    source "${SYSTEMD_OS_RELEASE-/etc/os-release}" 2>/dev/null || return 0
    case $ID in
    debian) first=12 ;;
    ubuntu) first=24 ;;
    esac
    [[ ! $VERSION_ID =~ ^[0-9]+ ]] || ((BASH_REMATCH[0] >= first)) ||
        die "$PRETTY_NAME is too old: strahl builds on Debian from 12 on and on Ubuntu from 24.04 on;" \
            "src/building.md says how to make a package there that runs here"
}

# Installs those of the given Debian packages that are not there yet, and says so first. Asks before it uses sudo, if
# there is a terminal.
install_packages() {
    local root=$1 missing=() package
    shift
    if ! command -v dpkg-query >/dev/null; then
        name_packages "$@"
        return
    fi
    local there
    there=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' || true)
    for package in "$@"; do
        grep -qxF -e "$package" <<<"$there" || missing+=("$package")
    done
    ((${#missing[@]})) || return 0
    require_release

    local apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300) su=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            die "these Debian packages are missing, and only root (or sudo) can install them:" \
                "apt-get install --no-install-recommends ${missing[*]}"
        su=(sudo)
    fi
    say "installing the Debian packages that are missing here${su[*]:+ (with sudo)}: ${missing[*]}"
    say "with what they need this is up to 1000 MB on the disk and takes minutes"
    if ((${#su[@]})) && [[ -t 0 && -t 2 ]]; then
        local answer=''
        read -rp 'strahl: install them now? [Y/n] ' answer || answer=n
        [[ ! $answer || $answer == [yY]* ]] ||
            die "nothing was installed; by hand: sudo apt-get install --no-install-recommends ${missing[*]}"
    fi
    mkdir -p "$root/build"
    # A stale package list is no reason to stop: what is missing may still be had.
    logged "$root/build/apt-update.log" "${su[@]}" "${apt[@]}" update || true
    logged "$root/build/apt-install.log" "${su[@]}" "${apt[@]}" install --no-install-recommends "${missing[@]}" ||
        die "could not install them; try it by hand: ${su[*]} apt-get install --no-install-recommends ${missing[*]}"
}

# Removes the build folder of a tree that was copied or moved with it: CMake cannot use it there.
drop_moved_build() {
    local root=$1 cache="$1/build/$2/CMakeCache.txt"
    [[ ! -f $cache ]] || grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" || rm -rf "$root/build/$2"
}

# build_preset ROOT PRESET TARGET [CMAKE-OPTION...]: configures, if needed or if there are options, and builds.
build_preset() {
    local root=$1 preset=$2 target=$3 folder="$1/build/$2"
    shift 3
    mkdir -p "$folder"
    if (($#)) || [[ ! -f $folder/build.ninja ]]; then
        logged "$folder/configure.log" cmake -S "$root" --preset "$preset" "$@"
    fi
    run_build "$folder" "$target" && return
    # If ninja cannot even plan, the sources are not at fault: build.ninja may be cut off, for example.
    cmake --build "$folder" --target "$target" -- -n >/dev/null 2>&1 </dev/null && return 1
    say "the build folder is damaged; configuring it anew"
    rm -f "$folder/build.ninja" "$folder/.ninja_deps" "$folder/.ninja_log"
    local how=(--preset "$preset")
    [[ ! -f $folder/CMakeCache.txt ]] || how=(-B "$folder") # which keeps the options that it was configured with
    logged "$folder/configure.log" cmake -S "$root" "${how[@]}" "$@" || return
    run_build "$folder" "$target"
}

run_build() {
    local folder=$1 target=$2
    if [[ -t 2 ]]; then # a terminal sees the compiler get on
        cmake --build "$folder" --target "$target" >&2 </dev/null
    else
        logged "$folder/build.log" cmake --build "$folder" --target "$target" -- --quiet
    fi
}
