// Opens texts of POV-Ray scenes.
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "pov/open_pov.h"
#include "tests/unit/faults.h"

namespace strahl {

/// Opens a scene; a camera that leaves coordinates as they are stands before its text. Pictures are two grey pixels.
inline pov::OpenedPov opened(const std::string& text, bool camera = true) {
    pov::InterpreterOptions options;
    options.file = "x.pov";
    const auto read = [](const std::string&) { return Pixels{2, 1, false, {0, 0, 0, 1, 1, 1}, Color(1)}; };
    return open_pov((camera ? "camera { right -4/3*x } " : "") + text, options, read);
}

/// Opens a scene, and checks that nothing in it is approximated or left out.
inline Scene whole(const std::string& text, bool camera = true) {
    const pov::OpenedPov all = opened(text, camera);
    for (const pov::PovNote& note : all.notes) CHECK_MESSAGE(false, note.message.told());
    return all.scene;
}

/// Returns all notes in one line.
inline std::string notes_of(const std::string& text) {
    std::string all;
    for (const pov::PovNote& note : opened(text).notes) all += (all.empty() ? "" : "; ") + note.message.told();
    return all;
}

template <class Kind>
const Kind& shape(const Scene& scene, std::size_t number = 0) {
    return std::get<Kind>(scene.primitives.at(number).shape);
}
inline const Material& material(const Scene& scene, std::size_t number = 0) {
    return scene.materials.at(static_cast<std::size_t>(scene.primitives.at(number).material));
}

}  // namespace strahl
