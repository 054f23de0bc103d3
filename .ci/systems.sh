# shellcheck shell=bash
# Functions that scripts of this folder share: they make systems of bare packages, and run commands in them. As root.

# make_system FOLDER SUITE [ARCHITECTURE]: makes one of a Debian or Ubuntu release there, if there is none yet.
make_system() {
    [[ ! -d $1 ]] || return 0
    ((EUID == 0)) || die "only root can make a system of packages and run commands in it"
    say "making a bare system of $2${3:+ for $3} in $1"
    rm -rf "$1.new"
    mkdir -p "$(dirname -- "$1")"
    # Without force-unsafe-io dpkg waits for the disk at each file.
    local options=(--variant=apt --dpkgopt=force-unsafe-io ${3:+"--architectures=$3"}) mirror
    if [[ -e /usr/share/keyrings/debian-archive-$2-stable.gpg ]]; then
        # From the mirror that this machine's apt uses.
        # shellcheck disable=SC2016  # the words with $ are for apt
        mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' | sed -n 1p)
        options+=("$2" "$1.new" ${mirror:+"$mirror"})
    else
        # mmdebstrap knows Ubuntu's mirrors. Debian has not its keys, and these systems only try packages.
        options+=(--components=main,universe --aptopt='Acquire::AllowInsecureRepositories "true"'
            --aptopt='APT::Get::AllowUnauthenticated "true"' "$2" "$1.new")
    fi
    logged "$1.log" mmdebstrap "${options[@]}"
    mv -- "$1.new" "$1"
}

# inside SYSTEM WORK COMMAND...: runs a command in a system, in its folder /strahl, which is the folder WORK meanwhile if
# one is given. Then what the command changes in the system is lost. The mounts belong to the command, and end with it.
inside() {
    # shellcheck disable=SC2016  # the words with $ are for the inner shell
    unshare --mount --pid --fork --kill-child bash -euc '
        system=$1 work=$2
        if [[ $work ]]; then
            changes=$(mktemp -d)
            mount -t tmpfs tmpfs "$changes"
            mkdir "$changes"/{upper,work,system}
            mount -t overlay overlay -o "lowerdir=$system,upperdir=$changes/upper,workdir=$changes/work" "$changes/system"
            system=$changes/system
            mkdir -p "$system/strahl"
            mount --bind "$work" "$system/strahl"
        fi
        mount -t proc proc "$system/proc"
        mount --rbind /dev "$system/dev"
        exec chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
            bash -euc "cd /strahl; exec \"\$@\"" bash "${@:3}"
    ' bash "$@"
}

# Installs a compiler for arm64 and fetches the libraries that the build needs into build/arm64-root, for the preset arm64.
# arm64's libopenimageio-dev cannot be installed beside the machine's own: it needs packages that exclude each other.
prepare_arm64() { # ROOT
    install_packages "$1" g++ cmake ninja-build pkg-config g++-aarch64-linux-gnu qemu-user-static \
        mmdebstrap arch-test dpkg-dev
    local libraries=$1/build/arm64-root
    [[ ! -d $libraries/DEBIAN ]] || return 0
    say "fetching arm64 libraries, about 250 MB"
    rm -rf "$libraries" "$libraries.new"
    mkdir -p "$1/build"
    # Unpacked only. From the folder DEBIAN dpkg-shlibdeps will know which package has a library.
    # shellcheck disable=SC2016  # the words with $ are for mmdebstrap's shell
    logged "$libraries.log" mmdebstrap --variant=extract --architectures=arm64 \
        --include="$(IFS=, && echo "libc6-dev,libstdc++-12-dev,doctest-dev,${build_packages[*]:4}")" \
        --extract-hook='mkdir "$1/DEBIAN" && cd "$1/var/cache/apt/archives" && for deb in *.deb; do
            for list in symbols shlibs; do dpkg-deb -I "$deb" $list >>"$1/DEBIAN/$list" 2>/dev/null || true; done; done' \
        bookworm "$libraries.new"
    # Links that installing would have made, and one that holds in a system of its own only.
    ln -s blas/libblas.so.3 lapack/liblapack.so.3 "$libraries.new/usr/lib/aarch64-linux-gnu/"
    ln -sfr "$libraries.new"/lib/aarch64-linux-gnu/libz.so.1 "$libraries.new/usr/lib/aarch64-linux-gnu/libz.so"
    mv -- "$libraries.new" "$libraries"
}

# Runs a command where programs for arm64 run by qemu-user: in a namespace of users of its own, which has handlers of
# programs of its own, too (Linux 6.7).
with_arm64() {
    # shellcheck disable=SC2016  # the words with $ are for the inner shells
    unshare --user --mount bash -euc '
        until [[ $(id -u) == 0 && $(id -g) == 0 ]]; do sleep .01; done
        exec bash -euc "$@" # which as root has the rights of root
    ' bash '
        mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
        # The first 20 bytes of programs, and which of their bits count: ELF, 64 bits, little-endian, for arm64.
        head="\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00"
        bits="\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff"
        echo -n ":qemu-aarch64:M::$head:$bits:/usr/bin/qemu-aarch64-static:F" >/proc/sys/fs/binfmt_misc/register
        "$@" # which may be an exported function
    ' bash "$@" &
    local id=$! map
    # Its users are those outside. The files can be written once the namespace is there.
    for map in uid_map gid_map; do
        until echo 0 0 65536 2>/dev/null >"/proc/$id/$map"; do
            kill -0 "$id" 2>/dev/null || break 2
            sleep .01
        done
    done
    wait "$id"
}
