#!/usr/bin/env bash
# The window's figures on this machine: medians of several runs, on a display of its own.
#
#   tests/window/figures.sh STRAHL [WxH]
#
# Run it where nothing else runs; as root it gives the program a higher priority.
set -uo pipefail
source "$(dirname -- "$0")/window.sh"
size=${2-960x720} runs=5
own_display 1280x1024 "" "$@"
scenes=$here/../../scenes
higher=()
nice -n -5 true 2>/dev/null && higher=(nice -n -5)

median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
# number PATTERN: prints what \1 is in each line of the log that matches.
number() { sed -nE "s|^.*$1.*$|\\1|p" "$work/log"; }
# await TEXT COUNT: waits until that many lines contain it.
await() {
    for ((i = 0; i < 600; ++i)); do
        (($(grep -c "$1" "$work/log") >= $2)) && return
        sleep 0.05
    done
    echo "no '$1' in:" && cat "$work/log" && exit 1
}
start() {
    : >"$work/log"
    "${higher[@]}" "$strahl" "$@" --size "$size" --verbose >"$work/log" 2>&1 &
    pid=$!
    await 'first picture' 1
    xdotool mousemove --window "$(xdotool search --pid "$pid" | tail -n 1)" 100 100
}
quit() { xdotool key ctrl+q && wait "$pid" && pid=; }
# ticks PATTERN: prints the hundredths of a second that threads with matching names have used.
ticks() { cat /proc/"$pid"/task/*/stat | awk -v name="$1" '$2 ~ name { sum += $14 + $15 } END { print sum + 0 }'; }
main_ticks() { awk '{ print $14 + $15 }' "/proc/$pid/task/$pid/stat"; }

echo "load $(cut -d' ' -f1 /proc/loadavg), $(nproc) processors, window $size"
for scene in article flythrough; do
    file=$scenes/$scene.rt
    echo "-- $scene.rt"
    for ((run = 0; run < runs; ++run)); do
        start "$file"
        number 'first picture after ([0-9.]+) s' >>"$work/first"
        await finished 1
        quit
    done
    echo "start to first picture: $(median <"$work/first") s"
    rm "$work/first"

    start "$file"
    await finished 1
    for ((run = 1; run <= 4 * runs; ++run)); do
        xdotool key w
        await finished $((2 * run))
        xdotool key r
        await finished $((2 * run + 1))
    done
    echo "key pressed to changed picture: $(number '[1-9][0-9]* pictures .*first after ([0-9.]+) ms' | median) ms"
    # Every second one is of the scene's camera.
    echo "all passes together: $(number 'traced in ([0-9.]+) s' | awk 'NR % 2' | median) s"
    before=$(ticks .)
    sleep 10
    echo "processor time in 10 idle seconds: $(($(ticks .) - before)) hundredths of a second"
    quit

    for ((run = 0; run < runs; ++run)); do
        "${higher[@]}" "$strahl" render "$file" --size "$size" --precision float --samples 1 --quiet -o "$work/p.bmp" \
            --stats "$work/stats.json"
        sed -nE 's/.*"trace_seconds": *([0-9.e-]+).*/\1/p' "$work/stats.json" >>"$work/whole"
    done
    echo "one full frame: $(median <"$work/whole") s"
    rm "$work/whole"

    start "$file" --fly
    for ((run = 0; run < runs; ++run)); do
        all=$(ticks .) drawing=$(ticks llvmpipe) main=$(main_ticks)
        sleep 6
        echo $((1000 * ($(ticks llvmpipe) - drawing) / ($(ticks .) - all))) >>"$work/share"
        echo $((1000 * ($(main_ticks) - main) / ($(ticks .) - all))) >>"$work/main"
    done
    xdotool key space
    await 'rest after' 1
    echo "flying: $(number 'rest after (.*)')"
    echo "processor time: llvmpipe $(median <"$work/share") of 1000, main thread $(median <"$work/main") of 1000"
    rm "$work/share" "$work/main"
    quit
done
