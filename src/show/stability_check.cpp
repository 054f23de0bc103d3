// Renders in three precisions and lists the pixels that differ.
#include "show/stability_check.h"

#include <algorithm>
#include <utility>

#include "image/transfer.h"
#include "trace/agreement.h"

namespace strahl {

StabilityCheck::StabilityCheck(int thread_count, std::function<void()> notify_function)
    : threads(thread_count), notify(std::move(notify_function)) {}

StabilityCheck::~StabilityCheck() { cancel(); }

void StabilityCheck::start(std::shared_ptr<const Scene> scene, const View& view) {
    cancel();
    share = 0;
    thread = std::thread([this, scene = std::move(scene), view] {
        Agreements agreements(*scene, threads,
                              [linear = scene->settings.linear](double v) { return quantise(v, linear, 255); });
        constexpr int band = 64;  // rows at a time
        for (int y = 0; y < view.height && !stop; y += band) {
            const Lattice rows{.y = y, .columns = view.width, .rows = std::min(band, view.height - y)};
            const auto map = agreements.of(view, rows, nullptr, &stop);
            for (std::size_t i = 0; i < map.size(); ++i)
                if (map[i] != Agreement::all)
                    marks.push_back({int(i) % view.width, y + int(i) / view.width, map[i] == Agreement::not_float64});
            share = double(y + rows.rows) / view.height;
            notify();
        }
        ready = true;
        notify();
    });
}

void StabilityCheck::cancel() {
    stop = true;
    if (thread.joinable()) thread.join();
    stop = ready = false;
    marks.clear();
}

std::optional<std::vector<Mark>> StabilityCheck::take() {
    if (!ready) return {};
    thread.join();
    ready = false;
    return std::exchange(marks, {});
}

}  // namespace strahl
