// Methods of intersection side by side: nanoseconds per ray and errors, as a table in Markdown.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

#include "tests/bench/methods/inputs.h"
#include "trace/tracer.h"

namespace strahl::bench {
namespace {

constexpr std::size_t rays_timed = 256, rays_judged = 20000 / 16 * 16;

/// The shortest of a fifth of a second's runs: what other programs take is not counted.
template <class T>
double nanoseconds(const Method<T>& method) {
    const Rays<T> rays = rays_for<T>(method.group, "easy", rays_timed);
    Answers<T> answers(rays_timed);
    double least = std::numeric_limits<double>::infinity();
    const auto begin = std::chrono::steady_clock::now();
    for (auto start = begin; start - begin < std::chrono::milliseconds(200);) {
        for (int k = 0; k < 4; ++k) method.run(rays, answers);
        const auto end = std::chrono::steady_clock::now();
        least = std::min(least, std::chrono::duration<double, std::nano>(end - start).count() / (4 * rays_timed));
        start = end;
    }
    return least;
}
std::string digits(double v, int n) {
    std::ostringstream text;
    if (v >= 10 && v < 1000)
        text << std::lround(v);
    else
        text.precision(n), text << v;
    std::string result = text.str();
    for (const char* clumsy : {"e+0", "e+", "e-0"})
        if (const std::size_t at = result.find(clumsy); at != result.npos)
            result.replace(at, std::string(clumsy).size(), clumsy[1] == '-' ? "e-" : "e");
    return result;
}

/// One line of the table for each method, its lists of equal methods one per width of lanes.
template <class T>
void compare(const char* precision, const std::vector<std::vector<Method<T>>>& levels) {
    std::ostream& table = std::cout;
    for (std::size_t m = 0; m < levels[0].size(); ++m) {
        const Method<T>& method = levels[0][m];
        table << "| " << method.group << " | " << (method.engine ? "**" : "") << method.name
              << (method.engine ? "**" : "") << " | " << precision << " |";
        for (std::size_t level = 0; level < 3; ++level)
            table << (level < levels.size() ? ' ' + digits(nanoseconds(levels[level][m]), 2) : "") << " |";
        for (const char* input : inputs) {
            const Rays<T> rays = rays_for<T>(method.group, input, rays_judged);
            Answers<T> answers(rays_judged);
            method.run(rays, answers);
            const Wrong wrong = judge(method.group, rays, answers);
            // Half an ulp is the best there is: ulps of the precision itself.
            const double ulp = static_cast<double>(std::numeric_limits<T>::epsilon());
            const bool box = std::string(method.group) == "box";
            table << ' ';
            if (wrong.answers > 0 || box) table << digits(100 * wrong.answers, 2) << " %";
            if (!box) table << (wrong.answers > 0 ? ", " : "") << digits(wrong.t / ulp, 2);
            if (!box && std::string(method.group) != "start") table << ", " << digits(wrong.surface, 1);
            table << " |";
        }
        table << std::endl;
    }
}

}  // namespace
}  // namespace strahl::bench

int main() {
    using namespace strahl;
    using namespace strahl::bench;
    std::cout << "| | method | numbers | 1 lane | 8 / 4 | 16 / 8 |";
    for (const char* input : inputs) std::cout << ' ' << input << " |";
    std::cout << "\n|---|---|---|--:|--:|--:|---|---|---|---|---|---|\n";
    std::vector<std::vector<Method<float>>> single{scalar::methods_float()};
    std::vector<std::vector<Method<double>>> twice{scalar::methods_double()};
    if (supported(Simd::v3)) single.push_back(v3::methods_float()), twice.push_back(v3::methods_double());
    if (supported(Simd::v4)) single.push_back(v4::methods_float()), twice.push_back(v4::methods_double());
    compare<float>("float", single);
    compare<double>("double", twice);
    compare<long double>("long double", {scalar::methods_extended()});
}
