#include "pov/language/interpreter.h"

#include <algorithm>

#include "files/error.h"
#include "files/os/memory.h"

namespace strahl::pov {

/// Limits memory to half of what is free.
static InterpreterOptions limited(InterpreterOptions options) {
    std::size_t& most = options.limits.bytes;
    most = static_cast<std::size_t>(std::min(static_cast<double>(most), os::available_memory() / 2));
    return options;
}

Interpreter::Interpreter(std::string text, InterpreterOptions given, SceneLayer& layer)
    : options(limited(std::move(given))), layer(layer) {
    const auto declare = [&](const char* name, double value) {
        std::uint32_t number = 0;
        if (names.find(name, number) != end_code) return;
        Symbol* known = symbols.find(number);
        (known ? known : &symbols.add(number, true))->value = {ValueKind::number, {value}, nullptr};
    };
    // Outside of an animation all of these are 0 in POV-Ray.
    for (const char* name :
         {"clock_delta", "final_clock", "final_frame", "frame_number", "initial_clock", "initial_frame"})
        declare(name, 0);
    declare("image_width", options.width);
    declare("image_height", options.height);
    for (const auto& [name, value] : options.declared) declare(name.c_str(), value);
    names.find("frame_number", frame_number);
    names.find("image_width", image_width), names.find("image_height", image_height);
    texts.push_back(std::make_unique<TextFile>(options.file, std::move(text), names));
    push_file(0, {});
}

// The stream of tokens.

void Interpreter::push_file(std::uint32_t file, TextPlace called) {
    if (!readings.empty()) readings.back().cursor = cursor;
    readings.push_back({file, nullptr, nullptr, controls.size(), called});
    cursor = texts[file]->tokens.data();
}

void Interpreter::pop_reading() {
    symbols.pop();
    readings.pop_back();
    cursor = readings.back().cursor;
}

/// Says how many bytes are too many.
static std::string limit_of(std::size_t bytes) {
    return "; more than " + std::to_string(bytes >> 20) + " MiB in all" +
           (bytes < InterpreterLimits().bytes ? ", half of the memory that is free" : "");
}

void Interpreter::check_limits() {
    if (options.stop && options.stop->load(std::memory_order_relaxed)) throw Interrupted("reading was stopped");
    if (steps > options.limits.steps)
        fail(place_of_loop(),
             "the scene does not end: more than " + std::to_string(options.limits.steps) + " words were read");
    if (*bytes > options.limits.bytes)
        fail(last, "the scene's arrays and strings need too much memory" + limit_of(options.limits.bytes));
    if (readings.size() + controls.size() > 2 * static_cast<std::size_t>(options.limits.nesting))
        fail(last, "macros, files and loops are nested too deeply");
}

TextPlace Interpreter::place_of_loop() const {
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const std::size_t end = i + 1 < readings.size() ? readings[i + 1].controls : controls.size();
        for (std::size_t k = readings[i].controls; k < end; ++k)
            if (controls[k].type == Control::ControlType::loop_while ||
                controls[k].type == Control::ControlType::loop_for)
                return {readings[i].file, controls[k].opener->at};
    }
    return last;
}

void Interpreter::advance() {
    for (;;) {
        count_step();
        const RawToken& raw = *cursor;
        const auto is_next = [&](std::uint16_t code, bool postponed) {
            next.code = code;
            next.postponed = postponed;
            next.place = place_of(raw);
            next.raw = &raw;
            peeked = true;
        };
        switch (raw.code) {
            case '#': {
                const Reading& reading = readings.back();
                const bool returns =
                    raw.directive == word("end") && reading.macro && controls.size() == reading.controls;
                if (!executing && !returns) return is_next('#', true);
                ++cursor;
                last = place_of(raw);
                if (returns)
                    pop_reading();
                else
                    directive(raw);
                if (peeked) return;
                break;
            }
            case new_name_code: {
                const Symbol* symbol = symbols.find(raw.index);
                if (symbol && symbol->value.kind == ValueKind::macro && !executing) return is_next('#', true);
                if (resolve(raw)) {
                    peeked = true;
                    return;
                }
                break;
            }
            case end_code:
                if (controls.size() != readings.back().controls) {
                    const TextPlace opener = place_of(*controls.back().opener);
                    fail(opener, "this block is not closed: '#end' expected before the end of the file");
                }
                if (readings.back().macro) fail(place_of(raw), "the macro is not closed: '#end' expected");
                if (readings.size() == 1) return is_next(end_code, false);
                pop_reading();
                break;
            case bad_code: {
                const char c = text().text[raw.at];
                fail(place_of(raw), c == '"'   ? "this string is not closed: '\"' expected"
                                    : c == '/' ? "this comment is not closed: '*/' expected"
                                               : "this character is allowed in comments and strings only");
            }
            case word("declare"):
            case word("include"):
            case word("default"):
                if (!executing) return is_next(raw.code, true);
                ++cursor;
                read_old_directive(raw);
                if (peeked) return;
                break;
            default:
                ++cursor;
                return is_next(raw.code, false);
        }
    }
}

bool Interpreter::resolve(const RawToken& raw) {
    ++cursor;
    const TextPlace place = place_of(raw);
    Symbol* symbol = symbols.find(raw.index);
    while (symbol && value_of(*symbol).kind == ValueKind::none) symbol = symbol->outer;
    const auto no_value = [&] {
        next = {};
        next.code = new_name_code;
        next.place = place;
        next.raw = &raw;
        return true;
    };
    if (!symbol) return no_value();
    uses_clock |= raw.index == frame_number;
    uses_size |= raw.index == image_width || raw.index == image_height;
    NamedValue* value = &value_of(*symbol);
    if (value->kind == ValueKind::macro) {
        last = place;
        call_macro(raw, std::static_pointer_cast<const MacroThing>(value->thing));
        return false;
    }
    std::shared_ptr<ArrayThing> array;
    std::size_t index = 0;
    if (value->kind == ValueKind::array && cursor->code == '[') {
        value = raw_element(value, array, index);
        if (value->kind == ValueKind::none) return no_value();  // a declaration may give it one before it is used
    }
    next.code = value_code;
    next.postponed = false;
    next.place = place;
    next.raw = &raw;
    next.value = value;
    next.symbol = symbol;
    if (array || next.array) next.array = std::move(array);
    next.index = index;
    return true;
}

NamedValue& Interpreter::value_of(Symbol& symbol) {
    if (symbol.target) return symbol.target->value;
    if (!symbol.element.thing) return symbol.value;
    return const_cast<ArrayThing&>(static_cast<const ArrayThing&>(*symbol.element.thing)).elements[symbol.index];
}

bool Interpreter::accept_here(TokenCode wanted) {
    return with_directives(false, [&] { return accept(wanted); });
}

void Interpreter::begin_block() {
    const TextPlace word = last_place();
    expect('{');
    blocks.push_back({word, last_place()});
    if (++depth > options.limits.nesting) fail("blocks are nested too deeply");
}
void Interpreter::end_block() {
    expect('}');
    --depth;
    closed = blocks.back().brace;
    blocks.pop_back();
}
void Interpreter::count_bytes(std::size_t count, TextPlace at) {
    *bytes += count;
    if (*bytes > options.limits.bytes)
        fail(at, "the scene's bodies need too much memory" + limit_of(options.limits.bytes));
}
void Interpreter::skip_block() {
    const TextPlace start = place();
    expect('{');
    for (std::size_t open = 1; open > 0; take()) {
        if (at('{')) ++open;
        if (at('}')) --open;
        if (at_end()) fail(start, "this block is not closed: '}' expected");
    }
}

NamedValue Interpreter::take_value() {
    if (kind() == ValueKind::none) expected("an identifier");
    NamedValue value = *next.value;
    take();
    return value;
}

// Values.

int Interpreter::read_integer() { return static_cast<int>(std::clamp(read_number(), -2147483648., 2147483647.)); }
std::array<double, 2> Interpreter::read_uv() {
    Components result;
    sum(result);
    if (result.count > 2) fail("two components expected, but there are " + std::to_string(result.count));
    return {result.value[0], result.value[result.count - 1]};
}
Components Interpreter::read_components() {
    Components result;
    sum(result);
    return result;
}
std::string Interpreter::read_file_name() {
    if (code() != string_code) return read_string();
    const std::string_view slice =
        std::string_view(texts[next.place.file]->text).substr(next.place.at + 1, next.raw->index);
    take();
    return std::string(slice);
}

void Interpreter::remark(Remark::Kind kind, TextPlace at, const std::string& text) {
    const std::uint64_t key = (static_cast<std::uint64_t>(at.file) << 32) | at.at;
    if (kept_remarks.size() < 10'000 && told.emplace(key, text).second) kept_remarks.push_back({kind, at, text});
}

}  // namespace strahl::pov
