#include "show/recordings.h"

#include <cstdio>
#include <string>

#include "files/output_file.h"

namespace strahl {

void Recordings::keep_flown(const Fresh& fresh, const Session& session) {
    if (!session.flight.under_way() || pace.motion.pictures().empty()) return;
    const View& view = fresh.picture.view;
    flown.shown(view.time / session.flight.path()->duration, fresh.image, fresh.picture.scene, view);
}

void Recordings::report_benchmark(const BenchmarkSetting& setting, const Exposure& exposure,
                                  const std::atomic<bool>& interrupted) const {
    Benchmark benchmark = benchmark_of(pace.motion.pictures());
    if (!interrupted) {
        log_line("comparing " + std::to_string(flown.count()) + " pictures with the finished ones");
        benchmark.quality = flown.compare(options.threads, exposure, interrupted);
    }
    std::fputs(report_of(benchmark, setting).c_str(), stdout), std::fflush(stdout);
    if (!options.stats.empty()) write_file(options.stats, json_of(benchmark, setting));
}

bool Recordings::tell_done() {
    film.tell_done();
    const bool finished = stills.finished() && !film.under_way();  // before: a still may be done at any time
    stills.tell_done();
    return finished;
}

std::vector<Overlay::Bar> Recordings::bars() const {
    std::vector<Overlay::Bar> bars;
    if (const std::string text = stills.progress_text(); !text.empty()) bars.push_back({text, stills.progress()});
    if (film.under_way()) bars.push_back({film.progress_text(), film.progress()});
    return bars;
}

}  // namespace strahl
