#include "main/render/renderer.h"

#include <atomic>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "files/utf8.h"
#include "image/transfer.h"
#include "main/process/progress.h"
#include "num/decimal.h"
#include "scene/camera.h"
#include "trace/cells/cell_picture.h"
#include "trace/measure/prove_again.h"
#include "trace/shutter.h"

namespace strahl {

namespace {

std::uint64_t pixels(const Lattice& region) { return std::uint64_t(region.columns) * std::uint64_t(region.rows); }
std::uint64_t pixels(const std::vector<Lattice>& regions) {
    std::uint64_t sum = 0;
    for (const Lattice& region : regions) sum += pixels(region);
    return sum;
}

/// Divides the light of pixels with alpha by that, unless it is 0.
std::vector<float> straight(std::span<const float> pixels) {
    std::vector<float> all(pixels.begin(), pixels.end());
    for (std::size_t i = 0; i < all.size(); i += 4)
        for (std::size_t c = 0; c < 3 && all[i + 3] > 0; ++c) all[i + c] /= all[i + 3];
    return all;
}

/// Returns whether the path is a regular file, or free for one: not standard output, a pipe or a device.
bool is_file(const std::string& path) {
    std::error_code error;
    return path != "-" && (!std::filesystem::exists(path, error) || std::filesystem::is_regular_file(path, error));
}

}  // namespace

Renderer::Renderer(const RenderOptions& o, Scene scene, std::string own_scene_hash, const Shot& first,
                   const Lattice& own_part, FileFormat own_format, NamedLayers own_layers, Stats& sums)
    : options(o),
      scene_hash(std::move(own_scene_hash)),
      format(own_format),
      named(std::move(own_layers)),
      part(own_part),
      stats(sums),
      pool(o.threads),
      accuracy(choose(scene, first)),
      tracer(std::move(scene), accuracy.precision, o.simd) {
    if (!options.prove.empty()) proof.emplace(part, format);
    stats.accuracy = accuracy;
    stats.threads = pool.size();
    stats.simd = tracer.simd();
    stats.lanes = lanes(tracer.precision(), tracer.simd());
    stats.build_seconds = watch.lap();
}

bool Renderer::render(const Shot& shot, const Destination& destination, const std::string& label,
                      std::optional<Share> shared) {
    const auto& [path, ending, stream] = destination;
    const Share share = shared.value_or(Share{});
    const std::string file = shared ? part_path(path, share) : path;
    const auto count = static_cast<int>(named.channels.names.size());
    PictureWriter writer(part.columns, part.rows, count, ending, format, named.channels);
    const auto own_header = [&] { return header(shot, writer, ending, share); };
    Checkpoint checkpoint(writer, !stream && is_file(path) ? checkpoint_of(file) : "", own_header, options.checkpoint);
    const std::uint64_t all = pixels(missing(writer, share));
    if (options.resume && shared && BandFile::is_at(file)) {
        const auto finished = std::make_shared<BandFile>(file);
        require_same(*finished, own_header());
        writer.take(finished);
        if (missing(writer, share).empty()) return true;
    }
    if (options.resume) checkpoint.resume();
    const std::vector<Lattice> regions = missing(writer, share);

    watch.lap();
    tracer.prepare(view(shot, accuracy.depth, accuracy.dropped), pool);
    stats.build_seconds += watch.lap();
    const std::uint64_t done = trace(shot, regions, all, writer, checkpoint, label);
    if (proof) prove_again(shot, writer, label);
    stats.trace_seconds += watch.lap();
    const bool whole = done == all;
    if (stream) {
        if (whole) writer.write(stream);
    } else if (!whole) {
        const std::string percent = done > 0 ? std::to_string(100 * done / all) + " %" : "";
        tell_interrupted(percent, path, shared.has_value(), writer, checkpoint);
    } else if (shared) {
        checkpoint.become(file);
    } else {
        writer.write(path);
        if (proof) proof->write(options.prove);
        if (is_file(path)) remove_checkpoint(file);
    }
    if (proof && !options.stats.empty()) stats.proved = proof->counts();
    stats.write_seconds += watch.lap();
    stats.frames += whole;
    return whole;
}

/// Saves and reports what is finished. `done` is its share in words, or empty if nothing is finished.
void Renderer::tell_interrupted(const std::string& done, const std::string& path, bool shared, PictureWriter& writer,
                                Checkpoint& checkpoint) {
    const bool kept = checkpoint.save();
    const auto in_quotes = [](const std::string& name) { return std::string("'").append(printable(name)).append("'"); };
    std::string said = "interrupted";
    if (done.empty() || (shared && !kept)) {
        said += " before anything of " + in_quotes(path) + " was finished";
    } else if (shared) {
        said += "; " + done + " of the part are finished";
    } else {
        const std::string file = path == "-" ? path : before_ending(path, ".part");
        writer.write(file);
        said += "; the finished part (" + done + ") is in " + (file == "-" ? "standard output" : in_quotes(file));
    }
    if (kept || options.frames) said += "; the same command with --resume continues from there";
    std::cerr << "strahl: " << said << '\n';
}

/// Returns all that the picture depends on, so that no other one is continued. The first line names all options: none
/// can be added without a choice whether it belongs here. Instead of some stands what was made of them: the hash of the
/// scene, accuracy and sampling. SIMD levels that give the same picture are one.
BandHeader Renderer::header(const Shot& shot, const PictureWriter& writer, const std::string& ending,
                            Share share) const {
    const auto& [file, opening, output, for_stdout, bits, compression, exposure, layers, alpha_of_scene, crop, fit,
                 depth, precision, error, sampling, simd, threads, time, frames, rate, shared, resumes, interval, map,
                 report, quiet] = options;
    std::string words = "size " + size_text(opening.size.width, opening.size.height);
    const auto add = [&](const char* key, double value) {
        (words += " ").append(key).append(" ").append(text_of(value));
    };
    for (const int value : {part.x, part.y, part.columns, part.rows}) add("crop", value);
    add("time", shot.time), add("fit", fit), add("depth", accuracy.depth), add("dropped", accuracy.dropped);
    add("grid", stats.sampling.grid), add("centre", stats.sampling.centre), add("error", stats.sampling.error);
    if (exposure) add("exposure", *exposure);
    for (const LayerKind& kind : layer_kinds)
        if (layers.*kind.wanted) words.append(" layer ").append(kind.name);
    if (layers.alpha) add("background", named.layers.background);
    words.append(" precision ").append(name(accuracy.precision)).append(tracer.simd() == Simd::v2 ? " unfused" : "");
    return {hash_of_program(),
            scene_hash + " " + hash_of_meshes(scene()),
            words,
            ending_of(ending),
            writer.layout(),
            format.compression,
            share.part,
            share.parts};
}

/// Returns the unfinished bands of the share, joined to regions of consecutive bands, each small enough for a list of
/// its tiles.
std::vector<Lattice> Renderer::missing(const PictureWriter& writer, Share share) const {
    constexpr std::uint64_t most_pixels = std::uint64_t(1) << 30;
    std::vector<Lattice> regions;
    for (int i = 0; i < writer.count(); ++i) {
        if (writer.finished(i) || i % share.parts != share.part - 1) continue;
        const auto [first, last] = writer.rows(i);
        const Lattice band{part.x, part.y + first, part.columns, last - first};
        Lattice* const before = regions.empty() ? nullptr : &regions.back();
        if (!before || pixels(*before) + pixels(band) > most_pixels) {
            regions.push_back(band);
        } else if (before->y + before->rows == band.y) {
            before->rows += band.rows;
        } else if (band.y + band.rows == before->y) {  // bottom-up
            before->y = band.y, before->rows += band.rows;
        } else {
            regions.push_back(band);
        }
    }
    return regions;
}

/// Chooses depth, precision and pruning. Without --error only light that the file cannot show is pruned, and depth and
/// precision are the defaults.
Accuracy Renderer::choose(const Scene& scene, const Shot& shot) {
    const double unseen = half_step(format);
    // The curve that encodes light enlarges errors where it is steep.
    const double steepest = format.bits != 32 ? strahl::steepest(format.gamma) : 1;
    if (!options.prove.empty()) {  // pruned light is part of the bounds
        constexpr double share = 1e-2;
        stats.error = options.error.value_or(share * unseen * steepest);
        return {.precision = Precision::float64,
                .depth = options.depth.value_or(scene.settings.max_trace_level),
                .dropped = stats.error / steepest};
    }
    if (!options.error) {
        stats.error = unseen * steepest;
        return {.precision = options.precision.value_or(Precision::float64),
                .depth = options.depth.value_or(scene.settings.max_trace_level),
                .dropped = unseen};
    }
    stats.error = *options.error;
    return choose_accuracy(scene, view(shot, 1, 0), *options.error / steepest / gain_of(format.exposure),
                           options.precision, options.depth, pool, options.simd);
}

View Renderer::view(const Shot& shot, int depth, double dropped) const {
    const double aspect = double(options.opening.size.width) / options.opening.size.height;
    return {.camera = options.fit ? filled_view(shot.camera, aspect) : shot.camera,
            .width = options.opening.size.width,
            .height = options.opening.size.height,
            .depth = depth,
            .error = dropped,
            .time = shot.time,
            .prove = !options.prove.empty(),
            .layers = named.layers};
}

/// Returns the moments of the shutter around a shot, if averages are traced.
std::shared_ptr<const std::vector<Shot>> Renderer::moments(const Shot& shot) const {
    if (stats.sampling.grid == 1 || !options.prove.empty()) return nullptr;
    const bool flies = options.time || options.frames;
    const auto camera = [&](double time) {
        Shot moment{flies ? camera_at(scene(), time) : own_camera_at(scene(), time), time};
        return view(moment, 1, 0).camera;
    };
    return shutter_moments(tracer.declared(), shot.time, shutter_seconds(shot.camera, options.rate.per_second()),
                           camera);
}

/// Traces the regions. Returns the number of finished pixels, of `all` in the picture or the share.
std::uint64_t Renderer::trace(const Shot& shot, const std::vector<Lattice>& regions, std::uint64_t all,
                              PictureWriter& writer, Checkpoint& checkpoint, const std::string& label) {
    ProgressLine progress(options.quiet, label);
    std::atomic<std::uint64_t> done = all - pixels(regions);
    const auto keep = [&](const Tile& tile) {
        const Lattice& own = tile.lattice;
        const auto put = [&](const auto& rgb) {
            writer.put(own.x - part.x, own.y - part.y, own.columns, own.rows, rgb.data());
        };
        if (proof)
            proof->keep(tile, writer);
        else if (tile.layers.empty())
            std::visit(put, tile.rgb);
        else
            put(writer.layout().bits == 32 ? std::vector<float>(tile.layers.begin(), tile.layers.end())
                                           : straight(tile.layers));
        const std::uint64_t size = pixels(own);
        progress.advance(done.fetch_add(size) + size, all);
        if (!interrupted()) checkpoint.save_if_due();
    };
    Job job{view(shot, accuracy.depth, accuracy.dropped), pool, keep, interrupt.flag()};
    job.view.moments = moments(shot);
    for (const Lattice& region : regions) {
        if (interrupted()) break;
        if (stats.sampling.grid > 0) {
            stats.rays += tracer.trace(job, SampledRegion{region, stats.sampling});
        } else {
            CellPicture cells(tracer.scene(), job.view, region, stats.sampling.error);
            if (!options.stats.empty()) cells.check();
            stats.rays += tracer.trace(job, CellPass{cells, 0});
            stats.sampled += cells.sampled();
        }
    }
    return done;
}

/// Traces undecided pixels again: in double, pruning a thousandth of the light, then in extended precision.
void Renderer::prove_again(const Shot& shot, PictureWriter& writer, const std::string& label) {
    const Job closer{view(shot, accuracy.depth, accuracy.dropped / 1000), pool, {}, interrupt.flag()};
    const auto again = [&](Tracer& own, Proof::By by, const std::string& how) {
        const std::vector<Pixel> open = proof->open();
        if (open.empty() || interrupted()) return;
        ProgressLine progress(options.quiet, label + how);
        std::atomic<std::uint64_t> done = 0;
        const auto decides = [&](const Tile& tile) {
            progress.advance(++done, open.size());
            return proof->settle(tile, by, writer);
        };
        stats.rays += strahl::prove_again(own, closer, open, decides);
    };
    if (accuracy.dropped > 0) again(tracer, Proof::By::in_double, "once more ");
    if (!proof->open().empty()) {
        Tracer extended(tracer.scene(), Precision::extended);
        again(extended, Proof::By::in_extended, "in extended precision ");
        if (interrupted())
            std::cerr << "strahl: interrupted; pixels that were not yet traced in extended precision stay undecided\n";
    }
    proof->close(writer);
}

}  // namespace strahl
