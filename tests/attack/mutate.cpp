// Drives fuzz targets without libFuzzer: mutates seed files. Each input follows from one number.
//
// fuzz_parser [--seconds S] [--seed N] [FILE or FOLDER of seeds ...]
// While it runs, and after a crash, the file fuzz-seed in the working directory holds the number of the input: pass it
// as --seed to reproduce the crash.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Seeds = std::vector<std::string>;

/// A scene with everything in the language, so that mutations reach everything; and pieces to insert anywhere.
const Seeds whole_scenes{
    "camera { position <5.0,-20.0,18.0> look_at <0,0,0> up <0,0,-1> fov 25.0 aspectratio 1.333333 }\n"
    "light { position <-5,0,10> color <.5,.5,.5> }\nbackground { color <.1,.2,.3> }\n"
    "global_settings { ambient_light <1,1,1> max_trace_level 20 assumed_gamma 1 }\n"
    "defaultmaterial { rgb <.5,.5,.5> reflection .5 refraction 0 diffuse .5 ambient 0 specular 1 pow 50 ior 1 }\n"
    "sphere { <0,0,1>, 1 material { rgb <1,0,0> ior 1.5 } rotate <10,20,30> translate <1,2,3> scale 2 }\n"
    "plane { <0,0,0>, <1,0,0>, <0,1,0> }\ncylinder { <0,0,0>, <0,0,1>, .5 scale <1,2,3> /* */ } // end\n"
    "flythrough { duration 12 loop key { time 0 position <9,0,1> look_at <0,0,0> fov 3 }\n"
    "key { time 4 position <0,9,1> look_at <0,0,0> sky <0,0,1> } key { time 12 position <9,0,1> look_at <0,0,0> fov 3 "
    "} }\n",
    "camera { sky <0,1,0> angle 50 look_at <0,0,0> position <0,0,-9> } sphere { <0,0,0> 1 }"};
const Seeds numbers{"0",
                    "-0",
                    "1",
                    "-1",
                    "2",
                    ".5",
                    "-3.25e1",
                    "0.1",
                    "1e-310",
                    "5e-324",
                    "1e-300",
                    "1e-12",
                    "1e15",
                    "-1e15",
                    "9e14",
                    "1e16",
                    "1e308",
                    "1e999",
                    "2.2250738585072014e-308",
                    "45",
                    "89.99999999999999",
                    "90",
                    "180",
                    "360",
                    "0.30000000000000004",
                    "123456789.123456789"};
const Seeds statements{"rotate <90,0,0>",
                       "rotate <1,2,3>",
                       "translate <1,0,0>",
                       "scale 1e-200",
                       "scale 1e200",
                       "scale -1",
                       "scale <1,1,1e-12>",
                       "scale 3",
                       "material { pow 3 }",
                       "sphere { <1,2,3>, 4 }",
                       "sphere { <1,2,3>, 4 scale .5 material { ior 3 refraction 1 } }",
                       "plane { <0,0,0> <1,0,0> <0,0,1> }",
                       "cylinder { <0,0,0> <1,0,0> 1 }",
                       "defaultmaterial { rgb <1,0,0> }",
                       "light { position <0,0,0> color <1,1,1> }",
                       "background { color <1,1,1> }",
                       "key { time 6 position <3,3,3> look_at <1,0,0> }",
                       "loop",
                       "fov 30",
                       "angle 30",
                       "up <0,0,-1>",
                       "sky <1,1,1>",
                       "aspectratio 2",
                       "pow 1",
                       "ior 1.3",
                       "// x",
                       "/* } */"};
const Seeds pieces{"{",
                   "}",
                   "<",
                   ">",
                   ",",
                   "<1,2,3>",
                   "<0,0,0>",
                   "/*",
                   "*/",
                   "//",
                   "\n",
                   "\t",
                   "\r",
                   " ",
                   "camera",
                   "light",
                   "sphere",
                   "plane",
                   "cylinder",
                   "defaultmaterial",
                   "material",
                   "background",
                   "global_settings",
                   "flythrough",
                   "key",
                   "loop",
                   "time",
                   "duration",
                   "position",
                   "look_at",
                   "up",
                   "sky",
                   "fov",
                   "angle",
                   "aspectratio",
                   "color",
                   "rotate",
                   "translate",
                   "scale",
                   "rgb",
                   "pow",
                   "ior",
                   "max_trace_level",
                   "assumed_gamma",
                   "inf",
                   "nan",
                   "0x1",
                   "1e",
                   "\xC3\xA4",
                   "\xF0\x9F\x98\x80",
                   "\xEF\xBB\xBF",
                   "\xFF",
                   std::string(1, '\0'),
                   std::string(300, '{')};

Seeds read_seeds(const std::vector<fs::path>& paths) {
    Seeds seeds = whole_scenes;
    const auto read = [&](const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        std::string text(std::istreambuf_iterator<char>(file), {});
        if (text.size() < 20000) seeds.push_back(std::move(text));
    };
    for (const fs::path& path : paths) {
        if (!fs::is_directory(path)) {
            if (fs::exists(path)) read(path);
            continue;
        }
        for (const auto& entry : fs::recursive_directory_iterator(path))
            if (entry.path().extension() == ".rt") read(entry.path());
    }
    return seeds;
}

class Mutator {
  public:
    Mutator(const Seeds& seeds, std::uint64_t number) : seeds(seeds), random(number) {}

    /// Half of the inputs keep the form of a scene and mostly parse; the others usually do not.
    std::string input() {
        text = any(seeds);
        const bool keep_form = below(2) == 0;
        for (std::size_t i = 1 + below(6); i > 0; --i)
            if (keep_form)
                change_value();
            else
                change_letters();
        return text;
    }

  private:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random() % n); }
    const std::string& any(const Seeds& list) { return list[below(list.size())]; }

    void change_value() {
        const std::size_t at = below(text.size() + 1);
        if (below(4) == 0) {
            const std::size_t brace = text.find('}', at);
            if (brace != text.npos) text.insert(brace + below(2), " " + any(statements) + " ");
            return;
        }
        const std::size_t number = text.find_first_of("-.0123456789", at);
        if (number == text.npos) return;
        const std::size_t end = std::min(text.size(), text.find_first_not_of("0123456789.e-+", number));
        text.replace(number, end - number, any(numbers));
    }
    void change_letters() {
        const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 20) + 1);
        switch (below(7)) {
            case 0:
                text.insert(at, " " + any(pieces) + " ");
                break;
            case 1:
                text.replace(at, length, any(pieces));
                break;
            case 2:
                text.erase(at, length);
                break;
            case 3:
                text.insert(at, text.substr(below(text.size() + 1), below(200)));
                break;
            case 4:
                if (at < text.size()) text[at] = static_cast<char>(random());
                break;
            case 5:
                text.resize(at);
                break;
            default:
                change_value();
        }
    }

    const Seeds& seeds;
    std::mt19937_64 random;
    std::string text;
};

}  // namespace

int main(int count, char** arguments) {
    double seconds = 5;
    std::uint64_t number = 1;
    std::vector<fs::path> paths;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(arguments[i], "--seconds") == 0 && i + 1 < count)
            seconds = std::stod(arguments[++i]);
        else if (std::strcmp(arguments[i], "--seed") == 0 && i + 1 < count)
            number = std::stoull(arguments[++i]);
        else
            paths.emplace_back(arguments[i]);
    }
    const Seeds seeds = read_seeds(paths);
    std::FILE* const progress = std::fopen("fuzz-seed", "w");
    if (!progress) return std::perror("fuzz-seed"), 1;
    const std::uint64_t first = number;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (; std::chrono::steady_clock::now() < end; ++number) {
        const std::string input = Mutator(seeds, number).input();
        std::rewind(progress);
        std::fprintf(progress, "%llu\n", static_cast<unsigned long long>(number));
        std::fflush(progress);
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    }
    std::fclose(progress);
    std::remove("fuzz-seed");
    std::printf("%llu inputs, --seed %llu to %llu\n", static_cast<unsigned long long>(number - first),
                static_cast<unsigned long long>(first), static_cast<unsigned long long>(number - 1));
}
