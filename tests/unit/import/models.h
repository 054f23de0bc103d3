// Shared by the tests of models: files in a folder of their own, and the scenes made of them.
#pragma once
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "import/models/stage.h"
#include "tests/unit/faults.h"
#include "tests/unit/scratch.h"

namespace strahl::importing {

/// Writes files, and reads models of them. Pictures are not decoded: all are of 2 x 2 pixels, white above and black
/// below, and their right half is clear if "clear" is in their names.
class Models {
  public:
    Models& put(const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return *this;
    }
    Model read(const std::string& name, double time = 0) const {
        const auto pixels = [](const std::string& path) {
            if (!std::ifstream(path)) throw FileError("cannot read '" + path + "'");
            FilePixels pixels(Pixels{2, 2, false, {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}, Color(1)});
            if (path.find("clear") != path.npos) pixels.opacity = {1, 0, 1, 0};
            return pixels;
        };
        return read_model(folder / name, pixels, time);
    }
    /// The message of a model that cannot be read, without the folder.
    std::string fault(const std::string& name) const {
        return without_folder(fault_of([&] { read(name); }, "no error"));
    }
    std::string without_folder(std::string text) const {
        const std::string own = folder / "";
        for (std::size_t at = text.find(own); at != text.npos; at = text.find(own)) text.erase(at, own.size());
        return text;
    }

    Scratch folder;
};

}  // namespace strahl::importing
