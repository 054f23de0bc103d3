#include "main/lsp/problems.h"

#include <exception>
#include <utility>

#include "image/pixels.h"
#include "pov/open_scene.h"
#include "text/scene_warnings.h"

namespace strahl {

std::vector<Problem> check_scene(const std::string& text, const std::string& path, std::vector<std::string>& files) {
    std::vector<Problem> problems;
    const auto add = [&](bool warning, const std::vector<Message>& messages) {
        for (const Message& message : messages) problems.push_back({warning, message});
    };
    try {
        OpenedScene opened = open_scene(text, path, {}, read_pixels);
        add(true, opened.notes);
        add(true, opened.warnings);
        for (std::string& warning : scene_warnings(opened.scene)) add(true, {{std::move(warning)}});
        files = std::move(opened.files);
    } catch (const FileError& error) {
        add(false, *error.messages);
    } catch (const std::exception& error) {
        add(false, {{error.what()}});
    }
    return problems;
}

}  // namespace strahl
