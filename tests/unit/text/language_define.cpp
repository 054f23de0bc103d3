// The scene language: names given once and used again.
#include "tests/unit/text/language.h"

using namespace strahl;
using namespace strahl::language;

namespace {

/// Do both texts say the same?
void check_same(const std::string& text, const std::string& written_out) {
    CAPTURE(text);
    CHECK(with_eye(text) == with_eye(written_out));
}

const std::string gold = "define gold material { rgb <1,.8,.3> pow 90 }\n";
const std::string ball = "define ball sphere { <0,0,1>, 1 material { rgb <1,0,0> } translate <1,0,0> }\n";

}  // namespace

TEST_CASE("a material by its name, as it is or with changes") {
    check_same(gold + "sphere { <0,0,0>, 1 material gold }", "sphere { <0,0,0>, 1 material { rgb <1,.8,.3> pow 90 } }");
    check_same(gold + "sphere { <0,0,0>, 1 material gold { pow 3 ior 2 } translate <1,2,3> }",
               "sphere { <0,0,0>, 1 material { rgb <1,.8,.3> pow 3 ior 2 } translate <1,2,3> }");
    check_same(gold + "defaultmaterial { diffuse 1 } defaultmaterial gold sphere { <0,0,0>, 1 }",
               "defaultmaterial { diffuse 1 rgb <1,.8,.3> pow 90 } sphere { <0,0,0>, 1 }");
    check_same(gold + "define pale material gold { rgb <1,1,1> } sphere { <0,0,0>, 1 material pale }",
               "sphere { <0,0,0>, 1 material { rgb <1,1,1> pow 90 } }");
    // A defined material changes only what it names, also where another default is in force.
    check_same(gold + "defaultmaterial { diffuse 1 } sphere { <0,0,0>, 1 material gold }",
               "defaultmaterial { diffuse 1 } sphere { <0,0,0>, 1 material { rgb <1,.8,.3> pow 90 } }");
}

TEST_CASE("a body by its name, moved further and of another material") {
    check_same(ball, "");
    check_same(ball + "ball { } ball { scale 2 material { pow 3 } }",
               "sphere { <0,0,1>, 1 material { rgb <1,0,0> } translate <1,0,0> }"
               "sphere { <0,0,1>, 1 material { rgb <1,0,0> pow 3 } translate <1,0,0> scale 2 }");
    const std::string pair =
        "define pair union { ball { } ball { translate <3,0,0> } box { <0,0,0>, <1,1,1> } rotate <0,0,9> }\n";
    const std::string pair_parts =
        "sphere { <0,0,1>, 1 material { rgb <1,0,0> } translate <1,0,0> }"
        "sphere { <0,0,1>, 1 material { rgb <1,0,0> } translate <1,0,0> translate <3,0,0> } box { <0,0,0>, <1,1,1> }";
    check_same(ball + pair + "defaultmaterial { pow 7 } pair { translate <0,0,5> }",
               "defaultmaterial { pow 7 } union { " + pair_parts + " rotate <0,0,9> translate <0,0,5> }");
    check_same(ball + pair + "difference { box { <-9,-9,-9>, <9,9,9> } pair { material { diffuse 1 } } }",
               "difference { box { <-9,-9,-9>, <9,9,9> } union { " + pair_parts +
                   " rotate <0,0,9> material { diffuse 1 } } }");
}

TEST_CASE("mistakes with names") {
    check_fault("define material { }", "2:17: 'material' or a body expected after 'material', but found '{'");
    check_fault("define { }", "2:8: a name expected after 'define', but found '{'");
    check_fault("define light material { }", "2:8: 'light' is a word of the language; choose another name");
    check_fault(gold + "define gold sphere { <0,0,0>, 1 }", "3:8: a second 'gold'; the first is in line 2");
    check_fault("define x shpere { <0,0,0>, 1 }",
                "2:10: unknown word 'shpere' after 'define x'; did you mean 'sphere'?");
    check_fault("sphere { <0,0,0>, 1 material gold }",
                "2:30: unknown material 'gold': define it above, by define gold material { ... }");
    check_fault(gold + "sphere { <0,0,0>, 1 material glod }",
                "3:30: unknown word 'glod' for 'material'; did you mean 'gold'?");
    check_fault(ball + "bal { }", "3:1: unknown word 'bal'; did you mean 'ball'?");
    check_fault(ball + "ball { <0,0,0> }", "3:8: a word or '}' expected in 'ball', but found '<'");
    check_fault(ball + "ball { scale 1e300 }",
                "3:8: invalid ball: the transformations up to here make it too large, too small or too far away "
                "(coordinates go up to 1e9)");
    check_fault("define thin disc { <0,0,0>, <0,0,1>, 1 }\nunion { thin { } }",
                "3:9: a thin cannot be part of a body: only closed bodies can");
    // An error in a definition is reported once.
    check_fault("define ball sphere { <0,0,0>, -1 }\nball { } ball { scale 2 }",
                "2:31: 'radius' of 'sphere' must be greater than 0 and at most 1e9, not '-1'");
    // Doubling 40 times makes more bodies than a scene may have, and is stopped early.
    std::string doubling = "define a0 sphere { <0,0,0>, 1 }\n";
    for (int i = 1; i < 40; ++i) {
        const std::string before = "a" + std::to_string(i - 1) + " { }";
        doubling += "define a" + std::to_string(i) + " union { " + before + " " + before + " }\n";
    }
    CHECK(faults(eye + doubling).size() <= 10);
    CHECK(faults(eye + doubling)[0].ends_with("it consists of more than 100000 bodies"));
    // Unions of one, thousands of them in each other, are stopped early, too.
    std::string nested = "define a0 sphere { <0,0,0>, 1 }\n";
    for (int i = 1; i < 5000; ++i)
        nested += "define a" + std::to_string(i) + " union { a" + std::to_string(i - 1) + " { } }\n";
    CHECK(faults(eye + nested).at(0) == "x.rt:34:20: more than 32 levels of bodies in bodies");
}
