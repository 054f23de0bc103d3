// Reads transformations.
#include "pov/reading/reader.h"

namespace strahl::pov {
namespace {

DVec3 read_factors(Interpreter& in) {
    DVec3 factors = in.read_vector();
    for (int i = 0; i < 3; ++i)
        if (factors[i] == 0) factors[i] = 1, in.warn("a scale of 0 is taken for 1");
    return factors;
}

MatrixStep read_matrix(Interpreter& in) {
    glm::dmat4 m(1);
    in.expect('<');
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row) m[column][row] = in.read_number(), in.skip_comma();
    in.expect('>');
    return MatrixStep(m);
}

}  // namespace

/// Reads a transformation; reads nothing and returns false if none comes.
bool PovReader::read_step(Interpreter& in, Steps& steps) {
    switch (in.code()) {
        case word("translate"):
            in.take();
            steps.push_back(Translate{in.read_vector()});
            return true;
        case word("rotate"):
            in.take();
            steps.push_back(Rotate{in.read_vector()});
            return true;
        case word("scale"):
            in.take();
            steps.push_back(Scale{read_factors(in)});
            return true;
        case word("matrix"):
            in.take();
            steps.push_back(read_matrix(in));
            return true;
        case word("transform"):
            break;
        default:
            return false;
    }
    in.take();
    if (const auto own = in.accept_thing<TransformThing>(ValueKind::transform)) return append(steps, own->steps), true;
    in.begin_block();
    Steps block;
    bool inverted = false;
    for (;;) {
        if (const auto own = in.accept_thing<TransformThing>(ValueKind::transform))
            append(block, own->steps);
        else if (in.accept("inverse"))
            inverted = true;
        else if (!read_step(in, block))
            break;
    }
    in.end_block();
    append(steps, inverted ? inverse(block) : block);
    return true;
}

}  // namespace strahl::pov
