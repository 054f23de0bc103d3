#include "pov/language/interpreter.h"

#include <algorithm>

#include "files/error.h"
#include "files/os/memory.h"
#include "pov/language/state.h"

namespace strahl::pov {

Interpreter::State::State(Interpreter& in, InterpreterOptions given, SceneLayer& layer)
    : in(in), options(std::move(given)), layer(layer) {}

Interpreter::Interpreter(std::string text, InterpreterOptions options, SceneLayer& layer)
    : state(std::make_unique<State>(*this, std::move(options), layer)) {
    std::size_t& most = state->options.limits.bytes;
    most = static_cast<std::size_t>(std::min(static_cast<double>(most), os::available_memory() / 2));
    const auto declare = [&](const char* name, double value) {
        std::uint32_t number = 0;
        if (state->names.find(name, number) != end_code) return;
        Symbol* known = state->symbols.find(number);
        (known ? known : &state->symbols.add(number, true))->value = {ValueKind::number, {value}, nullptr};
    };
    const InterpreterOptions& o = state->options;
    // Outside of an animation all of these are 0 in POV-Ray.
    for (const char* name :
         {"clock_delta", "final_clock", "final_frame", "frame_number", "initial_clock", "initial_frame"})
        declare(name, 0);
    declare("image_width", o.width);
    declare("image_height", o.height);
    for (const auto& [name, value] : o.declared) declare(name.c_str(), value);
    state->names.find("frame_number", state->frame_number);
    state->names.find("image_width", state->image_width), state->names.find("image_height", state->image_height);
    state->files.push_back(std::make_unique<TextFile>(o.file, std::move(text), state->names));
    state->push_file(0, {});
}

Interpreter::~Interpreter() = default;

// The stream of tokens.

void Interpreter::State::push_file(std::uint32_t file, TextPlace called) {
    if (!readings.empty()) readings.back().cursor = cursor;
    readings.push_back({file, nullptr, nullptr, controls.size(), called});
    cursor = files[file]->tokens.data();
}

void Interpreter::State::pop_reading() {
    symbols.pop();
    readings.pop_back();
    cursor = readings.back().cursor;
}

/// Says how many bytes are too many.
static std::string limit_of(std::size_t bytes) {
    return "; more than " + std::to_string(bytes >> 20) + " MiB in all" +
           (bytes < InterpreterLimits().bytes ? ", half of the memory that is free" : "");
}

void Interpreter::State::check_limits() {
    if (options.stop && options.stop->load(std::memory_order_relaxed)) throw Interrupted("reading was stopped");
    if (steps > options.limits.steps)
        fail(place_of_loop(),
             "the scene does not end: more than " + std::to_string(options.limits.steps) + " words were read");
    if (*bytes > options.limits.bytes)
        fail(last, "the scene's arrays and strings need too much memory" + limit_of(options.limits.bytes));
    if (readings.size() + controls.size() > 2 * static_cast<std::size_t>(options.limits.nesting))
        fail(last, "macros, files and loops are nested too deeply");
}

TextPlace Interpreter::State::place_of_loop() const {
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const std::size_t end = i + 1 < readings.size() ? readings[i + 1].controls : controls.size();
        for (std::size_t k = readings[i].controls; k < end; ++k)
            if (controls[k].type == Control::ControlType::loop_while ||
                controls[k].type == Control::ControlType::loop_for)
                return {readings[i].file, controls[k].opener->at};
    }
    return last;
}

void Interpreter::State::advance() {
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

bool Interpreter::State::resolve(const RawToken& raw) {
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
    clock_used |= raw.index == frame_number;
    size_used |= raw.index == image_width || raw.index == image_height;
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

NamedValue& Interpreter::State::value_of(Symbol& symbol) {
    if (symbol.target) return symbol.target->value;
    if (!symbol.element.thing) return symbol.value;
    return const_cast<ArrayThing&>(static_cast<const ArrayThing&>(*symbol.element.thing)).elements[symbol.index];
}

std::uint16_t Interpreter::code() { return state->code(); }
bool Interpreter::accept(TokenCode wanted) { return state->accept(wanted.value); }
bool Interpreter::accept_here(TokenCode wanted) {
    return state->with_directives(false, [&] { return state->accept(wanted.value); });
}
void Interpreter::expect(TokenCode wanted) { state->expect(wanted.value); }
void Interpreter::skip() { state->take(); }

void Interpreter::begin_block() {
    const TextPlace word = last_place();
    expect('{');
    state->blocks.push_back({word, last_place()});
    if (++state->depth > state->options.limits.nesting) fail("blocks are nested too deeply");
}
void Interpreter::end_block() {
    expect('}');
    --state->depth;
    state->closed = state->blocks.back().brace;
    state->blocks.pop_back();
}
void Interpreter::count_bytes(std::size_t bytes, TextPlace at) {
    *state->bytes += bytes;
    if (*state->bytes > state->options.limits.bytes)
        fail(at, "the scene's bodies need too much memory" + limit_of(state->options.limits.bytes));
}
void Interpreter::skip_block() {
    const TextPlace start = place();
    expect('{');
    for (std::size_t open = 1; open > 0; skip()) {
        if (at('{')) ++open;
        if (at('}')) --open;
        if (at_end()) fail(start, "this block is not closed: '}' expected");
    }
}

ValueKind Interpreter::kind() { return state->code() == value_code ? state->next.value->kind : ValueKind::none; }
NamedValue Interpreter::take_value() {
    if (kind() == ValueKind::none) expected("an identifier");
    NamedValue value = *state->next.value;
    state->take();
    return value;
}

// Values.

bool Interpreter::at_expression() { return state->at_value(); }
double Interpreter::read_number() { return state->number(); }
int Interpreter::read_integer() { return static_cast<int>(std::clamp(state->number(), -2147483648., 2147483647.)); }
DVec3 Interpreter::read_vector() { return state->vector(); }
std::array<double, 2> Interpreter::read_uv() {
    Components result;
    state->sum(result);
    if (result.count > 2) fail("two components expected, but there are " + std::to_string(result.count));
    return {result.value[0], result.value[result.count - 1]};
}
Components Interpreter::read_components() {
    Components result;
    state->sum(result);
    return result;
}
bool Interpreter::at_color() { return state->at_color(); }
FilterColor Interpreter::read_color() { return state->color(); }
bool Interpreter::at_string() { return state->at_string(); }
std::string Interpreter::read_string() { return state->string(); }
std::string Interpreter::read_file_name() {
    if (code() != string_code) return read_string();
    const std::string_view slice = std::string_view(state->files[state->next.place.file]->text)
                                       .substr(state->next.place.at + 1, state->next.raw->index);
    state->take();
    return std::string(slice);
}
std::shared_ptr<const FunctionThing> Interpreter::read_function(std::array<int, 2>* size) {
    return state->function(size);
}

// Files, messages and settings.

std::string Interpreter::find_file(const std::string& name, const std::vector<std::string>& extensions, bool must) {
    return state->find(name, extensions, must);
}
const std::vector<std::string>& Interpreter::files() const { return state->search.paths(); }

TextPlace Interpreter::place() {
    state->code();
    return state->next.place;
}
TextPlace Interpreter::last_place() const { return state->last; }

void Interpreter::remark(Remark::Kind kind, TextPlace at, const std::string& text) {
    const std::uint64_t key = (static_cast<std::uint64_t>(at.file) << 32) | at.at;
    if (state->remarks.size() < 10'000 && state->told.emplace(key, text).second)
        state->remarks.push_back({kind, at, text});
}
const std::vector<Remark>& Interpreter::remarks() const { return state->remarks; }
void Interpreter::fail(TextPlace at, const std::string& text) { state->fail(at, text); }
void Interpreter::expected(const std::string& what) { state->expected(what); }
void Interpreter::misplaced() { state->wrong_token(""); }
std::string_view Interpreter::text_at(TextPlace at) const { return state->text_at(at); }
const std::string& Interpreter::path_of(TextPlace at) const { return state->files[at.file]->path; }
Message Interpreter::message_at(TextPlace at, const std::string& text) const { return state->message_at(at, text); }

double Interpreter::version() const { return state->version; }
bool Interpreter::version_given() const { return state->version_given; }
bool Interpreter::clock_used() const { return state->clock_used; }
bool Interpreter::size_used() const { return state->size_used; }
const InterpreterOptions& Interpreter::options() const { return state->options; }

}  // namespace strahl::pov
