// The dictionary of the attack on the parser: every word of the language is in it.
#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "text/blocks.h"

using namespace strahl;

namespace {

std::set<std::string, std::less<>> dictionary() {
    std::ifstream file(STRAHL_SOURCE "/tests/attack/language.dict");
    std::set<std::string, std::less<>> words;
    for (std::string line; std::getline(file, line);)
        if (line.size() > 2 && line.front() == '"') words.insert(line.substr(1, line.size() - 2));
    return words;
}

}  // namespace

TEST_CASE("every word of the language is in the dictionary") {
    const auto words = dictionary();
    const auto look = [&](std::string_view word) {
        CAPTURE(std::string(word));
        CHECK(words.contains(word));
    };
    const auto look_at_names = [&](const auto& parameters) {
        for (const Parameter& parameter : parameters) look(parameter.name);
    };
    for (const std::string_view word : block_words) look(word);
    for (const std::string_view word : shape_words) look(word);
    EyeText eye;
    std::optional<double> aspectratio;
    double time = 0;
    Flythrough path;
    Light light;
    Color background{0};
    SettingsText settings;
    Material material;
    look("key");
    look_at_names(camera_parameters(eye, aspectratio));
    look_at_names(key_parameters(time, eye));
    look_at_names(flythrough_parameters(path));
    look_at_names(light_parameters(light));
    look_at_names(background_parameters(background));
    look_at_names(settings_parameters(settings));
    look_at_names(material_parameters(material));
}
