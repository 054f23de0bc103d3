// strahl sheet: traces the moments with one tracer, and puts their pictures and times into one picture.
#include "main/commands/command_sheet.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

#include "files/error.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "image/frame_rate.h"
#include "image/picture.h"
#include "image/pixels.h"
#include "main/commands/scene_file.h"
#include "main/process/exit_status.h"
#include "main/process/progress.h"
#include "main/render/render_options.h"
#include "num/decimal.h"
#include "num/thread_pool.h"
#include "scene/moving_scene.h"
#include "trace/shutter.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

// Pixels between pictures, in the strip for the time below each, and of its font.
constexpr int gap = 4, strip = 20, font_size = 14;

/// The places of the pictures in the sheet, row by row.
struct SheetLayout {
    PictureSize picture;
    int pictures, columns;
    int rows() const { return (pictures + columns - 1) / columns; }
    PictureSize whole() const {
        return {columns * (picture.width + gap) - gap, rows() * (picture.height + strip + gap) - gap};
    }
};

SheetLayout layout_of(const SheetOptions& options, const Camera& camera) {
    PictureSize size = options.size.value_or(PictureSize{320, 0});
    const double height = size.width / camera.aspectratio.value_or(4. / 3);
    if (size.height == 0) size.height = static_cast<int>(std::lround(std::clamp(height, 1., 960.)));
    const int square = static_cast<int>(std::ceil(std::sqrt(options.pictures)));
    const int columns = std::min(options.columns ? options.columns : square, options.pictures);
    const SheetLayout layout{size, options.pictures, columns};
    const double pixels = double(layout.columns) * (size.width + gap) * layout.rows() * (size.height + strip + gap);
    if (3 * pixels > double(most_values_read))
        throw UsageError(std::to_string(options.pictures) + " pictures of " + size_text(size.width, size.height) +
                         " pixels are too many for a sheet; choose fewer --pictures or a smaller --size");
    return layout;
}

/// Puts a picture of one or three channels into the sheet, as far as it fits into `room` from (x, y) on.
void put(const Picture& picture, Picture& sheet, int x, int y, PictureSize room) {
    for (int row = 0; row < std::min(picture.height, room.height); ++row)
        for (int column = 0; column < std::min(picture.width, room.width); ++column)
            for (int c = 0; c < 3; ++c)
                sheet.values[3 * (std::size_t(y + row) * sheet.width + x + column) + c] =
                    picture.values[picture.channels * (std::size_t(row) * picture.width + column) +
                                   (picture.channels == 3 ? c : 0)];
}

/// Returns equally distant moments of a flight. The last one is its end, unless it begins again there.
std::vector<double> moments_of(const Flythrough& flight, int count) {
    std::vector<double> moments;
    const int parts = flight.loop ? count : std::max(count - 1, 1);
    for (int i = 0; i < count; ++i) moments.push_back(std::round(1000 * flight.duration * i / parts) / 1000);
    return moments;
}

}  // namespace

int sheet_command(const SheetOptions& options, const std::atomic<bool>* stop) try {
    if (options.output.empty()) throw UsageError("no output file. Add -o FILE, which ends in .bmp, .png or .exr");
    if (const std::string fault = format_fault(options.output, 0); !fault.empty()) throw UsageError(fault);
    refuse_overwriting_scene("-o", options.output, options.scene, options.opening);
    require_writable(options.output);
    const std::string text = read_scene_text(options.scene);
    OpeningOptions opening = options.opening;
    opening.stop = stop, opening.size = options.size.value_or(PictureSize{320, 240});
    OpenedScene opened = open_scene(text, options.scene, opening, read_pixels);
    tell_notes(opened, false);
    const std::vector<double> moments =
        moments_of(flight_for("strahl sheet", opened.scene, options.scene), options.pictures);
    const SheetLayout layout = layout_of(options, opened.scene.camera);
    const auto [width, height] = layout.picture;
    const PictureSize whole = layout.whole();

    FileFormat format{.gamma = opened.scene.settings.assumed_gamma, .exposure = options.exposure};
    format.bits = bits_of(ending_of(options.output), 0);
    const Sampling sampling{.error = Sampling{}.error / gain_of(options.exposure)};
    Picture sheet{whole.width, whole.height, 3, std::vector<double>(std::size_t(3) * whole.width * whole.height)};
    ThreadPool pool(options.threads);
    Tracer tracer(std::move(opened.scene), Precision::float64);
    ProgressLine progress(options.quiet);
    bool named = true;
    for (int i = 0; i < options.pictures; ++i) {
        const double time = opening.time.emplace(moments[std::size_t(i)]);
        // A scene that uses POV-Ray's clock is another one at each moment.
        if (opened.changes && i > 0)
            tracer = Tracer(open_scene(text, options.scene, opening, read_pixels).scene, Precision::float64);
        const Scene& scene = tracer.scene();
        const Camera camera = camera_at(scene, time);
        const auto shutter = shutter_moments(tracer.declared(), time, shutter_seconds(camera, FrameRate{}.per_second()),
                                             [&](double moment) { return camera_at(scene, moment); });
        const View view{.camera = camera,
                        .width = width,
                        .height = height,
                        .depth = options.depth.value_or(scene.settings.max_trace_level),
                        .error = half_step(format),
                        .time = time,
                        .moments = shutter};
        const Picture picture{width, height, 3,
                              values_of(tracer, view, {.columns = width, .rows = height}, pool, sampling, stop)};
        if (stop && *stop) throw Interrupted("interrupted");
        const int x = i % layout.columns * (width + gap), y = i / layout.columns * (height + strip + gap);
        put(picture, sheet, x, y, layout.picture);
        progress.advance(std::uint64_t(i) + 1, std::uint64_t(options.pictures));
        if (named) try {
                const Picture label = text_picture(text_of(time) + " s", font_size);
                const int above = std::max(strip - label.height, 0) / 2;
                put(label, sheet, x, y + height + above, {width, strip - above});
            } catch (const FileError& error) {
                std::cerr << "strahl: warning: the sheet names no times: " << printable(error.what()) << '\n';
                named = false;
            }
    }
    write_picture(sheet, options.output, format);
    return exit_status::done;
} catch (const Interrupted&) {
    std::cerr << "strahl: interrupted; no sheet was written\n";
    return exit_status::interrupted;
}

}  // namespace strahl
