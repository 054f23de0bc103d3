#include "show/film_recorder.h"

#include <filesystem>
#include <utility>

#include "files/os/thread.h"
#include "files/utf8.h"
#include "image/encoder.h"
#include "image/picture_writer.h"
#include "num/decimal.h"
#include "num/thread_pool.h"
#include "scene/camera.h"
#include "scene/moving_scene.h"
#include "show/work/stills.h"
#include "text/reading/scene_files.h"
#include "trace/shutter.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

constexpr FrameRate film_rate{};

/// "40 s", or "5 min" for more than two minutes.
std::string short_duration(double seconds) {
    return seconds < 120 ? std::to_string(int(seconds)) + " s" : std::to_string(int(seconds / 60)) + " min";
}

}  // namespace

std::optional<FilmOrder> film_of(const Session& session, const std::string& scene_path, int width, int height) {
    FilmOrder order{.scene = *session.scene, .view = session.view(width, height), .exposure = session.exposure};
    Scene& scene = order.scene;
    if (session.tracks) scene.tracks = *session.tracks;
    scene.flythrough = session.path_to_fly();
    if (!scene.flythrough) return std::nullopt;
    // Leaves the camera where the user has put it if nothing moves it.
    if (scene.flythrough->keys.empty() && scene.camera_follows.empty()) scene.camera = session.camera;
    order.fit = session.fill;
    order.view.tracks = nullptr;
    order.view.width = std::max(order.view.width & ~1, 2), order.view.height = std::max(order.view.height & ~1, 2);
    if (!scene.music.sound.empty()) order.sound = FilmSound{path_beside(scene_path, scene.music.sound), 0};
    return order;
}

void FilmRecorder::toggle(const Session& session, const std::string& scene_path, int width, int height) {
    pace.redraw();
    if (under_way()) return worker.stop();
    const PictureSize size = options.still_size.value_or(PictureSize{width, height});
    auto order = film_of(session, scene_path, size.width, size.height);
    if (!order)
        return notes.note("nothing flies or moves here; " + notes.key(Action::add_key) + " adds keys of a path");
    try {
        const std::string ffmpeg = find_ffmpeg("a film");
        path = order->path = reserve_file(
            (std::filesystem::path(options.still_folder) / still_name(scene_path, std::nullopt)).string(), ".mp4");
    } catch (const FileError& error) {
        any_failed = true;
        return notes.fail(error.what());
    }
    notes.announce("a film of the flight is being made: " + path + "; " + notes.key(Action::film) + " ends it");
    share = 0, began = pace.now();
    worker.add([this, order = *std::move(order)](const std::atomic<bool>& stop) {
        os::lower_priority();
        FilmEnd outcome;
        try {
            outcome = make(order, stop);
        } catch (const FileError& error) {
            outcome.fault = error.what();
        } catch (const std::bad_alloc&) {
            outcome.fault = "not enough memory for a film of this size";
        }
        std::error_code error;  // of a film that was not made there is an empty file
        if (std::filesystem::file_size(order.path, error) == 0) std::filesystem::remove(order.path, error);
        return outcome;
    });
}

FilmRecorder::FilmEnd FilmRecorder::make(const FilmOrder& order, const std::atomic<bool>& stop) {
    View view = order.view;
    const int count = static_cast<int>(film_rate.frames_in(flight_of(order.scene)->duration));
    const double all = double(view.width) * view.height;
    const FileFormat format{.bits = 8, .gamma = order.scene.settings.assumed_gamma, .exposure = order.exposure};
    const SampledRegion picture{{.columns = view.width, .rows = view.height},
                                {.error = Sampling{}.error / gain_of(order.exposure)}};
    Film film(find_ffmpeg("'" + order.path + "'"), order.path, film_rate, order.sound);
    const auto append = [&](std::string_view bytes) { film.append(bytes); };
    append(stream_head(".y4m", {view.width, view.height}, film_rate));
    ThreadPool pool(options.threads);
    Tracer tracer(order.scene, Precision::float64);
    const auto camera_of = [&](double time) {
        const Camera own = camera_at(order.scene, time);
        return order.fit ? filled_view(own, double(view.width) / view.height) : own;
    };
    int frame = 0;
    for (; frame < count; ++frame) {
        view.time = film_rate.moment(frame), view.camera = camera_of(view.time);
        view.moments =
            shutter_moments(order.scene, view.time, shutter_seconds(view.camera, film_rate.per_second()), camera_of);
        PictureWriter writer(view.width, view.height, 3, ".y4m", format);
        std::atomic<int> pixels = 0;
        const auto keep = [&](const Tile& tile) {
            const auto& [x, y, columns, rows, step_x, step_y] = tile.lattice;
            std::visit([&](auto rgb) { writer.put(x, y, columns, rows, rgb.data()); }, tile.rgb);
            const double before = share;
            share = (frame + (pixels += columns * rows) / all) / count;
            if (int(100 * before) != int(100 * share)) worker.notify();
        };
        tracer.trace({view, pool, keep, &stop}, picture);
        if (stop) break;
        writer.write(append);
    }
    if (frame == count) return film.finish(), FilmEnd{"film saved: " + order.path};
    if (frame == 0) return {"the film was ended before its first frame"};
    return {"film ended after " + text_of(film_rate.moment(frame)) + " s: " + film.finish_part()};
}

void FilmRecorder::finish() {
    if (!under_way()) return;
    if (std::exchange(finishing, true)) return worker.stop();
    log_line("waiting for the film; " + notes.key(Action::back) + " or a signal ends it");
    pace.redraw();
}

void FilmRecorder::tell_done() {
    const auto outcome = worker.take();
    if (!outcome) return;
    any_failed |= !outcome->fault.empty();
    outcome->fault.empty() ? notes.announce(outcome->said) : notes.fail(outcome->fault);
    pace.redraw();
}

std::string FilmRecorder::progress_text() const {
    if (!under_way()) return "";
    const double passed = pace.now() - began;
    const std::string left =
        share > .01 && passed > 2 ? ", " + short_duration(passed / share - passed) + " left" : std::string();
    return "A film: " + std::to_string(int(100 * share)) + " %" + left + ", " +
           std::filesystem::path(path).filename().string() + "; " + notes.key(finishing ? Action::back : Action::film) +
           " ends it";
}

}  // namespace strahl
