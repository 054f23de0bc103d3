# shellcheck shell=bash
# Shared by the scripts of the benchmarks: help, building, and reading what programs report.
# shellcheck disable=SC2034  # the variables are for those scripts

here=$(dirname -- "$(readlink -f -- "$0")")
root=$(dirname -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")")
# shellcheck source=.ci/setup.sh
source "$root/.ci/setup.sh"

# For scripts without options: if there are arguments, prints the text on standard input and ends the script.
usage() {
    (($#)) || return 0
    cat
    [[ $1 == -h || $1 == --help ]] && exit
    exit 2
}

# begin NAME TARGET PACKAGE...: installs and builds, or takes the programs in the folder STRAHL_BUILD, and enters the
# empty folder build/NAME. Sets build, strahl, tools (the folder of the benchmarks' programs) and work.
begin() {
    build=${STRAHL_BUILD:+$(readlink -e -- "$STRAHL_BUILD")} || die "no folder '$STRAHL_BUILD' (STRAHL_BUILD)"
    if [[ ! $build ]]; then
        install_packages "$root" "${build_packages[@]}" "${@:3}"
        mkdir -p "$root/build"
        local lock
        exec {lock}>"$root/build/lock"
        flock "$lock"
        say "building"
        drop_moved_build "$root" release
        build_preset "$root" release "$2" -DSTRAHL_BENCH=ON
        exec {lock}>&-
        build=$root/build/release
    fi
    strahl=$build/strahl tools=$build/bench work=$root/build/$1
    rm -rf -- "$work"
    mkdir -p "$work"
    cd "$work" || exit
}

# Runs a command with its output in the file `log`.
quietly() { "$@" >log 2>&1 </dev/null || die "this failed: $*: $(tail -n 5 log)"; }

number() { sed -nE "s/$1/\\1/p" "$2" | tail -n 1; } # number PATTERN FILE
# Seconds of one of Strahl's stages (parse, build, trace), from the file that --stats wrote.
stage_seconds() { number ".*\"$1_seconds\": ([0-9.e+-]+).*" "$2"; } # STAGE FILE
# Seconds that POV-Ray or Tachyon reports in `log` after these words.
reported_seconds() { tr '\r' '\n' <log | sed -nE "s/.*$1.*[ (]([0-9.]+) +seconds.*/\1/p" | tail -n 1; }

median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
# medians KEYS: of tab-separated lines whose first KEYS columns are the same, the medians of each other column.
medians() {
    awk -F'\t' -v OFS='\t' -v keys="$1" '
        { key = $1; for (c = 2; c <= keys; ++c) key = key FS $c
          if (!(key in n)) order[++count] = key
          ++n[key]; columns = NF; for (c = keys + 1; c <= NF; ++c) value[key, c, n[key]] = $c }
        function median(key, c,  i, k, v, m, t) {
            if (value[key, c, 1] == "") return ""
            m = n[key]
            for (i = 1; i <= m; ++i) v[i] = value[key, c, i] + 0
            for (i = 1; i <= m; ++i) for (k = i + 1; k <= m; ++k) if (v[k] < v[i]) { t = v[i]; v[i] = v[k]; v[k] = t }
            return v[int((m + 1) / 2)] }
        END { for (i = 1; i <= count; ++i) {
                  line = order[i]
                  for (c = keys + 1; c <= columns; ++c) line = line OFS median(order[i], c)
                  print line } }'
}
