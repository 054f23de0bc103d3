// Reads values that may be separated by commas.
#pragma once
#include "pov/language/interpreter.h"

namespace strahl::pov {

inline double next_number(Interpreter& in) {
    in.skip_comma();
    return in.read_number();
}
inline DVec3 next_vector(Interpreter& in) {
    in.skip_comma();
    return in.read_vector();
}

}  // namespace strahl::pov
