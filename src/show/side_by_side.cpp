#include "show/side_by_side.h"

#include <utility>

namespace strahl {
namespace {

/// Shortens a message of several lines to its first one, and the first one after that which names an error.
std::string in_short(const std::string& fault) {
    const std::size_t end = fault.find('\n'), named = fault.find("Error", std::min(end, fault.size()));
    if (named == fault.npos) return fault.substr(0, end);
    return fault.substr(0, end) + " " + fault.substr(named, fault.find('\n', named) - named);
}

}  // namespace

void SideBySide::toggle(Action action) {
    if (action == Action::second)
        line.next();
    else
        line.difference = !line.difference;
    pace.redraw();
    const std::string name = second_name(line.second);
    if (!line.shown())
        notes.note(action == Action::second ? "one picture" : "G chooses what the picture is compared with");
    else
        notes.note(line.difference ? "at the right: 16 times the difference from " + name
                                   : "at the right: " + name + "; the line can be dragged");
}

void SideBySide::follow(const Session& session, const View& view, bool finished) {
    if (!line.shown() || !finished) return pictures.drop();
    SecondOrder order{line.second, session.scene, view, path, mirrored, session.exposure};
    order.view.error = 0;
    const bool before = pictures.under_way();
    pictures.want(std::move(order));
    if (!before && pictures.under_way()) began = pace.now(), pace.redraw();
    if (!pictures.take()) return;
    pace.redraw();
    if (!pictures.fault().empty()) {
        log_line(pictures.fault());
        notes.fail(in_short(pictures.fault()));
    } else {
        notes.log("second picture: " + second_name(line.second) + ", " +
                  std::to_string(pictures.picture()->differing) + " pixels differ by more than 1/255" +
                  (pictures.picture()->finished ? "" : "; smooth edges follow"));
    }
}

std::shared_ptr<const ScreenImage> SideBySide::image() const {
    const auto& picture = pictures.picture();
    if (!picture) return nullptr;
    return {picture, line.difference ? &picture->difference : &picture->image};
}

Overlay::Sides SideBySide::sides(const ScreenArea& area) const {
    const auto& picture = pictures.picture();
    std::string right = second_name(line.second);
    if (picture && line.difference)
        right += ", 16 times the difference: " + std::to_string(picture->differing) + " pixels beyond 1/255";
    if (!pictures.fault().empty()) right += ": no picture";
    if (pictures.under_way() && !(picture && line.difference))
        right += (picture ? "; smooth edges follow, " : " is tracing, ") +
                 std::to_string(static_cast<int>(pace.now() - began)) + " s";
    return {line.column(area), "Strahl", right};
}

}  // namespace strahl
