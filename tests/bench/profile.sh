#!/usr/bin/env bash
# Where the time goes: share of the samples of `perf` by stage of the kernel.
#
#   tests/bench/profile.sh build/release/strahl scenes/article.rt [STRAHL-RENDER-OPTION...]
set -euo pipefail

strahl=$1 scene=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
perf record -q -o "$work/data" "$strahl" render "$scene" -o "$work/picture.bmp" --quiet --threads 1 \
    --size 1920x1080 --error 0 "$@" 2>/dev/null
perf report -i "$work/data" --stdio --no-children -F overhead,symbol 2>/dev/null | awk '
    !/strahl::/ { next }
    /visibility<|pass_below</ { stage = "blocked (shadow rays against bodies)" }
    /::(find|nearest_below)</ { stage = "find (nearest bodies, sorting by body)" }
    /shade</ { stage = "shade and spawn (light, new rays)" }
    /::(step|append|aim|trace)</ { stage = "aim, append" }
    /Builder|BuiltWorld|build_hierarchy|share_out|doubles/ { stage = "build" }
    /quantise|deliver|Renderer|write_picture|copy/ { stage = "write" }
    stage { sum[stage] += $1; all += $1; stage = "" }
    END { for (s in sum) printf "%5.1f %%  %s\n", 100 * sum[s] / all, s }' | sort -rn
