// A driver for fuzz targets where there is no libFuzzer: seeds are mutated, inputs follow from a number alone.
//
// fuzz_parser [--seconds S] [--seed N] [FILE or FOLDER of seeds ...]
// While it runs, and after a crash, the file fuzz-seed in the working directory holds the number of the input: give it
// as --seed to get the crash again at once.
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

/// One scene of all there is, so that mutations reach everything; and pieces, to be put in anywhere.
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
const Seeds pieces{"{",
                   "}",
                   "<",
                   ">",
                   ",",
                   "<1,2,3>",
                   "<0,0,0>",
                   "<1e15,-1e15,0>",
                   "0",
                   "-0",
                   "1",
                   "-1",
                   "1e-310",
                   "1e15",
                   "1e308",
                   "1e999",
                   ".5",
                   "5e-324",
                   "2.2250738585072014e-308",
                   "90",
                   "89.99999999999999",
                   "180",
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
                   "time 4",
                   "duration 12",
                   "position",
                   "look_at",
                   "up",
                   "sky",
                   "fov",
                   "angle",
                   "aspectratio",
                   "color",
                   "rotate <90,0,0>",
                   "translate <1,0,0>",
                   "scale 1e-200",
                   "scale 1e200",
                   "scale -1",
                   "scale <1,1,1e-12>",
                   "rgb",
                   "pow",
                   "ior",
                   "max_trace_level 256",
                   "assumed_gamma",
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

std::string mutated(const Seeds& seeds, std::uint64_t number) {
    std::mt19937_64 random(number);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    std::string text = seeds[below(seeds.size())];
    for (std::size_t i = 1 + below(6); i > 0; --i) {
        const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 20) + 1);
        const std::string& piece = pieces[below(pieces.size())];
        switch (below(7)) {
            case 0:
                text.insert(at, " " + piece + " ");
                break;
            case 1:
                text.replace(at, length, piece);
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
            default: {  // a number becomes another
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit == text.npos) break;
                const std::size_t end = text.find_first_not_of("0123456789.e-+", digit);
                text.replace(digit, (end == text.npos ? text.size() : end) - digit, pieces[8 + below(14)]);
            }
        }
    }
    return text;
}

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
        const std::string input = mutated(seeds, number);
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
