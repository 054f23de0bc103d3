// The structure of the source tree: which module may include which, where each library is used, and that the linker
// can't confuse the kernels of different SIMD levels.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Includes point one way: num <- scene <- mesh <- {text, import, trace, image, povref} <- show <- main. Of the five in
/// braces, text (whole files out, scene text) serves import and image, and text, trace and image serve povref, which
/// compares their pictures.
const std::map<std::string, std::set<std::string>> modules{
    {"num", {}},
    {"scene", {"num"}},
    {"mesh", {"num", "scene"}},
    {"text", {"num", "scene", "mesh"}},
    {"trace", {"num", "scene"}},
    {"import", {"num", "scene", "mesh", "text"}},
    {"image", {"num", "scene", "text"}},
    {"povref", {"num", "scene", "text", "trace", "image"}},
    {"show", {"num", "scene", "text", "trace", "image"}},
    {"main", {"num", "scene", "text", "import", "trace", "image", "povref", "show"}},
};
/// Headers of libraries, and the only module that may include them.
const std::vector<std::pair<std::regex, std::string>> libraries{
    {std::regex("OpenImageIO/.*|zlib\\.h"), "image"},
    {std::regex("(GLFW|GL|GLES[0-9]*|EGL|AL|vorbis)/.*|imgui.*"), "show"},
    {std::regex("CLI(11)?/.*"), "main"},
    {std::regex("[a-z0-9]*intrin\\.h|arm_neon\\.h|experimental/simd"), "num"},
};

/// Why this line is not allowed in a file of `module`, or "".
std::string fault(const std::string& module, const std::string& line) {
    static const std::regex include(R"re(\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
    std::smatch match;
    if (!std::regex_match(line, match, include)) return "";
    const std::string path = match[2], first = path.substr(0, path.find('/'));
    for (const auto& [pattern, home] : libraries)
        if (std::regex_match(path, pattern) && module != home)
            return module + " includes " + path + ", which is for " + home;
    if (match[1] == "<" || first == module) return "";
    if (!modules.contains(first))
        return module + " includes \"" + path + "\": name the module, as in \"scene/scene.h\"";
    return modules.at(module).contains(first) ? "" : module + " includes " + path + ": this arrow points the wrong way";
}

std::vector<fs::path> files_under(const fs::path& folder, const std::regex& name) {
    std::vector<fs::path> files;
    if (!fs::exists(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied))
        if (entry.is_regular_file() && std::regex_match(entry.path().string(), name)) files.push_back(entry.path());
    return files;
}

/// The functions that an object file exports to the linker.
std::vector<std::string> functions_of(const fs::path& object) {
    std::vector<std::string> names;
    std::FILE* pipe = popen(("nm --defined-only --extern-only '" + object.string() + "'").c_str(), "r");
    REQUIRE(pipe);
    std::string text;
    char buffer[4096];
    while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, got);
    REQUIRE(pclose(pipe) == 0);
    std::istringstream lines(text);
    std::string address, type, symbol;
    while (lines >> address >> type >> symbol)
        if (type == "T" || type == "W" || type == "i") names.push_back(symbol);
    return names;
}
/// Is this mangled name inside the namespace of this level?
bool own(const std::string& symbol, const std::string& level) {
    return symbol.find(std::to_string(level.size()) + level) != std::string::npos;
}

}  // namespace

TEST_CASE("the include rules reject wrong includes") {
    CHECK(fault("scene", "#include \"trace/tracer.h\"") != "");
    CHECK(fault("trace", "#include \"text/parse.h\"") != "");
    CHECK(fault("text", "#include \"image/picture.h\"") != "");
    CHECK(fault("text", "#include \"import/import.h\"") != "");
    CHECK(fault("mesh", "#include \"text/parse.h\"") != "");
    CHECK(fault("show", " # include \"main/values.h\"  // why") != "");
    CHECK(fault("main", "#include <OpenImageIO/imageio.h>") != "");
    CHECK(fault("main", "#include <GLFW/glfw3.h>") != "");
    CHECK(fault("trace", "#include <immintrin.h>") != "");
    CHECK(fault("trace", "#include \"world.h\"") != "");
    CHECK(fault("trace", "#include \"scene/scene.h\"") == "");
    CHECK(fault("trace", "#include \"trace/world.h\"") == "");
    CHECK(fault("trace", "#include <arm_neon.h>") != "");
    CHECK(fault("num", "#include <immintrin.h>") == "");
    CHECK(fault("num", "a line that speaks of #include \"trace/world.h\"") == "");
}

TEST_CASE("includes point one way, and libraries stay in their modules") {
    const std::regex source(R"(.*\.(h|cpp))");
    int seen = 0;
    for (const auto& [module, allowed] : modules) {
        const fs::path folder = fs::path(STRAHL_SOURCE) / (module == "povref" ? module : "src/" + module);
        for (const fs::path& file : files_under(folder, source)) {
            std::ifstream in(file);
            std::string line;
            for (int number = 1; std::getline(in, line); ++number) {
                const std::string wrong = fault(module, line);
                if (!wrong.empty()) FAIL_CHECK(file.string() << ":" << number << ": " << wrong);
            }
            ++seen;
        }
    }
    CHECK(seen > 20);
}

// If two levels exported a function of the same name, the linker would keep one, and an older processor could be given
// instructions that it lacks.
TEST_CASE("the functions of a kernel are in the namespace of its SIMD level") {
    CHECK(own("_ZN6strahl2v34spanEv", "v3"));
    CHECK(!own("_ZN6strahl2v34spanEv", "v4"));
    CHECK(!own("_ZSt4sqrtf", "v3"));
    int objects = 0;
    for (const std::string level : {"scalar", "v2", "v3", "v4", "neon"}) {
        const std::regex name(".*/kernel[a-z_]*_" + level + R"([./].*\.o)");
        for (const fs::path& object : files_under(STRAHL_BINARY, name)) {
            ++objects;
            const std::vector<std::string> functions = functions_of(object);
            CHECK(!functions.empty());
            for (const std::string& symbol : functions)
                if (!own(symbol, level)) FAIL_CHECK(object.string() << " offers " << symbol);
        }
    }
#if defined(__x86_64__) && !defined(__clang__)
    CHECK(objects >= 4);
#else
    CHECK(objects >= 2);
#endif
}
