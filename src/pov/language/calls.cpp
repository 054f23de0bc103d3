// The built-in functions and constants of expressions.
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <string_view>

#include "files/words.h"
#include "pov/language/interpreter.h"
#include "pov/language/maths.h"

namespace strahl::pov {
namespace {

/// A C cast to a 32-bit integer, of numbers out of its range the least.
double cut_off(double value) {
    if (!(value > -2147483649. && value < 2147483648.)) return -2147483648.;
    return static_cast<double>(static_cast<std::int32_t>(value));
}

double length(const DVec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// The rows of a matrix; a point is a row, to the left of it.
using Rows = std::array<DVec3, 3>;
DVec3 times(const DVec3& p, const Rows& m) { return p.x * m[0] + p.y * m[1] + p.z * m[2]; }

/// Rotation about the axes x, y and z in this order, by angles in degrees.
Rows rotation(const DVec3& degrees) {
    const DVec3 angle = degrees * (std::numbers::pi / 180);
    const DVec3 c{std::cos(angle.x), std::cos(angle.y), std::cos(angle.z)};
    const DVec3 s{std::sin(angle.x), std::sin(angle.y), std::sin(angle.z)};
    const Rows about_y{DVec3{c.y, 0, -s.y}, DVec3{0, 1, 0}, DVec3{s.y, 0, c.y}};
    const Rows about_z{DVec3{c.z, s.z, 0}, DVec3{-s.z, c.z, 0}, DVec3{0, 0, 1}};
    Rows rows{DVec3{1, 0, 0}, DVec3{0, c.x, s.x}, DVec3{0, -s.x, c.x}};
    for (DVec3& row : rows) row = times(times(row, about_y), about_z);
    return rows;
}

/// Rotation about an axis through the origin. The formula of O. Rodrigues.
Rows rotation(DVec3 a, double degrees) {
    a /= length(a);
    const double angle = degrees * (std::numbers::pi / 180), c = std::cos(angle), s = std::sin(angle), r = 1 - c;
    return {DVec3{a.x * a.x + c * (1 - a.x * a.x), a.x * a.y * r + a.z * s, a.x * a.z * r - a.y * s},
            DVec3{a.x * a.y * r - a.z * s, a.y * a.y + c * (1 - a.y * a.y), a.y * a.z * r + a.x * s},
            DVec3{a.x * a.z * r + a.y * s, a.y * a.z * r - a.x * s, a.z * a.z + c * (1 - a.z * a.z)}};
}

/// The words besides those of maths.h with which an expression may begin.
constexpr std::string_view function_words[]{"asc",
                                            "bitwise_and",
                                            "bitwise_or",
                                            "bitwise_xor",
                                            "clock",
                                            "clock_on",
                                            "defined",
                                            "dimension_size",
                                            "dimensions",
                                            "false",
                                            "file_exists",
                                            "inside",
                                            "max_extent",
                                            "min_extent",
                                            "no",
                                            "now",
                                            "off",
                                            "on",
                                            "pi",
                                            "rand",
                                            "seed",
                                            "select",
                                            "strcmp",
                                            "strlen",
                                            "t",
                                            "trace",
                                            "true",
                                            "u",
                                            "v",
                                            "val",
                                            "vaxis_rotate",
                                            "vcross",
                                            "vdot",
                                            "version",
                                            "vlength",
                                            "vnormalize",
                                            "vrotate",
                                            "vturbulence",
                                            "x",
                                            "y",
                                            "yes",
                                            "z"};
/// Says of each reserved word whether an expression may begin with it.
constexpr auto are_function_words = [] {
    std::array<bool, reserved_words.size()> are{};
    for (std::size_t i = 0; i < are.size(); ++i)
        are[i] = is_maths_word(static_cast<std::uint16_t>(first_word_code + i));
    for (const std::string_view each : function_words) are[find_word(each) - first_word_code] = true;
    return are;
}();
bool is_function_word(std::uint16_t code) { return are_function_words[code - first_word_code]; }

}  // namespace

bool Interpreter::at_expression() {
    const std::uint16_t first = code();
    if (first == value_code) {
        const ValueKind kind = next.value->kind;
        return kind <= ValueKind::color || kind == ValueKind::spline || kind == ValueKind::function ||
               kind == ValueKind::vector_function;
    }
    return first == number_code || first == '<' || first == '-' || first == '+' || first == '(' || first == '!' ||
           (first >= first_word_code && is_function_word(first));
}

double Interpreter::parameter() {
    expect('(');
    Components value;
    full(value, 1);
    expect(')');
    if (value.count != 1) fail(last, "a number expected in these parentheses, but found a vector");
    return value.value[0];
}

DVec3 Interpreter::vector_parameter() {
    expect('(');
    const DVec3 value = read_vector();
    expect(')');
    return value;
}

std::string Interpreter::string_parameter() {
    expect('(');
    std::string value = read_string();
    expect(')');
    return value;
}

void Interpreter::arguments(double* values, int count) {
    expect('(');
    for (int i = 0; i < count; ++i) {
        if (i > 0) accept(',');
        values[i] = read_number();
    }
    expect(')');
}

std::shared_ptr<const Thing> Interpreter::object_argument() {
    if (kind() != ValueKind::object) expected("the identifier of an object");
    return take_value().thing;
}

void Interpreter::call(std::uint16_t function, Components& result) {
    const TextPlace at = next.place;
    const auto set = [&](double value) { std::fill_n(result.value.begin(), result.count, value); };
    const auto set_vector = [&](const DVec3& value) {
        result.value = {value.x, value.y, value.z, 0, 0};
        result.count = 3;
    };
    // After the domain was checked, as POV-Ray does.
    const auto clamped = [&](double value) {
        if (std::abs(value) > 1) warn(at, name_of_code(function) + " of a number beyond 1");
        return std::clamp(value, -1., 1.);
    };
    double a[4];
    if (!is_function_word(function)) expected("a number, a vector or a colour");
    take();
    switch (function) {
        case word("acos"):
            return set(std::acos(clamped(parameter())));
        case word("asin"):
            return set(std::asin(clamped(parameter())));
        case word("atan2"):
            arguments(a, 2);
            if (!is_true(a[0]) && !is_true(a[1])) fail(at, "atan2(0, 0) has no value");
            return set(std::atan2(a[0], a[1]));
        case word("degrees"):
            return set(parameter() / (std::numbers::pi / 180));
        case word("int"):
            return set(cut_off(parameter()));
        case word("sqrt"): {
            const double value = parameter();
            if (value < 0) fail(at, "the square root of a negative number has no value");
            return set(std::sqrt(value));
        }
        case word("ln"):
        case word("log"): {
            const double value = parameter();
            if (value <= 0) fail(at, "the logarithm of a number that is not positive has no value");
            return set(function == word("ln") ? std::log(value) : std::log10(value));
        }
        case word("pow"):
            arguments(a, 2);
            if (a[0] == 0 && a[1] == 0) fail(at, "pow(0, 0) has no value");
            return set(std::pow(a[0], a[1]));
        case word("div"):
            arguments(a, 2);
            return set(cut_off(a[0] / a[1]));
        case word("bitwise_and"):
        case word("bitwise_or"):
        case word("bitwise_xor"): {
            expect('(');
            std::int32_t value = static_cast<std::int32_t>(cut_off(read_number()));
            while (accept(',') || code() != ')') {
                const std::int32_t other = static_cast<std::int32_t>(cut_off(read_number()));
                value = function == word("bitwise_and")  ? value & other
                        : function == word("bitwise_or") ? value | other
                                                         : value ^ other;
            }
            expect(')');
            return set(value);
        }
        case word("select"): {
            expect('(');
            int count = 0;
            for (; count < 4 && code() != ')'; ++count) {
                if (count > 0) accept(',');
                a[count] = read_number();
            }
            expect(')');
            if (count < 3) fail(at, "select needs three or four arguments");
            if (a[0] < 0) return set(a[1]);
            return set(count == 4 && a[0] > 0 ? a[3] : a[2]);
        }
        case word("defined"):
            return set(read_defined());
        case word("true"):
        case word("yes"):
        case word("on"):
            return set(1);
        case word("false"):
        case word("no"):
        case word("off"):
            return set(0);
        case word("pi"):
            return set(std::numbers::pi);
        case word("clock"):
            uses_clock = true;
            return set(options.clock);
        case word("clock_on"):
            uses_clock = true;
            return set(options.clock_on);
        case word("version"):
            return set(language_version);
        case word("now"):
            ++changes;
            return set((std::time(nullptr) - 946684800) / 86400.);  // days since 2000
        case word("rand"): {
            const double stream = parameter();
            if (!(stream >= 0 && stream < static_cast<double>(streams.size())))
                fail(at, "rand needs a number that seed() gave");
            std::uint32_t& state = streams[static_cast<std::size_t>(stream)];
            state = 1812433253u * state + 12345u;
            ++changes;
            return set(state / 4294967295.);
        }
        case word("seed"):
            ++changes;
            streams.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(cut_off(parameter()))));
            if ((streams.size() & 0xFFFFF) == 0) *bytes += 4 << 20;
            return set(static_cast<double>(streams.size() - 1));
        case word("asc"): {
            const std::string text = string_parameter();
            return set(text.empty() ? 0 : static_cast<unsigned char>(text[0]));
        }
        case word("val"):
            return set(std::strtod(string_parameter().c_str(), nullptr));
        case word("strlen"):
            return set(static_cast<double>(string_parameter().size()));
        case word("strcmp"): {
            expect('(');
            const std::string left = read_string();
            accept(',');
            const std::string right = read_string();
            expect(')');
            const std::size_t most = std::min(left.size(), right.size());
            for (std::size_t i = 0; i <= most; ++i) {
                const int difference = (i < left.size() ? static_cast<unsigned char>(left[i]) : 0) -
                                       (i < right.size() ? static_cast<unsigned char>(right[i]) : 0);
                if (difference) return set(difference);
            }
            return set(0);
        }
        case word("file_exists"): {
            expect('(');
            const std::string name = read_file_name();
            expect(')');
            return set(!find_file(name, {}, false).empty());
        }
        case word("dimensions"):
        case word("dimension_size"): {
            expect('(');
            if (kind() != ValueKind::array) expected("the identifier of an array");
            const auto array = std::static_pointer_cast<const ArrayThing>(take_value().thing);
            double value = static_cast<double>(array->sizes.size());
            if (function == word("dimension_size")) {
                accept(',');
                const double dimension = read_number() - 1 + tiny;
                if (!(dimension >= 0 && dimension < value)) fail(at, "the array has no such dimension");
                value = array->sizes[static_cast<std::size_t>(dimension)];
            }
            expect(')');
            return set(value);
        }
        case word("x"):
            return set_vector({1, 0, 0});
        case word("y"):
            return set_vector({0, 1, 0});
        case word("z"):
            return set_vector({0, 0, 1});
        case word("u"):
        case word("v"):
            result.value = {function == word("u") ? 1. : 0., function == word("v") ? 1. : 0.};
            result.count = 2;
            return;
        case word("t"):
            result.value = {0, 0, 0, 1};
            result.count = 4;
            return;
        case word("vlength"):
            return set(length(vector_parameter()));
        case word("vnormalize"): {
            const DVec3 value = vector_parameter();
            const double size = length(value);
            if (size == 0) warn(at, "vnormalize of a vector of length 0");
            return set_vector(size == 0 ? DVec3(0) : value / size);
        }
        case word("vdot"):
        case word("vcross"):
        case word("vrotate"):
        case word("vaxis_rotate"): {
            expect('(');
            const DVec3 p = read_vector();
            accept(',');
            const DVec3 q = read_vector();
            double degrees = 0;
            if (function == word("vaxis_rotate")) {
                accept(',');
                degrees = read_number();
            }
            expect(')');
            if (function == word("vdot")) return set(p.x * q.x + p.y * q.y + p.z * q.z);
            if (function == word("vcross"))
                return set_vector({p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x});
            if (function == word("vaxis_rotate"))
                return set_vector(length(q) == 0 ? p : times(p, rotation(q, degrees)));
            return set_vector(times(p, rotation(q)));
        }
        case word("vturbulence"): {
            expect('(');
            const double lambda = read_number();
            accept(',');
            const double omega = read_number();
            accept(',');
            const int octaves = static_cast<int>(std::clamp(read_number(), 1., 10.));
            accept(',');
            const DVec3 point = read_vector();
            expect(')');
            return set_vector(
                lattice::vector_turbulence(point, octaves, static_cast<float>(omega), static_cast<float>(lambda)));
        }
        case word("inside"): {
            expect('(');
            const auto object = object_argument();
            accept(',');
            const DVec3 point = read_vector();
            expect(')');
            return set(layer.inside(*this, *object, point));
        }
        case word("min_extent"):
        case word("max_extent"): {
            expect('(');
            const auto object = object_argument();
            expect(')');
            const auto [low, high] = layer.extent(*this, *object);
            return set_vector(function == word("min_extent") ? low : high);
        }
        case word("trace"): {
            expect('(');
            const auto object = object_argument();
            accept(',');
            const DVec3 from = read_vector();
            accept(',');
            const DVec3 direction = read_vector();
            DVec3 hit(0), normal(0);
            const bool found = layer.trace(*this, *object, from, direction, hit, normal);
            if (!found) hit = normal = DVec3(0);
            if (accept(',')) {
                if (kind() == ValueKind::none || kind() > ValueKind::color) expected("the identifier of a vector");
                *next.value = {ValueKind::vector, {normal.x, normal.y, normal.z}, nullptr};
                ++changes;
                take();
            }
            expect(')');
            return set_vector(hit);
        }
        default: {
            const auto of_more = [&](auto operation) {
                expect('(');
                double value = read_number();
                while (accept(',') || code() != ')') value = operation(value, read_number());
                expect(')');
                set(value);
            };
            const bool known =
                with_unary(function, [&](auto operation) { set(operation(parameter())); }) ||
                with_binary(function, [&](auto operation) { arguments(a, 2), set(operation(a[0], a[1])); }) ||
                with_any_count(function, of_more);
            if (!known) fail(at, name_of_code(function) + " is allowed in functions only");
        }
    }
}

}  // namespace strahl::pov
