#!/usr/bin/env bash
# The installed program works on its own, in any folder.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

cmake --install "$build_folder" --prefix "$work/a prefix" >log || fault "cmake --install: $(<log)"
mv "a prefix" moved
strahl=$work/moved/bin/strahl
expect 0 "strahl " --version
expect 0 "" render scene.rt -o x.png --size 8x6
expect_file x.png
expect_file moved/share/doc/strahl/LICENSE
# It comes with the licences of the libraries that are compiled into it.
for package in libcli11-dev libglm-dev libimgui-dev nlohmann-json3-dev; do
    [[ ! -e /usr/share/doc/$package/copyright ]] || expect_file "moved/share/doc/strahl/libraries/$package"
done
# Pages and help name nothing that is not installed.
for page in moved/share/doc/strahl/*.md; do
    ! grep -nE '(^|[ `/])(src|tests|povref|assets)/|(^|[ `])\./strahl' "$page" >dead ||
        fault "$page names what is not installed: $(<dead)"
    while read -r link; do
        [[ -e ${page%/*}/$link ]] || fault "$page points to $link, which is not installed"
    done < <(grep -oP '\]\(\K[^#h)][^)#]*' "$page")
    while read -r scene; do
        [[ -e ${page%/*}/$scene ]] || fault "$page names $scene, which is not installed"
    done < <(grep -oE '[./a-z]*scenes/[a-z_/]*\.rt' "$page")
done
expect_file moved/share/doc/strahl/language.md
for command in '' render view play join check compare bundle import pov crosscheck stability lsp; do
    # shellcheck disable=SC2086  # without a command there is no word
    ! "$strahl" $command --help | grep -nE '(src|tests|povref|assets|scenes)/' ||
        fault "strahl $command --help names what is not installed"
done
for scene in moved/share/strahl/scenes/*.rt; do expect 0 "no errors" check "$scene"; done

# Libraries beside its module come before the system's, also for those that need each other.
for library in libvorbisfile.so.3 libvorbis.so.0; do
    system=$(ldd "$strahl" | sed -n "s/.*$library => \(.*\) (.*/\1/p")
    [[ $system ]] || continue # it was built without sound
    cp "$system" moved/lib/strahl
    [[ $(ldd "$strahl") == *"$library => $work/moved/"* ]] || fault "it does not find its own $library"
    rm "moved/lib/strahl/$library"
done

# A desktop's menu starts it without a scene: the gallery has templates to begin from.
expect_file moved/share/strahl/scenes/templates/empty_floor.rt

# Files for other programs are installed.
share=moved/share
for file in applications/strahl.desktop mime/packages/strahl.xml icons/hicolor/scalable/apps/strahl.svg \
    metainfo/strahl.metainfo.xml vim/vimfiles/ftdetect/strahl.vim; do expect_file "$share/$file"; done
gzip -dc $share/man/man1/strahl.1.gz >page
grep -qF 'Rays in each pixel' page || fault "the manual page does not tell of --samples"
for section in FILES ENVIRONMENT 'EXIT STATUS'; do
    grep -q "^\.SH $section" page || fault "the manual page has no section $section"
done
# Lines that are not filled fit 80 columns, of which 7 are the margin.
sed -n '/^\.nf/,/^\.fi/p' page | sed 's/\\[&efBRI]*//g' | grep -E '.{74}' && fault "these lines of the manual page are too long"
grep -q 'syn keyword strahlBlock .*torus' $share/vim/vimfiles/syntax/strahl.vim || fault "vim does not know a torus"
grep -q '#compdef strahl' $share/zsh/vendor-completions/_strahl || fault "zsh has no completion"
grep -q 'strahl.*-l precision -x -a .float double extended' $share/fish/vendor_completions.d/strahl.fish ||
    fault "fish does not complete --precision"
completed() { # WORD...: what bash offers for the last one
    bash -c 'source "$0" && COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) && _strahl && echo "${COMPREPLY[*]}"' \
        $share/bash-completion/completions/strahl "$@"
}
[[ $(completed strahl cro) == crosscheck ]] || fault "bash completes 'cro' as '$(completed strahl cro)'"
[[ $(completed strahl render --prec) == --precision ]] || fault "bash does not complete --prec"
[[ $(completed strahl render --precision d) == double ]] || fault "bash does not complete the values of --precision"
[[ $(completed strahl render --precision = d) == double ]] || fault "bash does not complete --precision=d"
[[ $(completed strahl render --bits 1) == 16 ]] || fault "bash does not complete the values of --bits"
[[ $(completed strahl --reference fi) == fish ]] || fault "bash does not complete the kinds of --reference"
# Files by their ending, and folders.
mkdir files files/folder
touch files/a.rt files/b.nff files/c.png files/d.txt
files_for() { completed "${@:2}" files/ | tr ' ' '\n' | sort | sed 's|.*/||' | xargs | grep -qxF "$1" || fault "for ${*:2} bash offers: $(completed "${@:2}" files/)"; }
files_for "a.rt folder" strahl
files_for "a.rt folder" strahl check
files_for "b.nff folder" strahl import
files_for "c.png folder" strahl render a.rt -o
files_for "folder" strahl view --still-folder
files_for "a.rt b.nff c.png d.txt folder" strahl render a.rt --stats
rm -r files
expect 2 "not in {man,bash" --reference nonsense
command -v dpkg-shlibdeps >/dev/null || fault "dpkg-dev is not installed"
if command -v dpkg-shlibdeps >/dev/null; then
    (cd "$build_folder" && cpack -G DEB -B "$work/package") >log 2>&1 || fault "cpack: $(tail -5 log)"
    dpkg-deb -c package/*.deb >contents
    grep -q ' ./usr/bin/strahl$' contents || fault "the package lacks the program: $(head -5 contents)"
    [[ $(dpkg-deb -f package/*.deb Depends) == *libglfw3* ]] || fault "the package does not depend on GLFW"
    [[ $(dpkg-deb -f package/*.deb Depends) != *openimageio* && $(dpkg-deb -f package/*.deb Recommends) == *openimageio* ]] ||
        fault "the package depends on $(dpkg-deb -f package/*.deb Depends), not only recommends OpenImageIO"
    [[ $(dpkg-deb -f package/*.deb Recommends) == *povray-includes* ]] ||
        fault "the package does not recommend POV-Ray's include files"
    [[ $(dpkg-deb -f package/*.deb Suggests) == "povray, ffmpeg, zenity" ]] ||
        fault "the package suggests $(dpkg-deb -f package/*.deb Suggests)"
    [[ $(dpkg-deb -f package/*.deb Recommends) != *libc6* ]] || fault "the package recommends what it depends on"
    rm -rf package
fi

# If HOME cannot be written, ccache has no place for its cache; the build works without it.
unwritable=(env -u CCACHE_DIR -u XDG_CACHE_HOME HOME=/dev/null/none)
object=CMakeFiles/strahl_picture_module.dir/src/image/oiio/oiio_module.cpp.o
command -v ccache >/dev/null || left_out "ccache without a place for its cache: it is not installed"
if command -v ccache >/dev/null; then
    "${unwritable[@]}" cmake -S "$source_folder" -B homeless -G Ninja -DCMAKE_BUILD_TYPE=Debug -DSTRAHL_TESTS=OFF \
        -DSTRAHL_WINDOW=OFF >log 2>&1 || fault "configuring without a HOME: $(tail -5 log)"
    "${unwritable[@]}" cmake --build homeless --target "$object" >log 2>&1 || fault "building without a HOME: $(tail -5 log)"
    rm -rf homeless
fi

# Without the part that reads .exr files, or with a broken one, all else works, and what reads them says so.
expect 0 "" render scene.rt -o x.exr --size 8x6
for module in missing broken; do
    rm -f moved/lib/strahl/libstrahl_image.so
    [[ $module == missing ]] || echo "no library" >moved/lib/strahl/libstrahl_image.so
    expect 0 "" render scene.rt -o y.png --size 8x6
    expect 0 "maximum difference: 0" compare x.png y.png
    expect 1 "libstrahl_image.so" compare x.exr x.exr
    [[ $module == missing ]] || expect 1 "it needs OpenImageIO in the version that" compare x.exr x.exr
done
finish
