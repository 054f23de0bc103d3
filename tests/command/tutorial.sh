#!/usr/bin/env bash
# The tutorial, followed word by word: its listings are what its scenes have more than the scene of the step before, and
# its commands work in an empty folder.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
rm scene.rt
tutorial=$source_folder/scenes/tutorial
page=$tutorial/README.md

# blocks STEP LANGUAGE: prints the blocks of a step in this language, each with a null character after it.
blocks() {
    awk -v step="## $1." -v begin='```'"$2" '
        /^## / { here = index($0, step) == 1 }
        /^```/ { if (inside && wanted) printf "%c", 0; inside = !inside; wanted = here && $0 == begin; next }
        inside && wanted' "$page"
}

# The commands call these programs: one makes small pictures, and checks a scene in place of opening a window; the other
# stands for ffmpeg.
mkdir tools
cat >tools/strahl <<'SCRIPT'
#!/usr/bin/env bash
arguments=()
while (($#)); do
    case $1 in --size | --samples) shift ;; *) arguments+=("$1") ;; esac
    shift
done
case ${arguments[*]} in
    render*.mp4*) exec "$STRAHL" "${arguments[@]}" --size 16x12 --samples 1 --frames 0-2 ;;
    render*) exec "$STRAHL" "${arguments[@]}" --size 16x12 --samples 1 ;;
    demo.rt* | play*) exec "$STRAHL" check demo.rt ;;
    *) exec "$STRAHL" "${arguments[@]}" ;;
esac
SCRIPT
cat >tools/ffmpeg <<'SCRIPT'
#!/usr/bin/env bash
file=${!#}
exec cat >"${file#file:}"
SCRIPT
chmod +x tools/*
tools=$work/tools
mkdir mine
cd mine || exit 1
cp "$source_folder/scenes/beat.ogg" music.ogg
before=/dev/null
for step in 1 2 3 4 5 6; do
    scene=$(echo "$tutorial/$step"_*.rt)
    while IFS= read -r -d '' listing; do
        [[ $(<"$scene") == *"${listing%$'\n'}"* ]] || fault "step $step lists what is not in $scene: $listing"
    done < <(blocks $step "")
    grep -vxFf "$before" "$scene" | grep -vxFf <(blocks $step "" | tr -d '\0') | grep -vx "// Step $step: .*" |
        grep . && fault "step $step does not list these lines of $scene"
    before=$scene

    cp "$scene" demo.rt
    while IFS= read -r -d '' commands; do
        PATH="$tools:$PATH" STRAHL=$strahl bash -euc "$commands" >log 2>&1 </dev/null ||
            fault "these commands of step $step fail: $commands $(<log)"
    done < <(blocks $step sh)
done
cmp demo.tracks "$tutorial/6_music.tracks" || fault "the commands write other tracks than the tutorial has"
for file in ball.png gates.png still.png demo.mp4 demo/play; do expect_file $file; done
finish
