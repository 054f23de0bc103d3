// The structure of the source tree: which module may include which, where each library is used, and that the linker
// cannot confuse the kernels of different SIMD levels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A module: which others its files may include, and its rooms. A room is a folder of the module; its files include
/// files of rooms that stand before it in this list, never of later ones. "" stands for the module's own files.
struct Module {
    std::set<std::string> below;
    std::vector<std::string> rooms{""};
};
const std::map<std::string, Module> modules{
    {"files", {{}, {"os", ""}}},
    {"num", {{"files"}}},
    {"scene", {{"files", "num"}, {"kinds", "motion", "solid", ""}}},
    {"mesh", {{"num", "scene", "files"}}},
    {"text", {{"num", "scene", "files", "mesh"}, {"reading", "blocks", "manual", ""}}},
    {"trace",
     {{"files", "num", "scene"},
      {"hierarchy", "world", "patterns", "finish", "forms", "lights", "kernel", "proof", "cells", "", "measure"}}},
    {"import", {{"num", "scene", "files", "mesh", "text"}, {"models", ""}}},
    {"pov", {{"num", "scene", "files", "mesh", "text", "import"}, {"language", "things", "reading", "meaning", ""}}},
    {"image", {{"num", "scene", "files", "text"}, {"", "oiio"}}},
    {"povref", {{"num", "scene", "files", "text", "trace", "image"}, {"convert", "compare"}}},
    {"show",
     {{"num", "scene", "files", "text", "import", "pov", "trace", "image", "povref"},
      {"keys", "session", "motion", "work", "second", "timeline", "panels", "window", "welcome", ""}}},
    {"main",
     {{"num", "scene", "files", "text", "import", "pov", "trace", "image", "povref", "show"},
      {"process", "reference", "render", "lsp", "commands", "options", ""}}},
};
/// Headers of libraries and of the system, and the only modules or rooms that may include them.
const std::vector<std::pair<std::regex, std::vector<std::string>>> libraries{
    {std::regex("OpenImageIO/.*|(zlib|png|turbojpeg)\\.h"), {"image"}},
    {std::regex("(GLFW|GL|GLES[0-9]*|EGL|AL|vorbis)/.*|imgui.*"), {"show"}},
    {std::regex("CLI(11)?/.*"), {"main"}},
    {std::regex("nlohmann/.*"), {"main", "import", "show"}},
    {std::regex("[a-z0-9]*intrin\\.h|arm_neon\\.h"), {"num"}},
    {std::regex(
         "(sys|linux|netinet|arpa)/.*|c?signal(\\.h)?|(unistd|fcntl|spawn|poll|dirent|ftw|malloc|link|dlfcn|pthread|"
         "windows|winsock2|commdlg|io)\\.h"),
     {"files/os"}},
};

/// The room of a file, from its path below the folder of modules: "kernel" of trace/kernel/shade.h, "" of
/// trace/tracer.h.
std::string room_of(const std::string& path) {
    const std::size_t first = path.find('/') + 1, second = path.find('/', first);
    return second == std::string::npos ? "" : path.substr(first, second - first);
}
std::string module_of(const std::string& path) { return path.substr(0, path.find('/')); }

/// Returns the path that a line includes, and whether it is in quotes; nothing for other lines.
struct Include {
    std::string path;
    bool quoted;
};
std::optional<Include> include_in(const std::string& line) {
    static const std::regex include(R"re(\s*#\s*include\s*([<"])([^>"]+)[>"].*)re");
    std::smatch match;
    if (!std::regex_match(line, match, include)) return {};
    return Include{match[2], match[1] == "\""};
}

/// Why this line is not allowed in the file, or "".
std::string fault(const std::string& file, const std::string& line) {
    static const std::regex system("\\s*#\\s*(el)?if.*(__linux__|__GLIBC__|__unix__|__APPLE__|_WIN32).*");
    if (std::regex_match(line, system) && !file.starts_with("files/os/"))
        return file + " asks for the system, which is for files/os";
    const auto include = include_in(line);
    if (!include) return "";
    const std::string module = module_of(file), &path = include->path, first = module_of(path);
    for (const auto& [pattern, homes] : libraries)
        if (std::regex_match(path, pattern) &&
            std::ranges::none_of(homes, [&](const std::string& home) { return file.starts_with(home + "/"); }))
            return file + " includes " + path + ", which is for " + homes[0];
    if (!include->quoted) return "";
    if (first == module) {
        if (path == "main/licence.h") return "";  // generated
        const auto& rooms = modules.at(module).rooms;
        const auto from = std::ranges::find(rooms, room_of(file)), to = std::ranges::find(rooms, room_of(path));
        if (from == rooms.end()) return file + " is in no room of " + module;
        if (to == rooms.end()) return path + " is in no room of " + module;
        return to <= from ? "" : file + " includes " + path + ": this arrow points to a later room";
    }
    if (!modules.contains(first))
        return module + " includes \"" + path + "\": name the module, as in \"scene/scene.h\"";
    return modules.at(module).below.contains(first)
               ? ""
               : module + " includes " + path + ": this arrow points the wrong way";
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
    CHECK(fault("scene/scene.h", "#include \"trace/tracer.h\"") != "");
    CHECK(fault("trace/tracer.h", "#include \"text/parse.h\"") != "");
    CHECK(fault("text/parse.h", "#include \"image/picture.h\"") != "");
    CHECK(fault("text/parse.h", "#include \"import/import.h\"") != "");
    CHECK(fault("mesh/join.h", "#include \"text/parse.h\"") != "");
    CHECK(fault("show/viewer.h", " # include \"main/render/values.h\"  // why") != "");
    CHECK(fault("main/main.cpp", "#include <OpenImageIO/imageio.h>") != "");
    CHECK(fault("main/main.cpp", "#include <GLFW/glfw3.h>") != "");
    CHECK(fault("trace/tracer.h", "#include <immintrin.h>") != "");
    CHECK(fault("trace/tracer.h", "#include \"world.h\"") != "");
    CHECK(fault("trace/tracer.h", "#include \"scene/scene.h\"") == "");
    CHECK(fault("trace/tracer.h", "#include \"trace/world/world.h\"") == "");
    CHECK(fault("trace/tracer.h", "#include <arm_neon.h>") != "");
    CHECK(fault("num/pack.h", "#include <immintrin.h>") == "");
    CHECK(fault("files/read_file.cpp", "#include <unistd.h>") != "");
    CHECK(fault("files/os/file.cpp", "#include <unistd.h>") == "");
    CHECK(fault("num/buffer.h", "#if defined(__linux__)") != "");
    CHECK(fault("files/os/memory.cpp", "#ifdef __GLIBC__") == "");
    CHECK(fault("num/pack.h", "a line that speaks of #include \"trace/world/world.h\"") == "");
    CHECK(fault("trace/world/world.h", "#include \"trace/hierarchy/hierarchy.h\"") == "");
    CHECK(fault("trace/hierarchy/hierarchy.h", "#include \"trace/world/world.h\"") != "");
    CHECK(fault("trace/kernel/shade.h", "#include \"trace/proof/hit_bounds.h\"") != "");
    CHECK(fault("trace/cells/cells.h", "#include \"trace/tracer.h\"") != "");
    CHECK(fault("trace/measure/edge_pixels.h", "#include \"trace/tracer.h\"") == "");
    CHECK(fault("trace/attic/box.h", "#include \"trace/tracer.h\"") != "");
}

/// The source files of the project's modules, by their paths below the folder of modules.
std::map<std::string, fs::path> module_files() {
    const std::regex source(R"(.*\.(h|cpp))");
    std::map<std::string, fs::path> files;
    for (const auto& [module, own] : modules) {
        const fs::path parent = fs::path(STRAHL_SOURCE) / (module == "povref" ? "" : "src");
        for (const fs::path& file : files_under(parent / module, source))
            files[fs::relative(file, parent).generic_string()] = file;
    }
    return files;
}

TEST_CASE("includes point one way, and libraries stay in their modules") {
    std::map<std::string, std::map<std::string, int>> arrows;  // between rooms of trace: how many includes
    const auto files = module_files();
    CHECK(files.size() > 400);
    for (const auto& [file, path] : files) {
        std::ifstream in(path);
        std::string line;
        for (int number = 1; std::getline(in, line); ++number) {
            const std::string wrong = fault(file, line);
            if (!wrong.empty()) FAIL_CHECK(path.string() << ":" << number << ": " << wrong);
            const auto include = include_in(line);
            if (include && include->quoted && module_of(file) == "trace" && module_of(include->path) == "trace" &&
                room_of(file) != room_of(include->path))
                ++arrows[room_of(file)][room_of(include->path)];
        }
    }
    std::printf("The rooms of src/trace, and how many includes point from each to those before it:\n");
    for (const std::string& room : modules.at("trace").rooms) {
        std::printf("  %-10s", room.empty() ? "(trace)" : room.c_str());
        for (const auto& [to, count] : arrows[room]) std::printf(" %s %d", to.empty() ? "(trace)" : to.c_str(), count);
        std::printf("\n");
    }
}

TEST_CASE("no header includes itself, by others") {
    std::map<std::string, std::vector<std::string>> includes;
    for (const auto& [file, path] : module_files()) {
        std::ifstream in(path);
        for (std::string line; std::getline(in, line);)
            if (const auto include = include_in(line); include && include->quoted)
                includes[file].push_back(include->path);
    }
    enum class State { open, done };
    std::map<std::string, State> seen;
    const std::function<void(const std::string&)> visit = [&](const std::string& file) {
        const auto [entry, first] = seen.emplace(file, State::open);
        if (!first) {
            CHECK_MESSAGE(entry->second == State::done, file << " is part of a circle");
            return;
        }
        for (const std::string& next : includes[file]) visit(next);
        seen[file] = State::done;
    };
    for (const auto& [file, path] : module_files()) visit(file);
}

/// The name of the type that this line defines, or "". Specialisations have the name of their template.
std::string type_defined_in(const std::string& line) {
    static const std::regex definition(
        R"(\s*(?:template ?<.*> )?(?:struct|class|union|enum(?: class)?) (\w+)(?: final)?(?: ?: [^;]*)?(?: \{.*)?)");
    std::smatch match;
    return std::regex_match(line, match, definition) ? match[1].str() : "";
}

/// Names of several types, which no file sees together, and what these are.
const std::map<std::string, std::string> names_of_several_types{
    {"Band", "rows of a picture file; directions of a light buffer"},
    {"Entry", "of the stacks of two walks through the hierarchy, local to these functions"},
    {"Place", "near a cone and near a torus, members of like structs"},
    {"Widening", "of both policies of kernels, whose members have the same names"},
};

TEST_CASE("one word, one meaning: no two types share a name") {
    CHECK(type_defined_in("struct Box {") == "Box");
    CHECK(type_defined_in("    enum class Writer { own, other_program };") == "Writer");
    CHECK(type_defined_in("template <class T> class Pack : Base<T> {") == "Pack");
    CHECK(type_defined_in("class World;") == "");
    CHECK(type_defined_in("struct Pair<int, int> {") == "");
    std::map<std::string, std::vector<std::string>> places;
    for (const auto& [file, path] : module_files()) {
        std::ifstream in(path);
        std::string line;
        for (int number = 1; std::getline(in, line); ++number)
            if (const std::string name = type_defined_in(line); !name.empty())
                places[name].push_back(file + ":" + std::to_string(number));
    }
    CHECK(places.size() > 300);
    for (const auto& [name, found] : places) {
        std::string list;
        for (const std::string& place : found) list += "\n" + place;
        const bool allowed = names_of_several_types.contains(name);
        if (!allowed) CHECK_MESSAGE(found.size() == 1, "several types are called " << name << ":" << list);
    }
}

bool has_word(const std::string& text, const std::string& word) {
    const auto part_of_word = [&](std::size_t i) {
        return i < text.size() && (std::isalnum(text[i]) || text[i] == '_');
    };
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (!part_of_word(at - 1) && !part_of_word(at + word.size())) return true;
    return false;
}

std::string text_of(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(STRAHL_SOURCE "/" + file).rdbuf();
    return text.str();
}

// The drawing leaves out arrows to what is reached along others.
TEST_CASE("the drawing of the modules has the includes that are allowed") {
    const std::string page = text_of("src/architecture.md");
    const std::regex arrow(" +([a-z]+) --> ([a-z]+)\n");
    std::map<std::string, std::set<std::string>> drawn;
    for (std::sregex_iterator at(page.begin(), page.end(), arrow), end; at != end; ++at) {
        const std::string from = (*at)[1], to = (*at)[2];
        REQUIRE_MESSAGE(modules.contains(from), from << " is drawn and is no module");
        CHECK_MESSAGE(modules.at(from).below.contains(to), "drawn but not allowed: " << from << " to " << to);
        drawn[from].insert(to);
    }
    const std::function<bool(const std::string&, const std::string&)> reaches = [&](const auto& from, const auto& to) {
        return std::ranges::any_of(drawn[from], [&](const auto& next) { return next == to || reaches(next, to); });
    };
    for (const auto& [module, allowed] : modules)
        for (const std::string& below : allowed.below)
            CHECK_MESSAGE(reaches(module, below), "allowed but not drawn: " << module << " to " << below);
}

TEST_CASE("the page on the source names only what there is") {
    std::string code;
    std::set<std::string> files;
    for (const auto& [file, path] : module_files()) {
        files.insert(path.filename().string());
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        code += text.str();
    }
    const std::string page = text_of("src/README.md") + text_of("src/architecture.md");
    const std::regex quoted("`([^`\n]+)`"), name("[A-Za-z_]\\w*"), own("[A-Za-z_/]+\\.(h|cpp|cmake)");
    int names = 0;
    for (std::sregex_iterator at(page.begin(), page.end(), quoted), end; at != end; ++at) {
        const std::string word = (*at)[1];
        if (std::regex_match(word, own)) {
            const auto is = [&](const char* folder) { return fs::exists(fs::path(STRAHL_SOURCE) / folder / word); };
            if (word.find("NAME") != word.npos || word.starts_with("X")) continue;
            ++names;
            CHECK_MESSAGE((files.contains(word) || is("") || is("src")),
                          "a page names the file " << word << ", which is not there");
        } else if (std::regex_match(word, name) || word.ends_with("()")) {
            ++names;
            CHECK_MESSAGE(has_word(code, word.substr(0, word.find('('))),
                          "a page speaks of " << word << ", which is not there");
        }
    }
    CHECK(names > 40);
}

/// The names that a header uses, and the headers that it includes.
struct Header {
    std::vector<std::string> own;    // project files that it includes
    std::set<std::string> standard;  // headers of libraries that it includes
    std::set<std::string> from_std;  // names that it takes from std
    std::set<std::string> words, declared;
};
Header header_of(std::istream& in) {
    static const std::set<std::string> declaring{"class", "struct", "union", "enum", "using", "typename"};
    Header header;
    for (std::string line, last; std::getline(in, line);) {
        if (const auto include = include_in(line)) {
            if (include->quoted)
                header.own.push_back(include->path);
            else
                header.standard.insert(include->path);
            continue;
        }
        for (std::size_t at = 0; at < line.size() && line.compare(at, 2, "//") != 0;) {
            std::size_t end = at;
            while (end < line.size() && (std::isalnum(static_cast<unsigned char>(line[end])) || line[end] == '_'))
                ++end;
            if (end == at) {
                if (line[at++] == '"')
                    while (at < line.size() && line[at++] != '"') at += line[at - 1] == '\\';
                continue;
            }
            const std::string word = line.substr(at, end - at);
            header.words.insert(word);
            if (declaring.contains(last)) header.declared.insert(word);
            if (at >= 5 && line.compare(at - 5, 5, "std::") == 0) header.from_std.insert(word);
            last = word, at = end;
        }
    }
    return header;
}

/// Standard headers, and names for which they must be included. A name that several headers have is not listed.
const std::map<std::string, std::set<std::string>> names_in_standard_headers{
    {"algorithm", {"clamp", "sort"}},
    {"array", {"array"}},
    {"atomic", {"atomic"}},
    {"bit", {"bit_cast", "countr_zero", "popcount"}},
    {"chrono", {"chrono"}},
    {"cmath", {"floor", "isfinite", "sqrt"}},
    {"condition_variable", {"condition_variable"}},
    {"cstdint", {"int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t"}},
    {"filesystem", {"filesystem"}},
    {"functional", {"function"}},
    {"limits", {"numeric_limits"}},
    {"map", {"map"}},
    {"memory", {"make_shared", "make_unique", "shared_ptr", "unique_ptr"}},
    {"mutex", {"lock_guard", "mutex", "unique_lock"}},
    {"numbers", {"numbers"}},
    {"optional", {"optional"}},
    {"random", {"mt19937", "mt19937_64"}},
    {"set", {"set"}},
    {"span", {"span"}},
    {"stdexcept", {"runtime_error"}},
    {"string", {"string", "to_string"}},
    {"thread", {"jthread", "thread"}},
    {"tuple", {"tie", "tuple"}},
    {"variant", {"variant", "visit"}},
    {"vector", {"vector"}},
};

/// Lists what headers use without an include of their own or of a header that they include: names of std, and types
/// that another header defines. `types` are the headers that define each type.
std::vector<std::string> lacking_includes(const std::map<std::string, Header>& headers,
                                          const std::map<std::string, std::string>& types) {
    std::vector<std::string> lacking;
    for (const auto& [file, header] : headers) {
        std::set<std::string> standard, declared, seen;
        const std::function<void(const std::string&)> visit = [&](const std::string& path) {
            const auto found = headers.find(path);
            if (found == headers.end() || !seen.insert(path).second) return;
            standard.insert(found->second.standard.begin(), found->second.standard.end());
            declared.insert(found->second.declared.begin(), found->second.declared.end());
            for (const std::string& next : found->second.own) visit(next);
        };
        visit(file);
        for (const auto& [include, names] : names_in_standard_headers)
            for (const std::string& name : names)
                if (header.from_std.contains(name) && !standard.contains(include))
                    lacking.push_back(file + " uses std::" + name + " without <" + include + ">");
        for (const auto& [type, home] : types)
            if (header.words.contains(type) && !declared.contains(type))
                lacking.push_back(file + " uses " + type + " without \"" + home + "\"");
    }
    return lacking;
}

// .ci/headers compiles each header alone, which takes minutes; this sees most of what that would find.
TEST_CASE("every header includes what it uses") {
    const auto of = [](const std::string& text) {
        std::istringstream in(text);
        return header_of(in);
    };
    const std::map<std::string, std::string> types{{"Box", "box.h"}};
    const Header box = of("#include <vector>\nstruct Box { std::vector<int> sides; };  // std::optional\n");
    CHECK(
        lacking_includes({{"box.h", box}, {"a.h", of("#include \"box.h\"\nstd::vector<Box> a(\"std::map\");")}}, types)
            .empty());
    CHECK(lacking_includes({{"box.h", box}, {"a.h", of("class Box;\nvoid f(Box&);")}}, types).empty());
    CHECK(lacking_includes({{"box.h", box}, {"a.h", of("void f(Box&);")}}, types).size() == 1);
    CHECK(lacking_includes({{"box.h", of("struct Box { std::optional<int> side; };")}}, types).size() == 1);

    std::map<std::string, Header> headers;
    std::map<std::string, std::string> defined;
    for (const auto& [file, path] : module_files()) {
        if (path.extension() != ".h") continue;
        std::ifstream in(path);
        headers[file] = header_of(in);
        in.clear(), in.seekg(0);
        for (std::string line; std::getline(in, line);)
            if (const std::string name = type_defined_in(line); !name.empty() && line[0] != ' ') defined[name] = file;
    }
    CHECK(headers.size() > 200);
    CHECK(defined.size() > 200);
    for (const std::string& text : lacking_includes(headers, defined)) FAIL_CHECK(text);
}

TEST_CASE("a folder of sources or tests has at most 30 files, and their lines have at most 120 characters") {
    std::map<fs::path, int> count;
    for (const char* top : {"src", "povref", "tests"})
        for (const fs::path& file : files_under(fs::path(STRAHL_SOURCE) / top, std::regex(".*"))) {
            if (file.string().find("/povref/reference/") == std::string::npos) ++count[file.parent_path()];
            if (file.extension() != ".h" && file.extension() != ".cpp") continue;
            std::ifstream lines(file);
            for (std::string line; std::getline(lines, line);)
                if (line.size() > 120) FAIL_CHECK(file.string() << " has a long line: " << line);
        }
    for (const auto& [folder, files] : count) CHECK_MESSAGE(files <= 30, folder.string());
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
