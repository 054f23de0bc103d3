#!/usr/bin/env bash
# Ctrl-C: the finished part is saved to a file of its own, and the exit status is 130.
set -uo pipefail
source "$(dirname "$0")/expect.sh"
set -m # a shell without job control starts what it puts into the background with SIGINT ignored

cat >long.rt <<SCENE
$mirrors
flythrough { duration 9  key { time 0  position <0, 0, 0>  look_at <0, 1, 0> }
                         key { time 9  position <0, 1, 0>  look_at <0, 2, 0> } }
SCENE

# stop SIGNAL ARGUMENT...: starts a rendering that takes long, and interrupts it when some of it is done.
stop() {
    local signal=$1 delay pid status
    shift
    for delay in .5 1 2 4 8 16; do
        "$strahl" render long.rt --depth 100 --precision extended --samples 1 --threads 2 "$@" 2>said &
        pid=$!
        sleep "$delay"
        kill -s "$signal" "$pid"
        wait "$pid"
        status=$?
        # It may be too early: nothing is finished, or signals are not yet handled.
        [[ -s said ]] || continue
        ((status == 130)) || fault "exit status $status after SIG$signal; it said: $(<said)"
        grep -q "before anything" said || return
    done
    fault "nothing was finished after $delay seconds"
}

for signal in INT TERM HUP; do
    echo "an older picture" >picture.bmp
    stop "$signal" -o picture.bmp --size 600x450 --stats stats.json
    grep -q "the finished part ([0-9]* %) is in 'picture.part.bmp'" said || fault "it said: $(<said)"
    [[ $(<picture.bmp) == "an older picture" ]] || fault "the older picture is gone"
    expect 0 "600x450" compare picture.part.bmp picture.part.bmp
    grep -q '"finished": false' stats.json || fault "the statistics say: $(<stats.json)"
    rm -f picture.bmp.checkpoint # where a band was finished
    expect_only long.rt scene.rt said picture.bmp picture.part.bmp stats.json
    rm picture.* stats.json
done

# Finished frames stay after an interruption, and --resume continues.
expect 0 "" render long.rt -o film.bmp --frames 0-1 --size 600x450 --depth 1
stop INT -o film.bmp --frames 0-9 --size 600x450 --resume
grep -q "with --resume continues" said || fault "it said: $(<said)"
rm -f film-0002.bmp.checkpoint
expect_only long.rt scene.rt said film-0000.bmp film-0001.bmp film-0002.part.bmp

# Within a pixel too: between mirrors glass doubles the rays at every bounce, and none of these pixels ever ends.
cat >pixel.rt <<SCENE
$mirrors
sphere { <0, 1.5, 0>, .5 material { reflection .5  refraction .9  ior 1.5 } }
sphere { <0, -1.5, 0>, .5 material { reflection .5  refraction .9  ior 1.5 } }
SCENE
# ends_at_once SIGNAL WHERE: the program of number pid ends after one signal.
ends_at_once() {
    local waited
    kill -s "$1" "$pid"
    for ((waited = 0; waited < 100; ++waited)); do
        kill -s 0 "$pid" 2>/dev/null || break
        sleep .1
    done
    if ((waited == 100)); then
        fault "$2 still running 10 s after SIG$1"
        kill -s KILL "$pid"
    fi
    wait "$pid"
    status=$?
    ((status == 130)) || fault "exit status $status after SIG$1 $2; it said: $(<said)"
}
for precision in float double extended; do
    "$strahl" render pixel.rt --depth 256 --size 8x6 --precision "$precision" -o pixel.bmp 2>said &
    pid=$!
    sleep 1
    ends_at_once INT "in $precision"
done

# A pipe that nobody opens, and one that nobody reads.
mkfifo pipe.bmp
for delay in 1 4; do
    "$strahl" render scene.rt -o pipe.bmp --size 32x24 2>said &
    pid=$!
    sleep "$delay"
    ends_at_once TERM "with nobody at the pipe"
done
exec {reader}<>pipe.bmp
"$strahl" render scene.rt -o pipe.bmp --size 640x480 2>said &
pid=$!
sleep 4
ends_at_once INT "with a full pipe"
exec {reader}>&-
finish
