// Functions that a scene declares: read into a list of instructions for a small stack machine.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "files/words.h"
#include "pov/language/internal_functions.h"
#include "pov/language/interpreter.h"
#include "pov/language/maths.h"
#include "pov/language/spline.h"

namespace strahl::pov {

constexpr int most_numbers = 250;        // on the stack of one function: its arguments, and what expressions need
constexpr long most_steps = 20'000'000;  // in one evaluation, with those of the functions that it calls
constexpr int most_calls = 60;           // of functions that call functions

/// An instruction: takes its operands from the stack, and puts its result there. Codes of words are functions of that
/// name; those of signs, operators.
struct Instruction {
    std::uint16_t operation;
    std::uint16_t count = 0;  // of arguments; of a loop, of all branches and of one: the instructions in it
    std::uint32_t index = 0;  // of a variable, of a function that is called, of a component; the number of branches
    double number = 0;
};
// Operations besides signs and words.
constexpr std::uint16_t constant = 1, variable = 2, call = 3, negate = 4, branch = 5;

// Components of colours besides their own: their gray value, and the height that red and green stand for.
constexpr int gray_component = 5, height_component = 6;
static double component_of(const double* value, int component) {
    if (component == gray_component) return .297 * value[0] + .589 * value[1] + .114 * value[2];
    if (component == height_component) return (value[0] + value[1] / 255) * .996093;
    return value[component];
}

struct CompiledFunction : FunctionThing {
    std::vector<Instruction> instructions;
    std::vector<std::shared_ptr<const FunctionThing>> called;
    int variables = 0;  // arguments, then variables of loops
    int levels = 1;

    void evaluate(const double* given, double* result) const override {
        execute(given, result, lattice::noise_by_points);
    }
    void evaluate_lanes(const Lanes* given, Lanes* result, const lattice::NoiseLanes& noise) const override {
        execute(given, result, noise);
    }

  private:
    /// Evaluates the function for one list of arguments, or for some at once.
    template <class S>
    void execute(const S* given, S* result, const lattice::NoiseLanes& noise) const {
        const bool outermost = levels_open == 0;
        S numbers[most_numbers];
        std::copy_n(given, arguments, numbers);
        if (outermost) steps_left = most_steps;
        ++levels_open;
        *result = run(0, instructions.size(), numbers, numbers + variables, noise)[-1];
        --levels_open;
    }
    template <class S>
    S* run(std::size_t first, std::size_t last, S* numbers, S* top, const lattice::NoiseLanes& noise) const;
    // The functions of this thread that are being evaluated, each called by the one before, and the steps left to them.
    static inline thread_local int levels_open = 0;
    static inline thread_local long steps_left = 0;
};

using Lanes = FunctionThing::Lanes;

/// Sets all lanes to values of a function of their numbers.
template <class S, class Of>
static void set_each(S& to, const Of& value_of_lane) {
    if constexpr (std::is_same_v<S, double>)
        to = value_of_lane(0);
    else
        for (std::size_t lane = 0; lane < to.size(); ++lane) to[lane] = value_of_lane(lane);
}
static double lane_of(const double& value, std::size_t) { return value; }
static double lane_of(const Lanes& value, std::size_t lane) { return value[lane]; }
static void call_function(const FunctionThing& function, const double* given, double* result,
                          const lattice::NoiseLanes&) {
    function.evaluate(given, result);
}
static void call_function(const FunctionThing& function, const Lanes* given, Lanes* result,
                          const lattice::NoiseLanes& noise) {
    function.evaluate_lanes(given, result, noise);
}

/// Executes instructions, and returns the stack with their result on top: no number if there are no steps left.
template <class S>
S* CompiledFunction::run(std::size_t first, std::size_t last, S* numbers, S* top,
                         const lattice::NoiseLanes& noise) const {
    S* const base = top;
    const auto set = [](S& to, double value) { set_each(to, [&](std::size_t) { return value; }); };
    const auto stop = [&] {
        set(*base, std::numeric_limits<double>::quiet_NaN());
        return base + 1;
    };
    if ((steps_left -= static_cast<long>(last - first) + 1) < 0) return stop();
    for (std::size_t i = first; i < last; ++i) {
        const Instruction& step = instructions[i];
        const auto unary = [&](auto&& operation) {
            set_each(top[-1], [&, own = top[-1]](std::size_t i) { return operation(lane_of(own, i)); });
        };
        const auto binary = [&](auto&& operation) {
            --top;
            set_each(top[-1], [&](std::size_t i) { return operation(lane_of(top[-1], i), lane_of(top[0], i)); });
        };
        switch (step.operation) {
            case constant:
                set(*top++, step.number);
                break;
            case variable:
                *top++ = numbers[step.index];
                break;
            case negate:
                unary([](double v) { return -v; });
                break;
            case '+':
                binary([](double a, double b) { return a + b; });
                break;
            case '-':
                binary([](double a, double b) { return a - b; });
                break;
            case '*':
                binary([](double a, double b) { return a * b; });
                break;
            case '/':
                binary([](double a, double b) { return a / b; });
                break;
            case '<':
                binary([](double a, double b) { return a < b ? 1. : 0.; });
                break;
            case '>':
                binary([](double a, double b) { return a > b ? 1. : 0.; });
                break;
            case '=':
                binary([](double a, double b) { return a == b ? 1. : 0.; });
                break;
            case less_equal_code:
                binary([](double a, double b) { return a <= b ? 1. : 0.; });
                break;
            case greater_equal_code:
                binary([](double a, double b) { return a >= b ? 1. : 0.; });
                break;
            case not_equal_code:
                binary([](double a, double b) { return a != b ? 1. : 0.; });
                break;
            case '&':
                binary([](double a, double b) { return a != 0 && b != 0 ? 1. : 0.; });
                break;
            case '|':
                binary([](double a, double b) { return a != 0 || b != 0 ? 1. : 0.; });
                break;
            case word("select"): {
                // Only branches that are needed are evaluated.
                const S by = *--top;
                S chosen = by;
                const auto takes = [&](std::size_t number, std::size_t i) {
                    const double own = lane_of(by, i);
                    return number == (own < 0 ? 0u : step.index == 3 && own > 0 ? 2u : 1u);
                };
                std::size_t at = i + 1;
                for (std::size_t number = 0; number < step.index; at += 1 + instructions[at].count, ++number) {
                    bool any = false;
                    for (std::size_t i = 0; i < sizeof(S) / sizeof(double); ++i) any |= takes(number, i);
                    if (!any) continue;
                    const S value = run(at + 1, at + 1 + instructions[at].count, numbers, top, noise)[-1];
                    if (steps_left < 0) return stop();
                    set_each(chosen, [&](std::size_t i) { return lane_of(takes(number, i) ? value : chosen, i); });
                }
                *top++ = chosen;
                i += step.count;
                break;
            }
            case call: {
                S results[5];
                top -= step.count;
                call_function(*called[step.index], top, results, noise);
                if (steps_left < 0) return stop();
                set_each(*top++, [&](std::size_t i) {
                    double own[5];
                    for (int k = 0; k < called[step.index]->results; ++k) own[k] = lane_of(results[k], i);
                    return component_of(own, static_cast<int>(step.number));
                });
                break;
            }
            case word("sum"):
            case word("prod"): {
                top -= 2;
                const bool adds = step.operation == word("sum");
                S at = top[0], total;
                const S end = top[1];
                set(total, adds ? 0 : 1);
                const auto goes_on = [&](std::size_t i) { return lane_of(at, i) <= lane_of(end, i); };
                const auto any_goes_on = [&] {
                    bool any = false;
                    for (std::size_t i = 0; i < sizeof(S) / sizeof(double); ++i) any |= goes_on(i);
                    return any;
                };
                for (; any_goes_on(); set_each(at, [&](std::size_t i) { return lane_of(at, i) + 1; })) {
                    numbers[step.index] = at;
                    const S value = run(i + 1, i + 1 + step.count, numbers, top, noise)[-1];
                    if (steps_left < 0) return stop();
                    set_each(total, [&](std::size_t i) {
                        const double own = lane_of(value, i), sum = lane_of(total, i);
                        return !goes_on(i) ? sum : adds ? sum + own : sum * own;
                    });
                }
                *top++ = total;
                i += step.count;
                break;
            }
            default:
                if (with_unary(step.operation, unary) || with_binary(step.operation, binary)) break;
                with_any_count(step.operation, [&](auto operation) {
                    for (int k = 1; k < step.count; ++k) binary(operation);
                });
        }
    }
    return top;
}

/// A spline as a function of one number.
struct SplineFunction : FunctionThing {
    std::shared_ptr<const SplineThing> spline;
    explicit SplineFunction(std::shared_ptr<const SplineThing> given) : spline(std::move(given)) {
        arguments = 1;
        results = spline->components;
    }
    void evaluate(const double* given, double* result) const override {
        const auto value = spline->at(*given, spline->type);
        std::copy_n(value.begin(), results, result);
    }
};

static int levels_of(const FunctionThing& function) {
    const auto* compiled = dynamic_cast<const CompiledFunction*>(&function);
    return compiled ? compiled->levels : 1;
}

/// Reads the expression of a function.
class FunctionReader {
  public:
    explicit FunctionReader(Interpreter& in) : in(in) {}

    /// Reads `(a, b) { E }` or `{ E }`.
    std::shared_ptr<const FunctionThing> read() {
        auto& made = *result;
        if (in.accept('(')) {
            while (in.cursor->code != ')') {
                const RawToken& raw = *in.cursor++;
                in.last = in.place_of(raw);
                if (raw.code != new_name_code && !coordinate(raw.code))
                    in.fail(in.last, "the name of a parameter expected");
                parameters.push_back(key(raw));
                if (in.cursor->code == ',') ++in.cursor;
                if (parameters.size() > 56) in.fail(in.last, "a function has at most 56 parameters");
            }
            in.accept(')');
        } else {
            parameters = {word("x"), word("y"), word("z")};
        }
        made.arguments = static_cast<int>(parameters.size());
        in.expect('{');
        switch (in.code()) {
            case word("internal"):
                return read_internal();
            case word("pigment"):
            case word("pattern"):
            case word("transform"):
                return closed(in.layer.read_function(in));
            case word("spline"):
                return closed(std::make_shared<SplineFunction>(
                    std::static_pointer_cast<const SplineThing>(in.read_spline().thing)));
            case value_code:
                if (in.next.value->kind == ValueKind::transform) return closed(in.layer.read_function(in));
        }
        either();
        made.variables = static_cast<int>(parameters.size() + loops);
        if (made.variables + most > most_numbers) in.fail(in.last, "this function is too long");
        return closed(result);
    }

  private:
    static bool coordinate(std::uint16_t code) {
        return code == word("x") || code == word("y") || code == word("z") || code == word("u") || code == word("v");
    }
    /// Identifies a parameter: the code of its word, or a number beyond those of its name.
    static std::uint32_t key(const RawToken& raw) {
        return raw.code == new_name_code ? (1u << 16) + raw.index : raw.code;
    }

    std::shared_ptr<const FunctionThing> closed(std::shared_ptr<const FunctionThing> function) {
        if (!function) in.expected("a function");
        in.expect('}');
        return function;
    }
    std::shared_ptr<const FunctionThing> read_internal() {
        in.take();
        in.expect('(');
        const int number = static_cast<int>(std::clamp(in.read_number(), -1., 1000.));
        in.expect(')');
        auto function = internal_function(number, in.generator_of_functions);
        if (!function) in.fail(in.last, "there is no internal function of this number");
        return closed(function);
    }

    void add(std::uint16_t operation, int change, std::size_t count = 0, std::uint32_t index = 0, double number = 0) {
        result->instructions.push_back({operation, static_cast<std::uint16_t>(count), index, number});
        depth += change;
        most = std::max(most, depth);
        if (result->instructions.size() > 60000) in.fail(in.last, "this function is too long");
    }
    void constant_of(double value) { add(constant, 1, 0, 0, value); }

    // In functions '&' binds tighter than '|'.
    void either() {
        both();
        while (in.accept('|')) both(), add('|', -1);
    }
    void both() {
        relation();
        while (in.accept('&')) relation(), add('&', -1);
    }
    void relation() {
        sum();
        for (;;) {
            const std::uint16_t code = in.code();
            if (code != '<' && code != '>' && code != '=' && code != less_equal_code && code != greater_equal_code &&
                code != not_equal_code)
                return;
            in.take();
            sum();
            add(code, -1);
        }
    }
    void sum() {
        product();
        for (std::uint16_t code = in.code(); code == '+' || code == '-'; code = in.code()) {
            in.take();
            product();
            add(code, -1);
        }
    }
    void product() {
        factor();
        for (std::uint16_t code = in.code(); code == '*' || code == '/'; code = in.code()) {
            in.take();
            factor();
            add(code, -1);
        }
    }

    /// Finds a variable by its token, the innermost first; -1 if it is none.
    int find(const RawToken& raw) const {
        for (std::size_t i = names.size(); i-- > 0;)
            if (names[i].first == key(raw)) return names[i].second;
        for (std::size_t i = 0; i < parameters.size(); ++i)
            if (parameters[i] == key(raw)) return static_cast<int>(i);
        if (raw.code == word("u") && parameters.size() > 0) return 0;
        if (raw.code == word("v") && parameters.size() > 1) return 1;
        return -1;
    }

    void factor() {
        const Interpreter::Depth guard(in);
        const std::uint16_t code = in.code();
        const RawToken& raw = *in.next.raw;
        if (code == '-' || code == '+') {
            in.take();
            factor();
            if (code == '-') add(negate, 0);
            return;
        }
        if (code == '(') {
            in.take();
            either();
            in.expect(')');
            return;
        }
        if (code == number_code) {
            constant_of(raw.number);
            in.take();
            return;
        }
        if (raw.code == new_name_code || coordinate(code)) {
            if (const int found = find(raw); found >= 0 && in.cursor->code != '(') {
                in.take();
                return add(variable, 1, 0, static_cast<std::uint32_t>(found));
            }
        }
        if (code == value_code) return declared();
        if (code == word("sum") || code == word("prod")) return loop(code);
        if (code == word("select")) return choice();
        const auto nothing = [](const auto&) {};
        const bool one = with_unary(code, nothing), two = with_binary(code, nothing);
        if (one || two || with_any_count(code, nothing)) {
            in.take();
            const int count = arguments();
            if (one || two ? count != 1 + two : count < 1)
                in.fail(in.last, name_of_code(code) + " has another number of arguments");
            return add(code, 1 - count, static_cast<std::size_t>(count));
        }
        switch (code) {
            case word("pi"):
            case word("clock"):
            case word("clock_on"):
            case word("version"):
            case word("true"):
            case word("false"):
            case word("yes"):
            case word("no"):
            case word("on"):
            case word("off"): {
                Components value;
                in.factor(value);
                return constant_of(value.value[0]);
            }
        }
        in.expected("a number, a parameter or a function");
    }

    int arguments() {
        in.expect('(');
        int count = 0;
        while (in.code() != ')') {
            either();
            ++count;
            if (!in.accept(',') && in.code() != ')') in.expected("',' or ')'");
        }
        in.take();
        return count;
    }

    /// A declared identifier: a number, a component of a vector, or a call of a function or a spline.
    void declared() {
        NamedValue value = *in.next.value;
        switch (value.kind) {
            case ValueKind::spline:
                value.thing =
                    std::make_shared<SplineFunction>(std::static_pointer_cast<const SplineThing>(value.thing));
                [[fallthrough]];
            case ValueKind::function:
            case ValueKind::vector_function: {
                const auto function = std::static_pointer_cast<const FunctionThing>(value.thing);
                in.take();
                const int count = arguments();
                if (count != function->arguments)
                    in.fail(in.last, "this function needs " + std::to_string(function->arguments) + " arguments, not " +
                                         std::to_string(count));
                result->levels = std::max(result->levels, levels_of(*function) + 1);
                if (result->levels > most_calls) in.fail(in.last, "functions call each other too deeply");
                int component = 0;
                if (function->results > 1) {
                    component = read_component(function->results);
                }
                result->called.push_back(function);
                return add(call, 1 - count, static_cast<std::size_t>(count),
                           static_cast<std::uint32_t>(result->called.size() - 1), component);
            }
            default: {
                if (value.kind > ValueKind::color) in.expected("a number or a function");
                Components number;
                in.factor(number);  // with its component, if it is a vector
                if (number.count != 1) in.fail(in.last, "a number expected in a function, but found a vector");
                constant_of(number.value[0]);
            }
        }
    }
    /// Reads the component of a vector function that counts: its number, or that of a mean of colours.
    int read_component(int count) {
        in.expect('.');
        static constexpr std::uint16_t names_of[]{word("x"),   word("y"),     word("z"),    word("t"),
                                                  word("red"), word("green"), word("blue"), word("filter")};
        const std::uint16_t code = in.code();
        const std::string name = code == new_name_code ? in.names.text(in.next.raw->index) : "";
        int index = static_cast<int>(std::ranges::find(names_of, code) - names_of) % 4;
        if (code == word("u") || code == word("v"))
            index = code == word("v");
        else if (code == word("transmit"))
            index = 4;
        else if (code == word("gray"))
            index = gray_component;
        else if (name == "grey")
            index = gray_component;
        else if (name == "hf")
            index = height_component;
        else if (std::ranges::find(names_of, code) == std::end(names_of))
            in.expected("the name of a component, such as x or red,");
        in.take();
        if (index >= gray_component ? count < 3 : index >= count)
            in.fail(in.last, "there is no such component: the value has " + std::to_string(count));
        return index;
    }

    /// select(a, E, E) and select(a, E, E, E): an instruction that is followed by all branches, each after its own.
    void choice() {
        in.take();
        in.expect('(');
        either();
        const std::size_t start = result->instructions.size();
        add(word("select"), -1);
        std::uint32_t branches = 0;
        for (; in.accept(','); ++branches) {
            const std::size_t first = result->instructions.size();
            add(branch, 0);
            either();
            --depth;
            result->instructions[first].count = static_cast<std::uint16_t>(result->instructions.size() - first - 1);
        }
        in.expect(')');
        if (branches != 2 && branches != 3)
            in.fail(in.last, name_of_code(word("select")) + " has another number of arguments");
        ++depth;
        Instruction& whole = result->instructions[start];
        whole.index = branches, whole.count = static_cast<std::uint16_t>(result->instructions.size() - start - 1);
    }

    /// sum(i, a, b, E) and prod(i, a, b, E).
    void loop(std::uint16_t code) {
        in.take();
        in.expect('(');
        const RawToken& name = *in.cursor++;
        if (name.code != new_name_code && !coordinate(name.code)) in.fail(in.place_of(name), "a variable expected");
        in.expect(',');
        either();
        in.expect(',');
        either();
        in.expect(',');
        const std::uint32_t slot = static_cast<std::uint32_t>(parameters.size() + loops++);
        names.emplace_back(key(name), static_cast<int>(slot));
        const std::size_t start = result->instructions.size();
        add(code, -2, 0, slot);
        either();
        names.pop_back();
        in.expect(')');
        result->instructions[start].count = static_cast<std::uint16_t>(result->instructions.size() - start - 1);
    }

    Interpreter& in;
    std::shared_ptr<CompiledFunction> result = std::make_shared<CompiledFunction>();
    std::vector<std::uint32_t> parameters;
    std::vector<std::pair<std::uint32_t, int>> names;  // of the loops that are open, with their slots
    std::size_t loops = 0;
    int depth = 0, most = 0;
};

void FunctionThing::evaluate_lanes(const Lanes* given, Lanes* result, const lattice::NoiseLanes&) const {
    std::array<double, 64> own;
    double found[5];
    for (std::size_t lane = 0; lane < given->size(); ++lane) {
        for (int k = 0; k < arguments; ++k) own[std::size_t(k)] = given[k][lane];
        evaluate(own.data(), found);
        for (int k = 0; k < results; ++k) result[k][lane] = found[k];
    }
}

void FunctionThing::evaluate_all(std::span<const DVec3> points, double* values,
                                 const lattice::NoiseLanes& noise) const {
    for (std::size_t first = 0; first < points.size(); first += 8) {
        Lanes given[3], result;
        const std::size_t last = points.size() - 1;
        for (std::size_t lane = 0; lane < 8; ++lane)
            for (int k = 0; k < 3; ++k) given[k][lane] = points[std::min(first + lane, last)][k];
        evaluate_lanes(given, &result, noise);
        std::copy_n(result.begin(), std::min<std::size_t>(8, points.size() - first), values + first);
    }
}

std::shared_ptr<const FunctionThing> Interpreter::read_function(std::array<int, 2>* size) {
    const Depth guard(*this);
    if (code() == value_code &&
        (next.value->kind == ValueKind::function || next.value->kind == ValueKind::vector_function))
        return std::static_pointer_cast<const FunctionThing>(take_value().thing);
    expect(word("function"));
    if (size && at_expression() && code() != '(') {
        for (int& each : *size) {
            each = read_integer();
            accept(',');
        }
    }
    return FunctionReader(*this).read();
}

}  // namespace strahl::pov
