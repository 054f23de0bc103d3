#!/usr/bin/env bash
# Prints the share of each stage of the tracing kernel in the samples of `perf`.
#
#   tests/bench/profile.sh build/release/strahl scenes/article.rt [STRAHL-RENDER-OPTION...]
set -euo pipefail

strahl=$1 scene=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
perf record -q -o "$work/data" "$strahl" render "$scene" -o "$work/picture.bmp" --quiet --threads 1 \
    --size 1920x1080 --samples 1 --error 0 "$@" 2>/dev/null
perf report -i "$work/data" --stdio --no-children -F overhead,symbol 2>/dev/null | awk '
    !/strahl::/ { next }
    /visibility<|occlude/ { stage = "shadow rays" }
    /::intersect|nearest/ { stage = "intersect: nearest hits, sorting them by bin" }
    /shade|scatter|surfaces?_at/ { stage = "shade: light, reflected and refracted rays" }
    /::(append|trace|trace_generation|trace_in_parts|generate_camera_rays)</ {
        stage = "camera rays, copying between queues"
    }
    /Builder|BuiltWorld|WorldArrays|build_hierarchy|share_out|duplicates/ { stage = "build" }
    /quantise|deliver|Renderer|write_picture|copy/ { stage = "write" }
    stage { sum[stage] += $1; all += $1; stage = "" }
    END { for (s in sum) printf "%5.1f %%  %s\n", 100 * sum[s] / all, s }' | sort -rn
