// Renders in three precisions and lists the pixels that differ.
#include "show/stability_check.h"

#include <utility>

#include "image/transfer.h"
#include "trace/agreement.h"

namespace strahl {

StabilityCheck::StabilityCheck(int thread_count, std::function<void()> notify_function)
    : threads(thread_count), notify(std::move(notify_function)) {}

StabilityCheck::~StabilityCheck() { cancel(); }

void StabilityCheck::start(std::shared_ptr<const Scene> scene, const View& view) {
    cancel();
    thread = std::thread([this, scene = std::move(scene), view] {
        Agreements agreements(*scene, threads,
                              [linear = scene->settings.linear](double v) { return quantise(v, linear, 255); });
        const auto map = agreements.of(view, {.columns = view.width, .rows = view.height}, nullptr, &stop);
        for (std::size_t i = 0; i < map.size(); ++i)
            if (map[i] != Agreement::all)
                marks.push_back({int(i) % view.width, int(i) / view.width, map[i] == Agreement::not_float64});
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
