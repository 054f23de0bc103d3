#include "text/camera_text.h"

#include <initializer_list>
#include <string_view>
#include <vector>

#include "files/words.h"
#include "num/decimal.h"
#include "text/text_changes.h"
#include "text/text_items.h"
#include "text/write.h"

namespace strahl {

std::optional<std::string> with_camera(const std::string& text, const Keyframe& view) {
    const TextItem block = item_of_block(text, "camera");
    if (block.word.empty()) {
        Camera camera;
        camera.position = view.position, camera.look_at = view.look_at;
        if (view.up) camera.up = *view.up;
        if (view.fov) camera.fov = *view.fov;
        return write_camera(camera, {}, {}) + text;
    }
    if (block.end.empty()) return std::nullopt;
    const std::size_t end = slice_of(text, block.end).begin;
    std::vector<TextChange> changes;
    bool found = true;
    const auto put = [&](std::string_view word, std::initializer_list<double> numbers, const std::string& written) {
        const TextItem* const item = block.item(word);
        if (!item) return changes.push_back({{end, end}, " " + std::string(word) + " " + written + " "});
        if (item->numbers.size() != numbers.size() || !item->tracks.empty()) return void(found = false);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            changes.push_back({slice_of(text, item->numbers[i]), text_of(numbers.begin()[i])});
    };
    const auto put_vector = [&](std::string_view word, const DVec3& v) { put(word, {v.x, v.y, v.z}, text_of(v)); };
    put_vector("position", view.position);
    put_vector("look_at", view.look_at);
    if (view.up) block.item("sky") ? put_vector("sky", DVec3(0) - *view.up) : put_vector("up", *view.up);
    if (view.fov) {
        const bool angle = block.item("angle") != nullptr;
        const double number = angle ? 2 * *view.fov : *view.fov;
        put(angle ? "angle" : "fov", {number}, text_of(number));
    }
    if (!found) return std::nullopt;
    return with_changes(text, std::move(changes));
}

std::optional<std::string> with_focus_on(const std::string& text, const DVec3& point, double aperture) {
    const TextItem block = item_of_block(text, "camera");
    if (block.word.empty() || block.end.empty()) return std::nullopt;
    const std::size_t end = slice_of(text, block.end).begin;
    std::vector<TextChange> changes;
    // Puts it in place of the item.
    const auto put = [&](const TextItem* item, const std::string& written) {
        if (!item) return changes.push_back({{end, end}, " " + written + " "});
        // A vector ends with its bracket.
        const std::size_t last = slice_of(text, item->numbers.back()).end;
        const bool vector = item->numbers.size() == 3;
        changes.push_back({{slice_of(text, item->word).begin, vector ? text.find('>', last) + 1 : last}, written});
    };
    const TextItem *const lens = block.item("aperture"), *const on = block.item("focus_on"),
                          *const focus = on ? on : block.item("focus");
    if ((lens && !lens->tracks.empty()) || (focus && !focus->tracks.empty())) return std::nullopt;
    double known = 0;
    if (!lens || !read_number(lens->numbers[0], known) || known == 0) put(lens, "aperture " + text_of(aperture));
    put(focus, "focus_on " + text_of(point));
    return with_changes(text, std::move(changes));
}

}  // namespace strahl
