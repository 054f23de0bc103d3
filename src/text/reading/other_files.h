// Recognises files that are given in place of a scene.
#pragma once
#include <string_view>

namespace strahl {

/// Throws FileError, with what to do, if these are the bytes of a picture, a film, a sound, an archive, a program or a
/// document, or if `file` is named like a mesh. Whatever else is no scene, the parser reports.
void refuse_other_files(std::string_view bytes, std::string_view file);
/// Throws FileError if the bytes are a scene of a program that `strahl import` knows.
void refuse_other_scenes(std::string_view bytes, std::string_view file);

}  // namespace strahl
