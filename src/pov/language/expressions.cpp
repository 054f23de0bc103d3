// Expressions with POV-Ray's rules: commas are optional, shorter vectors are padded, comparisons have a tolerance.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "files/words.h"
#include "pov/language/interpreter.h"
#include "pov/language/spline.h"

namespace strahl::pov {
namespace {

/// Makes an expression have at least `count` components: a number is repeated, a vector padded with 0.
void promote(Components& value, int count) {
    if (value.count >= count) return;
    const double fill = value.count == 1 ? value.value[0] : 0;
    std::fill(value.value.begin() + value.count, value.value.begin() + count, fill);
    value.count = count;
}

/// Combines two expressions component by component.
template <class Operation>
void combine(Components& left, Components& right, const Operation& operation) {
    if (left.count == 1 && right.count == 1) {
        left.value[0] = operation(left.value[0], right.value[0]);
        return;
    }
    const int count = std::max(left.count, right.count);
    promote(left, count);
    promote(right, count);
    for (int i = 0; i < count; ++i) left.value[i] = operation(left.value[i], right.value[i]);
}

/// Makes an expression a number, repeated as often as components are wanted.
void set(Components& result, double value) { std::fill_n(result.value.begin(), result.count, value); }

bool compare(std::uint16_t code, double left, double right) {
    switch (code) {
        case '<':
            return left < right;
        case less_equal_code:
            return left - right <= tiny;
        case '=':
            return std::abs(left - right) <= tiny;
        case not_equal_code:
            return std::abs(left - right) > tiny;
        case greater_equal_code:
            return left - right >= -tiny;
        default:
            return left > right;
    }
}
bool is_comparison(std::uint16_t code) {
    return code == '<' || code == '=' || code == '>' || code == less_equal_code || code == greater_equal_code ||
           code == not_equal_code;
}

}  // namespace

template <auto read_operand>
void Interpreter::read_chain(Components& result, const auto& is_operator, const auto& operation) {
    (this->*read_operand)(result);
    for (;;) {
        const std::uint16_t sign = code();
        if (!is_operator(sign)) return;
        take();
        Components right;
        right.count = result.count;
        (this->*read_operand)(right);
        combine(result, right, [&](double a, double b) { return operation(sign, a, b); });
    }
}

void Interpreter::sum(Components& result) {
    read_chain<&Interpreter::product>(
        result, [](std::uint16_t sign) { return sign == '+' || sign == '-'; },
        [](std::uint16_t sign, double a, double b) { return sign == '+' ? a + b : a - b; });
}

void Interpreter::product(Components& result) {
    read_chain<&Interpreter::factor>(
        result, [](std::uint16_t sign) { return sign == '*' || sign == '/'; },
        [&](std::uint16_t sign, double a, double b) {
            if (sign == '*') return a * b;
            if (b == 0) warn(last, "division by 0");
            return b == 0 ? std::numeric_limits<double>::infinity() : a / b;
        });
}

void Interpreter::factor(Components& result) {
    const bool before = execute(true);
    switch (code()) {
        case number_code:
            set(result, next.raw->number);
            take();
            break;
        case value_code:
            identifier(result);
            break;
        case '<':
            vector_literal(result);
            break;
        case '-':
        case '+':
        case '!': {
            const Depth guard(*this);
            const std::uint16_t sign = next.code;
            take();
            execute(before);
            factor(result);
            for (int i = 0; i < result.count; ++i)
                if (sign == '-')
                    result.value[i] = -result.value[i];
                else if (sign == '!')
                    result.value[i] = is_true(result.value[i]) ? 0 : 1;
            return;
        }
        case '(': {
            const Depth guard(*this);
            take();
            full(result, result.count);
            expect(')');
            break;
        }
        default:
            if (next.code < first_word_code) expected("a number, a vector or a colour");
            {
                const Depth guard(*this);
                call(next.code, result);
            }
    }
    execute(before);
    if (code() == '.') component(result);
}

void Interpreter::component(Components& result) {
    take();
    int index = 0;
    switch (code()) {
        case word("x"):
        case word("u"):
        case word("red"):
            index = 0;
            break;
        case word("y"):
        case word("v"):
        case word("green"):
            index = 1;
            break;
        case word("z"):
        case word("blue"):
            index = 2;
            break;
        case word("t"):
        case word("filter"):
            index = 3;
            break;
        case word("transmit"):
            index = 4;
            break;
        case word("gray"):
            index = 5;
            break;
        default:
            expected("the name of a component, such as x or red,");
    }
    take();
    const auto& v = result.value;
    const int count = std::exchange(result.count, 1);
    if (index == 5) return set(result, .297 * v[0] + (count > 1 ? .589 * v[1] : 0) + (count > 2 ? .114 * v[2] : 0));
    if (index >= count) fail(last, "there is no such component: the value has " + std::to_string(count));
    set(result, v[index]);
}

void Interpreter::vector_literal(Components& result) {
    const Depth guard(*this);
    const TextPlace start = next.place;
    take();
    int count = 0;
    std::array<double, 5> value{};
    do {
        if (count == 5) open_vector(start);
        value[count++] = read_number();
        accept(',');
    } while (count < 2 || at_expression());
    if (!accept('>')) open_vector(start);
    result.value = value;
    result.count = count;
}

void Interpreter::identifier(Components& result) {
    NamedValue& value = *next.value;
    switch (value.kind) {
        case ValueKind::number:
            set(result, value.number[0]);
            take();
            return;
        case ValueKind::uv:
        case ValueKind::vector:
        case ValueKind::vector4:
        case ValueKind::color:
            result.count = 1 + static_cast<int>(value.kind) - static_cast<int>(ValueKind::number);
            result.value = value.number;
            take();
            return;
        case ValueKind::spline: {
            const Depth guard(*this);
            const auto curve = std::static_pointer_cast<const SplineThing>(value.thing);
            take();
            expect('(');
            const double at = read_number();
            SplineThing::Type type = curve->type;
            if (accept(',')) {
                if (!SplineThing::type_of(code(), type)) expected("the type of a spline");
                take();
            }
            expect(')');
            result.count = curve->components;
            result.value = curve->at(at, type);
            return;
        }
        case ValueKind::function:
        case ValueKind::vector_function: {
            const Depth guard(*this);
            const auto function = std::static_pointer_cast<const FunctionThing>(value.thing);
            take();
            expect('(');
            std::vector<double> given;
            while (code() != ')') {
                Components argument;
                sum(argument);
                // A vector gives the arguments x, y and z.
                given.insert(given.end(), argument.value.begin(), argument.value.begin() + argument.count);
                if (!accept(',') && code() != ')') expected("',' or ')'");
            }
            if (static_cast<int>(given.size()) != function->arguments)
                fail(last, "this function needs " + std::to_string(function->arguments) + " arguments, not " +
                               std::to_string(given.size()));
            take();
            function->evaluate(given.data(), result.value.data());
            if (function->results > 1)
                result.count = function->results;
            else
                set(result, result.value[0]);
            return;
        }
        default:
            expected("a number, a vector or a colour");
    }
}

void Interpreter::full(Components& result, int wanted) {
    result.count = 1;
    logical(result);
    if (code() != '?') return promote(result, wanted);
    const Depth guard(*this);
    if (result.count != 1) fail(last, "a condition must be a number");
    take();
    Components other, otherwise;
    full(other, wanted);
    expect(':');
    full(otherwise, wanted);
    result = is_true(result.value[0]) ? other : otherwise;
}

void Interpreter::logical(Components& result) {
    read_chain<&Interpreter::relation>(
        result, [](std::uint16_t sign) { return sign == '&' || sign == '|'; },
        [](std::uint16_t sign, double a, double b) {
            return sign == '&' ? is_true(a) && is_true(b) : is_true(a) || is_true(b);
        });
}

void Interpreter::relation(Components& result) {
    if (at_string()) {
        const std::string left = read_string();
        const std::uint16_t operation = code();
        if (!is_comparison(operation)) expected("a comparison");
        take();
        return set(result, compare(operation, left.compare(read_string()), 0));
    }
    read_chain<&Interpreter::sum>(result, is_comparison, compare);
}

double Interpreter::read_number() {
    const TextPlace before = last;
    Components value;
    sum(value);
    if (value.count != 1)
        wrong_size(before, "a number expected, but this has " + std::to_string(value.count) + " components");
    return value.value[0];
}

DVec3 Interpreter::read_vector() {
    const TextPlace before = last;
    Components value;
    sum(value);
    if (value.count > 3)
        wrong_size(before, "a vector of three components expected, but this has " + std::to_string(value.count));
    promote(value, 3);
    return {value.value[0], value.value[1], value.value[2]};
}

namespace {

constexpr std::array color_forms{word("rgb"),  word("rgbf"),  word("rgbt"),  word("rgbft"),
                                 word("srgb"), word("srgbf"), word("srgbt"), word("srgbft")};
/// The words of a colour's numbers, with their places among the five.
constexpr std::array<std::pair<std::uint16_t, std::size_t>, 6> color_parts{{{word("red"), 0},
                                                                            {word("green"), 1},
                                                                            {word("blue"), 2},
                                                                            {word("filter"), 3},
                                                                            {word("alpha"), 3},
                                                                            {word("transmit"), 4}}};
constexpr auto part_of_color(std::uint16_t code) {
    return std::ranges::find(color_parts, code, [](const auto& own) { return own.first; });
}

}  // namespace

bool Interpreter::at_color() {
    if (code() == value_code) return next.value->kind == ValueKind::color;
    return code() == word("color") || std::ranges::count(color_forms, code()) > 0 ||
           part_of_color(code()) != color_parts.end();
}

double Interpreter::decode(double value) const {
    const double linear = value <= .04045 ? value / 12.92 : std::pow((value + .055) / 1.055, 2.4);
    return assumed_gamma ? std::pow(linear, 1 / *assumed_gamma) : linear;
}

FilterColor Interpreter::read_color() {
    std::array<double, 5> color{};
    bool begun = false;
    accept(word("color"));
    const auto read = [&](int wanted) {
        Components value;
        full(value, wanted);
        std::copy_n(value.value.begin(), value.count, color.begin());
        begun = true;
    };
    for (;;) {
        const std::uint16_t key = code();
        if (std::ranges::count(color_forms, key) > 0) {
            if (begun) break;
            const bool transmits = key == word("rgbt") || key == word("srgbt");
            const bool filters = key == word("rgbf") || key == word("srgbf");
            take();
            read(transmits || filters ? 4 : key == word("rgb") || key == word("srgb") ? 3 : 5);
            if (transmits) {
                color[4] = color[3];
                color[3] = 0;
            }
            if (key >= word("srgb") && key <= word("srgbt"))
                for (int i = 0; i < 3; ++i) color[i] = decode(color[i]);
        } else if (const auto part = part_of_color(key); part != color_parts.end()) {
            take();
            color[part->second] = read_number();
            begun = true;
        } else if (!begun && at_expression()) {
            read(5);
        } else {
            if (!begun && (key == new_name_code || key == ']')) expected("a colour");
            break;
        }
    }
    FilterColor result;
    result.red = static_cast<float>(color[0]);
    result.green = static_cast<float>(color[1]);
    result.blue = static_cast<float>(color[2]);
    result.filter = static_cast<float>(color[3]);
    result.transmit = static_cast<float>(color[4]);
    return result;
}

NamedValue Interpreter::named(const Components& value) const {
    NamedValue result;
    result.kind = static_cast<ValueKind>(static_cast<int>(ValueKind::number) + value.count - 1);
    std::copy_n(value.value.begin(), value.count, result.number.begin());
    if (value.count == 5)  // colours are in single precision
        for (double& each : result.number) each = static_cast<float>(each);
    return result;
}

NamedValue Interpreter::right_side(bool argument) {
    const std::uint16_t first = code();
    if (first == new_name_code) expected(argument ? "an argument with a value" : "a value");
    if (at_string()) return named(read_string());
    if (first == value_code) {
        const ValueKind kind = next.value->kind;
        const bool call = cursor->code == '(';
        const bool callable =
            kind == ValueKind::spline || kind == ValueKind::function || kind == ValueKind::vector_function;
        if (kind > ValueKind::color && !(callable && call)) {
            const NamedValue value = *next.value;
            take();
            return copy(value);
        }
    }
    if (first == word("array")) return read_array();
    if (first == word("spline")) return read_spline();
    if (first == word("function")) {
        auto read = read_function();
        const ValueKind kind = read->results == 1 ? ValueKind::function : ValueKind::vector_function;
        return {kind, {}, std::move(read)};
    }
    if (first != value_code && at_color()) {
        const bool before = execute(false);
        const FilterColor read = read_color();
        execute(before);
        return {ValueKind::color, {read.red, read.green, read.blue, read.filter, read.transmit}, nullptr};
    }
    if (at_expression()) {
        const bool before = execute(false);
        Components value;
        sum(value);
        execute(before);
        return named(value);
    }
    NamedValue thing = layer.read_thing(*this);
    if (thing.kind == ValueKind::none) expected(argument ? "an argument" : "a value");
    return thing;
}

}  // namespace strahl::pov
