#include "povref/convert/ini.h"

#include <algorithm>
#include <filesystem>

#include "files/error.h"
#include "num/decimal.h"
#include "povref/convert/layout.h"
#include "text/reading/messages.h"

namespace strahl {
namespace {

/// Returns a path as an .ini file holds it, which has no way to escape characters.
std::string quoted_path(const std::string& path) {
    const auto has = [&](const char* text) { return path.find(text) != path.npos; };
    const bool steers = std::ranges::any_of(path, [](unsigned char c) { return c < ' ' || c == 0x7F; });
    if (steers || (has("\"") && has("'")) || has("\\\"") || has("\\'"))
        throw UsageError("POV-Ray's .ini files cannot hold the name " + strahl::quoted(path) +
                         "; choose one without line breaks and quotes");
    if (path.find_first_of(" ;#'\"") == path.npos) return path;
    const std::string quote(path.find('"') == path.npos ? "\"" : "'");
    return quote + path + quote;
}

/// Returns the shell command that runs POV-Ray, which splits its arguments at spaces again.
std::string command(const std::string& ini_path) {
    const std::string quoted = quoted_path(ini_path);
    if (quoted == ini_path) return "povray " + quoted;
    std::string escaped;
    for (const char c : quoted) escaped += c == '\'' ? "'\\''" : std::string(1, c);
    return "povray '" + escaped + "'";
}

}  // namespace

std::string ini_beside(const std::string& pov_path) {
    return std::filesystem::path(pov_path).replace_extension(".ini").string();
}

std::string ini_of(const Scene& scene, const PovRequest& request, const IniNeeds& needs) {
    std::string text =
        comment(request.title + " for POV-Ray 3.7, to be run by", ";") + ";   " +
        command(ini_beside(request.pov_path)) + "\n" + "Input_File_Name=" + quoted_path(request.pov_path) +
        "\nOutput_File_Name=" + quoted_path(request.picture_path) + "\n\n" + "Width=" + std::to_string(request.width) +
        "\nHeight=" + std::to_string(request.height) + "\n" + comment("PNG.", ";") +
        "Output_File_Type=N\nBits_Per_Color=" + std::to_string(request.bits) + "\nOutput_Alpha=Off\nDither=Off\n";
    text += comment(scene.settings.assumed_gamma != 0
                        ? "The values stand for light and the file is sRGB-encoded."
                        : "The same as assumed_gamma in the scene: the file holds the computed values.",
                    ";") +
            "File_Gamma=srgb\n";
    text += "\n" + comment("One ray through the middle of each pixel, all light followed.", ";") +
            "Antialias=Off\nQuality=9\n";
    if (request.fps > 0)
        text += "\n" + comment("Frame N is the view at N/" + text_of(request.fps) + " seconds.", ";") +
                "Initial_Frame=0\nFinal_Frame=" + std::to_string(request.cameras.size() - 1) + "\n";
    if (needs.moves)
        text +=
            "Initial_Clock=0\nFinal_Clock=" + text_of(static_cast<double>(request.cameras.size() - 1) / request.fps) +
            "\n";
    const std::string folder = std::filesystem::path(request.pov_path).parent_path().string();
    if (needs.pictures && !folder.empty())
        text += "\n" + comment("Pictures are beside the scene.", ";") + "Library_Path=" + quoted_path(folder) + "\n";
    if (needs.inside)
        text += "\n" +
                comment(
                    "The camera is in a transparent body. With bounding boxes POV-Ray would list the bodies "
                    "around it in another order than the file.",
                    ";") +
                "Bounding=Off\n";
    text += "\nDisplay=Off\nPause_When_Done=Off\n";
    if (needs.keyword)
        text +=
            comment("POV-Ray warns that the keyword `refraction` is old; nothing else is worth a warning here.", ";") +
            "Warning_Console=Off\n";
    return text;
}

}  // namespace strahl
