// Tests how POV-Ray's scene language handles mistakes, limits and files.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "tests/unit/pov/language.h"
#include "tests/unit/scratch.h"

using namespace strahl;
using namespace strahl::pov;

namespace {

std::string repeated(const std::string& part, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += part;
    return all;
}
void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}
std::string read(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
InterpreterOptions short_run() {
    InterpreterOptions options;
    options.limits.steps = 100'000;
    options.limits.bytes = 10 << 20;
    return options;
}

}  // namespace

TEST_CASE("messages say where, why, and by which macros") {
    CHECK(run_script("#declare Red = 1;\n#macro Ball(p)\n  sphere { p } #declare a = Redd;\n#end\nBall(1)").error ==
          "scene.pov:3:29: unknown name 'Redd'; a value expected; did you mean 'Red'?\n"
          "      sphere { p } #declare a = Redd;\n"
          "                                ^~~~\n"
          "  in the macro 'Ball', called from scene.pov:5");
    check_fails("#declare x = 3;", "1:10: 'x' is a word of the language; choose another name");
    check_fails("#declare a = <1,2>.z;", "there is no such component: the value has 2");
    check_fails("#declare a = sqrt(-1);", "the square root of a negative number has no value");
    check_fails("#declare a = atan2(0,0);", "atan2(0, 0) has no value");
    check_fails("#declare A = array[2]; #declare b = A[2];", "it must be 0 to 1");
    check_fails("#declare A = array[2]; #declare b = A[1];", "this element of the array has no value yet");
    check_fails("#declare A = array[2]; #declare A[0] = 1; #declare b = A[0] + A[1];", "has no value yet");
    check_fails("#declare A = array[2]; #declare A[0] = A[0];", "has no value yet");
    check_fails("#macro M(a, b) #end M(1)", "the macro 'M' needs 2 arguments");
    check_fails("#declare a = substr(\"abc\", 2, 3);", "the string has 3 characters");
    check_fails("#declare a = \"abc", "this string is not closed");
    check_fails("/* /* */ 1", "this comment is not closed");
    check_fails("#if (1)", "1:1: this block is not closed");
    check_fails("#end", "'#end' without a block");
    check_fails("#for (i, #end 1, 2) #end", "1:10: '#end' without a block");
    check_fails("#while (<1,2>) #end", "found a vector");
    check_fails("#error concat(\"too \", \"bad\")", "the scene says: too bad");
    check_fails("\x80 \x81 sphere {} \x82", "this character is allowed in comments and strings only");
    CHECK(run_script("#declare a = 1 #declare b = 2;").remarks ==
          "scene.pov:1: ';' is missing after this declaration\n");
    CHECK(run_script("#for (i, 1, 5) #warning \"careful\" #end").remarks == "scene.pov:1: the scene warns: careful\n");
}

TEST_CASE("forms of old scenes") {
    check_prints("declare a = 3 declare b = sphere { 0, 1 } declare c = b #debug str(a,0,0)", "3");
    check_prints("#version 3.1; #declare i = 0 #while (i < 3) #declare i = i+1 #end #debug str(i,0,0)", "3");
    check_prints("#declare T = texture { } #declare U = texture { T } texture { } #declare V = U #debug \"read\"",
                 "read");
    check_prints("#declare a = 2;# #debug str(a,0,0)", "2");
    check_prints("#declare a = <1, 2>;; #debug str(a.x,0,0)", "1");
    check_prints("#declare A = array[1]{7}; #macro M() #local i = 0; A[i] #end #debug str(M(),0,0)", "7");
    check_fails("#declare a = \"text\";; #debug a", "found ';'");
}

TEST_CASE("what never ends is an error") {
    const std::string counts = "#declare i = 0; #while (1) #declare i = i + 1; #end";
    check_fails("\n" + counts, "2:17: the scene does not end: more than 100000 words", short_run());
    // Expects an error as soon as it is known that a loop can only go on for ever.
    const std::string endless = "invalid #while: it never ends";
    check_fails("#while (1) #end", "1:1: " + endless);
    check_fails("#declare i = 0; #while (i < 10) sphere { i, 1 } #end", "1:17: " + endless);
    check_fails("#macro M(a) sphere { a, 1 } #end #while (1) M(1) #if (1) #debug \"x\" #else #break #end #end",
                endless);
    check_fails("#declare i = 0; #while (1) #while (i < 3) #declare i = i + 1; #end #end", "1:17: " + endless);
    check_fails("#for (i, 0, 1e18) #end", "1:1: invalid #for: it never ends, with 1e+18 steps");
    check_fails("#for (i, 0, -1e18, -1) sphere { 0, 1 } #end", "it never ends, with 1e+18 steps");
    check_fails("#for (i, 0, 9, 0) #end", "1:1: invalid #for: its step is 0");
    check_fails("#for (i, 0, 1e18) #if (i > 1e6) #break #end #end", "the scene does not end", short_run());
    check_prints("#for (i, 0, 1e18) #if (i > 9) #break #end #end #debug str(i,0,0)", "10");
    check_prints("#declare s = seed(1); #declare n = 0; #while (rand(s) > .01) #end #debug \"out\"", "out");
    check_prints(
        "#declare B = sphere { 0, 1 } #declare A = array[2]{0, 0} #declare i = 0; #while (A[1] < 2) "
        "#declare A[1] = A[1] + 1; #end #debug str(A[1],0,0)",
        "2");
    check_fails("#macro R() R() #end R()", "nested too deeply");
    check_fails("#macro R() #declare a = R(); #end R()", "nested too deeply");
    std::string bomb = "#macro m0() sphere {} #end\n";
    for (int i = 1; i < 30; ++i) {
        const std::string call = " m" + std::to_string(i - 1) + "()";
        bomb += "#macro m" + std::to_string(i) + "()" + call + call + " #end\n";
    }
    check_fails(bomb + "m29()", "the scene does not end", short_run());
    check_fails("#declare S = \"a\"; #while (1) #declare S = concat(S, S) #end", "longer than a million characters");
    check_fails("#declare A = array[1e9];", "too much memory");
    check_fails(
        "#declare A = array[9]; #declare i = 0; #while (1) #declare A[i] = array[99999]; #declare i = i+1; #end",
        "too much memory", short_run());
    check_fails("#declare A = array[2] {1,1} #while (1) #declare B = array[2] {A, A} #declare A = B; #end",
                "nested too deeply");
    for (const char* opener :
         {"(", "-", "#if (1) ", "#declare a = ", "<", "sin(", "#declare f = function {(", "array[2] {"})
        check_fails("#declare a = " + repeated(opener, 20'000), "");
}

TEST_CASE("reading stops at once if it shall") {
    std::atomic<bool> stop = true;
    InterpreterOptions options;
    options.stop = &stop;
    BlankLayer layer;
    Interpreter in("#declare i = 0; #while (1) #declare i = i + 1; #end", options, layer);
    CHECK_THROWS_AS(in.take(), Interrupted);
}

TEST_CASE("include files: where they are looked for, and what may be read") {
    const Scratch scratch;
    const std::filesystem::path folder = scratch / "";
    std::filesystem::create_directories(folder / "scene/Parts");
    std::filesystem::create_directories(folder / "library");
    write(folder / "scene/a.inc", "#declare a = 1; #local hidden = 2; #macro A() a+1 #end");
    write(folder / "scene/Parts/B.inc", "#declare b = 7;");
    write(folder / "library/a.inc", "#declare a = 99;");
    write(folder / "library/c.inc", "#include \"a\" #declare c = a+1;");
    write(folder / "secret.inc", "#declare s = 1;");
    InterpreterOptions options;
    options.file = (folder / "scene/x.pov").string();
    options.library = {(folder / "library").string()};
    const auto run = [&](const std::string& text) { return run_script(text, options); };
    CHECK(run("#include \"a\" #debug concat(str(A(),0,0), str(defined(hidden),0,0))").printed == "20");
    CHECK(run("#include \"c.inc\" #debug str(c,0,0)").printed == "2");
    const ScriptResult other_case = run("#include \"parts\\b.INC\" #debug str(b,0,0)");
    CHECK(other_case.printed == "7");
    CHECK(other_case.remarks.find("whose name has other case") != std::string::npos);
    for (const char* name : {"../secret.inc", "../secret", "Parts/../../secret.inc"})
        CHECK(run("#include \"" + std::string(name) + "\"")
                  .error.find("library folders; --library '" + folder.parent_path().string() + "' allows") !=
              std::string::npos);
    CHECK(run("#include \"nothing\"").error.find("cannot find 'nothing' in the scene's folder and in") !=
          std::string::npos);
    // The hint is whole, however long the folder's name is.
    const std::string far = "../a folder's name " + std::string(60, 'x');
    std::filesystem::create_directories(folder / "scene" / far);
    write(folder / "scene" / far / "b.inc", "");
    CHECK(run("#include \"" + far + "/b.inc\"").error.find("folder'\\''s name " + std::string(60, 'x') + "' allows") !=
          std::string::npos);
    options.library = {"/nowhere"};
    CHECK(run("#include \"colors.inc\"").error.find("apt install povray-includes") != std::string::npos);
    write(folder / "scene/self.inc", "#include \"self.inc\"");
    CHECK(run("#include \"self.inc\"").error.find("include each other without an end") != std::string::npos);
}

TEST_CASE("files that a scene reads and writes") {
    const Scratch scratch;
    const std::filesystem::path folder = scratch / "";
    std::filesystem::create_directories(folder / "out");
    write(folder / "data.txt", "1, <2,-3.5>\n\"four\", -5 6");
    InterpreterOptions options;
    options.file = (folder / "x.pov").string();
    const std::string reading =
        "#fopen F \"data.txt\" read #read (F, a, b, c) #while (defined(F)) #read (F, d) #debug concat(str(d,0,0), \" "
        "\") #end "
        "#debug concat(str(a,0,0), vstr(2,b,\",\",0,1), c)";
    CHECK(run_script(reading, options).printed == "-5 6 12.0,-3.5four");
    CHECK(
        run_script("#fopen F \"data.txt\" read #read (F, a, b, c, d, e) #debug str(defined(F),0,0) #fclose F", options)
            .printed == "0");
    const std::string writing = "#fopen F \"y.txt\" write #write (F, \"a\", 1.5, <1,2,3>, 1e10, \"\\n\") #fclose F";
    // Without a folder that is allowed, only the scene itself can read what it writes: what it has written last.
    CHECK(run_script(writing + " #include \"y.txt\"", options).error.find("y.txt:1") != std::string::npos);
    CHECK(run_script("#macro Say(S) #fopen F \"y.inc\" write #write (F, S) #fclose F #include \"y.inc\" #end "
                     "Say(\"#debug \\\"a\\\"\") Say(\"#debug \\\"b\\\"\") "
                     "#fopen F \"data.txt\" append #write (F, 7) #fclose F "
                     "#fopen F \"data.txt\" read #read (F, n) #debug str(n,0,0)",
                     options)
              .printed == "ab7");
    CHECK(!std::filesystem::exists(folder / "y.txt"));
    CHECK(read(folder / "data.txt").front() == '1');
    options.write_folder = (folder / "out").string();
    CHECK(run_script(writing, options).error == "");
    CHECK(read(folder / "out/y.txt") == "a1.5<1,2,3> 1e+10\n");
    for (const char* name : {"../z.txt", "/tmp/z.txt", "..", "a/b"})
        CHECK(run_script("#fopen F \"" + std::string(name) + "\" write", options).error != "");
}

TEST_CASE("random texts end, with a message or without") {
    std::mt19937 random(7);
    const std::vector<std::string> parts{"#declare ",
                                         "#local ",
                                         "a",
                                         "b",
                                         "A",
                                         " = ",
                                         "array[2]",
                                         "{",
                                         "}",
                                         "(",
                                         ")",
                                         "[1]",
                                         ";",
                                         ",",
                                         "1",
                                         "2.5",
                                         "<1,2,3>",
                                         "<",
                                         ">",
                                         "#macro M(a) ",
                                         "#end ",
                                         "M(",
                                         "#if (",
                                         "#else ",
                                         "#while (a<3) ",
                                         "#for (i,1,3) ",
                                         "#switch (a) ",
                                         "#case (1) ",
                                         "#break ",
                                         "+",
                                         "-",
                                         "*",
                                         "/",
                                         "?",
                                         ":",
                                         "&",
                                         "!",
                                         "=",
                                         "<=",
                                         ".x",
                                         ".gray",
                                         "rgb ",
                                         "color ",
                                         "red ",
                                         "function {",
                                         "function(a) {",
                                         "spline {",
                                         "sin(",
                                         "str(a,0,2)",
                                         "concat(",
                                         "\"x\"",
                                         "#debug ",
                                         "#undef ",
                                         "#ifdef (",
                                         "sphere {",
                                         "texture {",
                                         "#include \"a\" ",
                                         "#version 3.5;",
                                         "sum(i,1,3,",
                                         "trace(",
                                         "seed(1)",
                                         "rand(a)",
                                         "vstr(",
                                         "#read (",
                                         "#fopen F \"a\" read ",
                                         "x",
                                         "t",
                                         "#",
                                         "M",
                                         "/*",
                                         "*/",
                                         "\x80",
                                         "\""};
    for (int i = 0; i < 3000; ++i) {
        std::string text = "#declare a = 1; #declare A = array[2] {1,2} #macro M(q) q #end ";
        for (int k = random() % 25; k >= 0; --k) text += parts[random() % parts.size()];
        run_script(text, short_run());
    }
}
