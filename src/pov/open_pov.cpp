#include "pov/open_pov.h"

#include <algorithm>

#include "pov/meaning/queries.h"
#include "pov/meaning/scene_maker.h"

namespace strahl::pov {

OpenedPov open_pov(std::string text, const InterpreterOptions& options, const ReadPixels& read_pixels) {
    PovLayer layer(read_pixels);
    Interpreter in(std::move(text), options, layer);
    layer.read_all(in);
    OpenedPov opened{
        .scene = SceneMaker(in, read_pixels, layer.contents).make(), .notes = {}, .warnings = {}, .files = in.files()};
    std::vector<Remark> remarks = in.remarks();
    std::ranges::stable_sort(remarks, {}, [](const Remark& own) { return std::pair(own.place.file, own.place.at); });
    for (const Remark& own : remarks) {
        const bool left_out = own.kind == Remark::Kind::left_out;
        std::string said = in.name_of(own.place) + ": ";
        if (own.kind == Remark::Kind::warning)
            opened.warnings.push_back(said + own.text);
        else
            opened.notes.push_back({left_out, said + (left_out ? "left out: " : "approximated: ") + own.text});
    }
    return opened;
}

std::string OpenedPov::summary() const {
    const auto lost = std::ranges::count(notes, true, &PovNote::left_out);
    const auto changed = static_cast<std::ptrdiff_t>(notes.size()) - lost;
    const auto places = [](std::ptrdiff_t n) { return std::to_string(n) + (n == 1 ? " place" : " places"); };
    if (notes.empty()) return "opens whole";
    return (changed > 0 ? "approximated in " + places(changed) : "") + (changed > 0 && lost > 0 ? ", " : "") +
           (lost > 0 ? "left out in " + places(lost) : "");
}

}  // namespace strahl::pov
