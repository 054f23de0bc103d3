// Tells what a scene cannot say as the file does.
#pragma once
#include <algorithm>
#include <string>

#include "pov/language/interpreter.h"
#include "pov/things/numbers.h"

namespace strahl::pov {

struct NoteTaker {
    Interpreter& in;
    void approximated(TextPlace place, const std::string& text) const {
        in.remark(Remark::Kind::approximated, place, text);
    }
    void left_out(TextPlace place, const std::string& text) const { in.remark(Remark::Kind::left_out, place, text); }
};

inline double max_of(const Color& c) { return std::max({c.x, c.y, c.z, 1e-9}); }
inline double mean(const Color& c) { return (c.x + c.y + c.z) / 3; }
inline bool is_grey(const Color& c) { return c.x == c.y && c.y == c.z; }

}  // namespace strahl::pov
