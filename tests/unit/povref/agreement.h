// The scenes, and how far Strahl may differ from POV-Ray in each.
#pragma once
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "povref/compare/verdict.h"
#include "tests/unit/scenes.h"

namespace strahl {

/// The size of the stored pictures, as in make_references.
inline constexpr int picture_width = 80, picture_height = 60;

struct Allowed {
    int steps = 1;
    double share = 0;
    bool comparable() const { return share < 1; }  // or POV-Ray cannot show it
};

/// povref/allowed.txt.
inline std::map<std::string, Allowed> allowed_table() {
    std::map<std::string, Allowed> table;
    std::ifstream file(std::string(STRAHL_SOURCE) + "/povref/allowed.txt");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name, reason;
        Allowed allowed;
        if (line.empty() || line[0] == '#') continue;
        if (!(words >> name >> allowed.steps >> allowed.share >> reason))
            throw std::runtime_error("povref/allowed.txt: this line lacks a reason: " + line);
        table[name] = allowed;
    }
    return table;
}

/// Why a verdict fails, or "".
inline std::string fault(const Verdict& verdict, const Allowed& allowed) {
    std::ostringstream text;
    if (verdict.worst_off_edges > allowed.steps)
        text << "off the edges a pixel differs by " << verdict.worst_off_edges << " steps of 1/65535 (x " << verdict.x
             << ", y " << verdict.y << "), allowed are " << allowed.steps << "; ";
    if (double(verdict.beyond_off_edges) > allowed.share * double(verdict.pixels))
        text << verdict.beyond_off_edges << " pixels off the edges differ by more than a step; ";
    // In a small picture, one pixel may be more than a thousandth.
    if (double(verdict.beyond_on_edges) > std::max(2., 0.001 * double(verdict.pixels)))
        text << verdict.beyond_on_edges << " pixels on edges differ; ";
    return text.str();
}

}  // namespace strahl
