#include "pov/open_pov.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "pov/meaning/queries.h"
#include "pov/meaning/scene_maker.h"

namespace strahl::pov {
namespace {

SourceLines lines_of(const SceneMaker& maker, const Interpreter& in) {
    struct KnownText {
        std::uint32_t number;
        std::vector<std::uint32_t> ends;  // of its lines
    };
    std::map<std::uint32_t, KnownText> texts;
    SourceLines lines;
    const auto line_of = [&](const TextPlace& place) {
        const auto number = static_cast<std::uint32_t>(texts.size());
        const auto [known, fresh] = texts.try_emplace(place.file, KnownText{number, {}});
        auto& ends = known->second.ends;
        if (fresh) {
            const std::string_view text = in.text_at({place.file, 0});
            for (std::size_t i = 0; i < text.size(); ++i)
                if (text[i] == '\n' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n"))
                    ends.push_back(static_cast<std::uint32_t>(i));
            lines.files.push_back(in.path_of(place));
        }
        const auto before = std::ranges::lower_bound(ends, place.at) - ends.begin();
        SourceLines::BlockLine line{known->second.number, static_cast<int>(before) + 1};
        if (place.file == 0) line.at = place.at;
        return line;
    };
    for (const TextPlace& place : maker.places()) lines.bodies.push_back(line_of(place));
    for (const TextPlace& place : maker.places_of_lights()) lines.lights.push_back(line_of(place));
    return lines;
}

}  // namespace

OpenedPov open_pov(std::string text, const InterpreterOptions& options, const ReadPixels& read_pixels) {
    PovLayer layer(read_pixels);
    Interpreter in(std::move(text), options, layer);
    layer.read_all(in);
    SceneMaker maker(in, layer.contents);
    OpenedPov opened{
        .scene = maker.make(), .mirrored = maker.mirrors(), .notes = {}, .warnings = {}, .files = in.files()};
    layer.tell_constants(in);
    opened.clock_used = in.clock_used(), opened.size_used = in.size_used();
    opened.lines = lines_of(maker, in);
    const bool opaque_sky = layer.contents.sky && in.version_given() && in.version() >= 3.7;
    opened.background_opacity = opaque_sky ? 1 : layer.contents.background_opacity;
    std::vector<Remark> remarks = in.remarks();
    std::ranges::stable_sort(remarks, {}, [](const Remark& own) { return std::pair(own.place.file, own.place.at); });
    for (const Remark& own : remarks) {
        const bool left_out = own.kind == Remark::Kind::left_out;
        if (own.kind == Remark::Kind::warning)
            opened.warnings.push_back(in.message_at(own.place, own.text));
        else
            opened.notes.push_back(
                {in.message_at(own.place, (left_out ? "left out: " : "approximated: ") + own.text), left_out});
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
