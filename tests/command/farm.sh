#!/usr/bin/env bash
# Films and stills in parts by engines that others wrote, with tasks that are killed at random: GNU parallel, Open Job
# Description where it is installed (openjd-cli of PyPI), and Slurm (slurm-wlm of Debian) if STRAHL_SLURM is set, since it
# starts a cluster's daemons as root.
set -uo pipefail
source "$(dirname "$0")/expect.sh"

film=(-o 'film-%04d.png' --frames 0-199 --size 16x12 --samples 1)
still=(-o still.png --size 12x4096 --samples 1)
mkdir one
"$strahl" render scene.rt "${film[@]/#film-/one/film-}" || fault "no film"
"$strahl" render scene.rt "${still[@]/#still/one/still}" || fault "no still"

# Replaces strahl: `deaths` of three runs are killed after up to .15 s.
cat >mortal <<MORTAL
#!/bin/bash
((RANDOM % 3 < deaths)) || exec "$strahl" "\$@"
"$strahl" "\$@" --checkpoint 0 &
sleep "0.\$((RANDOM % 2))\$((RANDOM % 6))"
kill -s KILL \$! 2>/dev/null
wait \$!
MORTAL
chmod +x mortal
export deaths=2

# finished ENGINE: all frames are there, and those of one run; so is the still. Afterwards there is nothing to do.
finished_film() {
    (($(compgen -G 'film-*' | wc -l) == 200)) || fault "$1: there are $(compgen -G 'film-*' | wc -l) files of frames"
    for file in one/film-*; do expect_same "$file" "${file#one/}"; done
    expect 0 '"frames": 0,' render scene.rt "${film[@]}" --resume --stats -
    rm -f film-*
}
finished_still() {
    expect 0 "" join still.png.part-* -o still.png
    (($(compgen -G 'still.png.*' | wc -l) == 64)) || fault "$1: there are $(compgen -G 'still.png.*' | wc -l) parts"
    expect_same still.png one/still.png
    rm -f still.png*
}

command -v parallel >/dev/null || fault "parallel is not installed"
if command -v parallel >/dev/null; then
    seq 16 | parallel --will-cite -j 2 --retries 100 ./mortal render scene.rt "${film[@]}" --part {}/16 --resume --quiet \
        >said 2>&1 || fault "parallel: $(tail -n 3 said)"
    finished_film parallel
    seq 64 | parallel --will-cite -j 2 --retries 100 ./mortal render scene.rt "${still[@]}" --part {}/64 --resume --quiet \
        >said 2>&1 || fault "parallel: $(tail -n 3 said)"
    finished_still parallel
    echo "parallel: done"
fi

# The others try less often.
export deaths=1
[[ ${STRAHL_SLURM-} ]] || left_out "no farm of Slurm: STRAHL_SLURM is not set"
command -v openjd >/dev/null || left_out "no farm of Open Job Description: openjd is not installed"
if [[ ${STRAHL_SLURM-} ]]; then
    source "$(dirname "$0")/slurm.sh"
fi

# openjd ends with the first task that fails, and is run again.
if command -v openjd >/dev/null; then
    # by_openjd TEMPLATE ARGUMENT...: runs a template, with the parameters that all of them need.
    by_openjd() {
        for ((try = 0; try < 100; ++try)); do
            openjd run "$source_folder/assets/farm/$1.openjd.yaml" -p Strahl="$PWD/mortal" -p Scene="$PWD/scene.rt" "${@:2}" \
                >said 2>&1 && return
        done
        fault "openjd: $(tail -n 3 said)"
    }
    by_openjd film --step Render -p Output="$PWD/film-%04d.png" -p Frames=0-199 -p Size=16x12 -p Parts=4
    # These have as many samples as they need.
    rm -f one/*
    film=(-o 'film-%04d.png' --frames 0-199 --size 16x12)
    "$strahl" render scene.rt "${film[@]/#film-/one/film-}" || fault "no film"
    "$strahl" render scene.rt -o one/still.png --size 12x2048 || fault "no still"
    finished_film openjd
    by_openjd still --step Join --run-dependencies -p Output="$PWD/still.png" -p Size=12x2048 -p Parts=8
    expect_same still.png one/still.png
    rm -f still.png*
    echo "openjd: done"
fi
finish
