# Processors, then of a film and of a still: hours until it is done, and processor hours that it costs.
{ m[$1] = $2 }
END {
    frames = 1e5
    pixels = 1e11; side = sqrt(pixels); bands = side / 64
    # Assumed of a farm, not measured:
    launches = 100   # tasks that a scheduler starts in a second
    creations = 5000 # files that a shared file system creates and syncs in a second
    bandwidth = 2e9  # bytes that it takes in a second
    per_pixel = (m["still"] - m["startup"]) / 4096 / 4096
    bytes = m["still_bytes"] / 4096 / 4096 * pixels
    join_rate = m["still_bytes"] / m["join"]
    for (i = 0; i <= 24; ++i) {
        cores = int(2 * 5000 ^ (i / 24) + .5)
        begin = cores / launches + m["startup"]
        film = begin + max(ceil(frames / cores) * (m["frame"] - m["startup"]),
                           max(frames / creations, frames * m["frame_bytes"] / bandwidth))
        parts = min(cores, bands)
        band = per_pixel * pixels / bands * parts / cores  # processors left over trace the same band
        still = begin + max(ceil(bands / parts) * band, bytes / bandwidth)
        joined = bytes / min(join_rate, bandwidth)
        print cores, film / 3600, film * cores / 3600, still / 3600, joined / 3600, (still * cores + joined) / 3600
    }
}
function ceil(x) { return x == int(x) ? x : int(x) + 1 }
function max(a, b) { return a > b ? a : b }
function min(a, b) { return a < b ? a : b }
