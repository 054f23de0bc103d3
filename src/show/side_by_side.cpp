#include "show/side_by_side.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

// As commands.h numbers them.
static_assert(int(SecondKind::depth) == 6 && int(SecondKind::normals) == 7);

void SideBySide::toggle(Command command) {
    const auto [action, number] = command;
    if (action == Action::second && number > 0)
        line.second = line.second == SecondKind(number) ? SecondKind::none : SecondKind(number);
    else if (action == Action::second)
        line.next();
    else
        line.difference = !line.difference;
    if (line.layer()) line.difference = false;
    if (action == Action::second) of_flight.reset(), first.reset();
    pace.redraw();
    const std::string name = second_name(line.second);
    if (!line.shown())
        notes.note(action == Action::second ? "one picture"
                                            : notes.key(Action::second) + " chooses what the picture is compared with");
    else if (line.layer())
        notes.note("at the right: " + name + "; the pointer shows its values");
    else
        notes.note(line.difference && !line.other_view() ? "at the right: 16 times the difference from " + name
                                                         : "at the right: " + name + "; the line can be dragged");
}

void SideBySide::log_second(const SecondPicture& picture) {
    const std::string differing = ", " + std::to_string(picture.differing) +
                                  (picture.differing == 1 ? " pixel differs" : " pixels differ") +
                                  " by more than 1/255";
    notes.log("second picture: " + second_name(line.second) + (line.other_view() || line.layer() ? "" : differing) +
              (picture.finished ? "" : "; smooth edges follow"));
}

void SideBySide::keep(const Fresh& fresh) {
    if (line.second != SecondKind::in_motion) return first.reset();
    const auto& [image, picture, row, rows] = fresh;
    if (picture.number != std::exchange(first_number, picture.number))
        first = std::make_shared<SecondPicture>(), first->image = image, first_level = picture.level;
    if (first && picture.finished() && !first->finished) {  // perhaps at once
        first = std::make_shared<SecondPicture>(*first);
        compare(image, *first), first->finished = true;
        log_second(*first);
    }
}

void SideBySide::follow(const Session& session, const View& view, bool finished) {
    const bool flight = line.other_view(), brief = flight && !finished;
    if (!line.shown() || line.second == SecondKind::in_motion || (!finished && !flight)) return pictures.drop();
    SecondOrder order{line.second, session.scene, view, path, mirrored, session.exposure, brief};
    order.view.error = 0;
    if (flight) {
        const ScreenArea seen = line.second_area({0, 0, view.width, view.height});
        order.view.camera = session.flight_camera();
        order.view.width = std::max(seen.width / (brief ? 2 : 1), 1);
        order.view.height = std::max(seen.height / (brief ? 2 : 1), 1);
    }
    const bool before = pictures.under_way();
    if (!brief || !before) pictures.want(std::move(order));
    if (!before && pictures.under_way()) began = pace.now(), pace.redraw();
    if (!pictures.take()) return;
    pace.redraw();
    if (flight) of_flight = pictures.picture();
    if (brief) return;
    if (!pictures.fault().empty()) {
        log_line(pictures.fault());
        notes.fail(in_short(pictures.fault()));
    } else {
        log_second(*pictures.picture());
    }
}

void SideBySide::point(double x, double y) {
    if (!line.layer()) return;
    pointed_x = x, pointed_y = y;
    pace.redraw();
    if (const auto picture = pictures.picture()) notes.log("pointed at" + values_at_pointer(*picture));
}

std::string SideBySide::values_at_pointer(const SecondPicture& picture) const {
    const int width = picture.image.width, height = picture.image.height;
    const double x = std::floor(pointed_x * width), y = std::floor(pointed_y * height);
    if (!(x >= 0 && y >= 0 && x < width && y < height)) return "";
    const auto& [distance, normal, position] = picture.seen[static_cast<std::size_t>(y * width + x)];
    if (std::isinf(distance)) return ": nothing";
    char text[160];
    std::snprintf(text, sizeof text, ": %.5g away, normal <%.3g, %.3g, %.3g>, at <%.4g, %.4g, %.4g>", double(distance),
                  double(normal[0]), double(normal[1]), double(normal[2]), double(position[0]), double(position[1]),
                  double(position[2]));
    return text;
}

std::shared_ptr<const ScreenImage> SideBySide::image() const {
    const bool flight = line.other_view();
    const std::shared_ptr<const SecondPicture> picture = flight                                 ? of_flight
                                                         : line.second != SecondKind::in_motion ? pictures.picture()
                                                         : first && first->finished             ? first
                                                                                                : nullptr;
    if (!picture) return nullptr;
    return {picture, line.difference && !flight ? &picture->difference : &picture->image};
}

Overlay::Sides SideBySide::sides(const ScreenArea& area) const {
    std::string right = second_name(line.second);
    if (line.other_view()) {
        ScreenArea seen = line.second_area(area);
        if (!of_flight) seen.height = 0, right += ": tracing";
        return {line.column(area), "", right, seen};
    }
    const bool in_motion = line.second == SecondKind::in_motion;
    const std::shared_ptr<const SecondPicture> picture = in_motion ? first : pictures.picture();
    if (in_motion && !line.difference) right += picture ? ", " + resolution_text(first_level) : ": move the camera";
    if (picture && (in_motion ? picture->finished : line.difference))
        right += (line.difference ? ", 16 times the difference: " : ": ") + std::to_string(picture->differing) +
                 " pixels beyond 1/255";
    if (picture && line.layer()) right += values_at_pointer(*picture);
    if (!pictures.fault().empty()) right += ": no picture";
    if (pictures.under_way() && !(picture && line.difference))
        right += (picture ? "; smooth edges follow, " : " is tracing, ") +
                 std::to_string(static_cast<int>(pace.now() - began)) + " s";
    return {line.column(area), "Strahl", right};
}

}  // namespace strahl
