// The formulas of tori, against numbers of 113 bits: see formulas_of_bodies.cpp.
#include "tests/proof/tori.h"

using namespace strahl;
using namespace strahl::trial;

TEST_CASE("formulas of tori") { try_tori<Torus>(21); }
