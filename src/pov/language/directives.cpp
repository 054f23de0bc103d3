// Directives: declarations, conditions, loops, macros and messages.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "files/error.h"
#include "files/words.h"
#include "pov/language/interpreter.h"

namespace strahl::pov {
namespace {

/// Can a directive change what the condition of a loop around it finds?
bool changes_conditions(std::uint16_t directive) {
    constexpr std::array only_read{word("if"),    word("ifdef"),  word("ifndef"),     word("else"),   word("elseif"),
                                   word("while"), word("switch"), word("case"),       word("range"),  word("break"),
                                   word("end"),   word("debug"),  word("statistics"), word("render"), word("warning")};
    return std::ranges::find(only_read, directive) == only_read.end();
}

}  // namespace

void Interpreter::directive(const RawToken& raw) {
    const Depth guard(*this);
    const TextPlace at = place_of(raw);
    changes += changes_conditions(raw.directive);
    const auto open = [&](Control::ControlType type) -> Control& {
        controls.push_back({.type = type, .opener = &raw});
        return controls.back();
    };
    const auto print = [&](const std::string& text) {
        if (options.print) options.print(text);
    };
    switch (raw.directive) {
        case word("if"):
            open(Control::ControlType::condition);
            if (!is_true(parenthesised_number())) branch(&raw);
            break;
        case word("ifdef"):
        case word("ifndef"):
            open(Control::ControlType::condition);
            if (read_defined() != (raw.directive == word("ifdef"))) branch(&raw);
            break;
        case word("while"):
            open(Control::ControlType::loop_while);
            if (!is_true(parenthesised_number()))
                leave(raw);
            else
                controls.back().changes = changes;
            break;
        case word("for"): {
            expect('(');
            const RawToken& name = raw_name("the loop's variable");
            accept(',');
            const double first = read_number();
            accept(',');
            const double end = read_number();
            double step = 1;
            if (accept(',') || code() != ')') step = read_number();
            expect(')');
            if (is_true(step) == false) fail(at, "invalid #for: its step is 0");
            Symbol* symbol = symbols.find(name.index);
            if (!symbol || symbol->table != symbols.top()) symbol = &symbols.add(name.index, false);
            value_of(*symbol) = {ValueKind::number, {first}, nullptr};
            Control& loop = open(Control::ControlType::loop_for);  // an #end before it finds no body
            loop.variable = name.index;
            loop.end = end;
            loop.step = step;
            loop.body = cursor;
            if (!within(loop, first)) {
                leave(raw);
            } else if (const double count = (end - first) / step;
                       !(count <= static_cast<double>(options.limits.steps)) && !is_left(raw)) {
                std::ostringstream text;
                text << "invalid #for: it never ends, with " << count << " steps";
                fail(at, text.str());
            }
            break;
        }
        case word("switch"): {
            open(Control::ControlType::choice);
            const double value = parenthesised_number();
            controls.back().end = value;
            choose(&raw);
            break;
        }
        case word("case"):
        case word("range"):
        case word("else"):
        case word("elseif"):
            if (controls.size() == readings.back().controls) fail(at, "this belongs to no block");
            if (controls.back().type != Control::ControlType::choice) {
                leave(raw);
            } else if (raw.directive != word("else")) {  // cases fall through; their values are read over
                double range[2];
                if (raw.directive == word("range"))
                    with_directives(false, [&] { arguments(range, 2); });
                else
                    parenthesised_number();
            }
            break;
        case word("end"):
            end_control(raw);
            break;
        case word("break"):
            break_control(raw);
            break;
        case word("declare"):
        case word("local"):
            declare(raw.directive == word("local"));
            break;
        case word("undef"):
            undefine();
            break;
        case word("macro"):
            define_macro(raw);
            break;
        case word("include"):
            include_file();
            break;
        case word("version"):
            set_version();
            break;
        case word("default"):
            layer.read_default(*this);
            break;
        case word("error"):
            fail(at, "the scene says: " + read_string());
        case word("warning"): {
            const std::string text = read_string();
            warn(at, "the scene warns: " + text);
            print(text);
            break;
        }
        case word("debug"):
        case word("render"):
        case word("statistics"):
            print(read_string());
            break;
        case word("fopen"):
            open_file();
            break;
        case word("fclose"): {
            const RawToken& name = raw_name("a file's identifier");
            Symbol* symbol = symbols.find(name.index);
            // Reading to the end has closed it already.
            if (symbol && value_of(*symbol).kind == ValueKind::file) symbols.remove(*symbol);
            break;
        }
        case word("read"):
            read_file();
            break;
        case word("write"):
            write_file();
            break;
        default:  // also '#' before the name of a macro
            if (cursor->code != new_name_code) warn(at, "'#' without a directive is read over");
            break;
    }
}

void Interpreter::read_old_directive(const RawToken& raw) {
    last = place_of(raw);
    warn(last, "'#' is missing before " + name_of_code(raw.code));
    RawToken written = raw;
    written.code = '#';
    written.directive = raw.code;
    directive(written);
}

double Interpreter::parenthesised_number() {
    return with_directives(false, [&] { return parameter(); });
}

void Interpreter::leave(const RawToken& from) {
    const RawToken* at = &from;
    const RawToken* first = text().tokens.data();
    do {
        at = first + at->index;
    } while (at->code == '#' && at->directive != word("end"));
    cursor = at;  // '#end' closes the block itself
    if (at->code != '#') return;
    ++cursor;
    controls.pop_back();
}

const RawToken* Interpreter::next_branch(const RawToken* tokens, const RawToken* at) {
    at = tokens + at->index;
    cursor = at;  // at the end of the text, which is an error there
    if (at->code != '#') return nullptr;
    ++cursor;
    if (at->directive != word("end")) return at;
    controls.pop_back();
    return nullptr;
}

void Interpreter::branch(const RawToken* at) {
    const RawToken* const tokens = text().tokens.data();
    while ((at = next_branch(tokens, at))) {
        if (at->directive == word("else")) return;
        if (at->directive == word("elseif") && is_true(parenthesised_number())) return;
    }
}

bool Interpreter::within(const Control& loop, double value) const {
    return loop.step > 0 ? value <= loop.end + tiny : value >= loop.end - tiny;
}

void Interpreter::choose(const RawToken* at) {
    const RawToken* const tokens = text().tokens.data();
    const double value = controls.back().end;
    while ((at = next_branch(tokens, at))) {
        if (at->directive == word("else")) return;
        if (at->directive == word("case") && std::abs(parenthesised_number() - value) < tiny) return;
        if (at->directive == word("range")) {
            double range[2];
            with_directives(false, [&] { arguments(range, 2); });
            if (value >= range[0] && value <= range[1]) return;
        }
    }
}

void Interpreter::end_control(const RawToken& raw) {
    if (controls.size() == readings.back().controls) fail(place_of(raw), "'#end' without a block that it could close");
    Control& control = controls.back();
    if (control.type == Control::ControlType::loop_while) {
        cursor = control.opener + 1;
        if (!is_true(parenthesised_number())) return leave(*controls.back().opener);
        Control& loop = controls.back();
        if (loop.changes == changes)
            fail(place_of(*loop.opener), "invalid #while: it never ends, since nothing in it changes its condition");
        loop.changes = changes;
    } else if (control.type == Control::ControlType::loop_for) {
        Symbol* symbol = symbols.find(control.variable);
        if (!symbol || value_of(*symbol).kind != ValueKind::number)
            fail(place_of(raw), "the variable of #for is not a number any more");
        double& value = value_of(*symbol).number[0];
        value += control.step;
        if (within(control, value))
            cursor = control.body;
        else
            controls.pop_back();
    } else {
        controls.pop_back();
    }
}

bool Interpreter::is_left(const RawToken& loop) const {
    const RawToken* const end = text().tokens.data() + loop.index;
    return std::any_of(&loop, end,
                       [](const RawToken& raw) { return raw.code == '#' && raw.directive == word("break"); });
}

void Interpreter::break_control(const RawToken& raw) {
    while (controls.size() > readings.back().controls) {
        if (controls.back().type != Control::ControlType::condition) return leave(*controls.back().opener);
        controls.pop_back();
    }
    if (!readings.back().macro) fail(place_of(raw), "'#break' outside loops, cases and macros");
    pop_reading();
}

const RawToken& Interpreter::raw_name(const std::string& what) {
    const RawToken& raw = *cursor;
    last = place_of(raw);
    if (raw.code != new_name_code) {
        if (raw.code >= first_word_code)
            fail(last, name_of_code(raw.code) + " is a word of the language; choose another name");
        fail(last, what + " expected, but found " + name_of_code(raw.code));
    }
    ++cursor;
    return raw;
}

NamedValue* Interpreter::raw_element(NamedValue* value, std::shared_ptr<ArrayThing>& array, std::size_t& index) {
    while (value->kind == ValueKind::array && cursor->code == '[') {
        array = std::const_pointer_cast<ArrayThing>(std::static_pointer_cast<const ArrayThing>(value->thing));
        index = subscripts(*array);
        value = &array->elements[index];
    }
    return value;
}

bool Interpreter::read_defined() {
    return with_directives(false, [&] {
        expect('(');
        bool known = false;
        if (cursor->code == new_name_code) {
            Symbol* symbol = symbols.find(cursor->index);
            ++cursor;
            if (symbol) {
                std::shared_ptr<ArrayThing> array;
                std::size_t index = 0;
                known = raw_element(&value_of(*symbol), array, index)->kind != ValueKind::none;
            }
        } else {
            take();
            known = false;
        }
        expect(')');
        return known;
    });
}

void Interpreter::declare(bool local) {
    if (cursor->code == word("deprecated")) {
        take();
        accept(word("once"));
        if (at_string()) read_string();
    }
    const RawToken& name = raw_name("an identifier");
    const TextPlace at = last;
    Symbol* symbol = symbols.find(name.index);
    std::shared_ptr<ArrayThing> array;
    std::size_t index = 0;
    if (symbol && value_of(*symbol).kind == ValueKind::array && cursor->code == '[') {
        with_directives(true, [&] { return raw_element(&value_of(*symbol), array, index); });
    } else {
        if (symbol && local && symbol->table != symbols.top()) symbol = nullptr;
        if (!symbol) symbol = &symbols.add(name.index, !local);
        const ValueKind old = value_of(*symbol).kind;
        if (old == ValueKind::macro) fail(at, strahl::quoted(names.text(name.index)) + " is a macro");
        if (old == ValueKind::function || old == ValueKind::vector_function)
            fail(at, "a function cannot be declared again; '#undef " + names.text(name.index) + "' first");
    }
    // The table may be gone when the right side has been read: a macro may end there.
    struct Keep {
        Interpreter& in;
        Symbol* symbol;
        ~Keep() { in.symbols.release(symbol); }
    } keep{*this, symbol};
    ++symbol->users;
    with_directives(false, [&] { expect('='); });
    NamedValue value = right_side(false);
    with_directives(false, [&] {
        const bool numbers = value.kind >= ValueKind::number && value.kind <= ValueKind::color;
        if (!accept(';') && numbers && language_version >= 3.5) warn(at, "';' is missing after this declaration");
        // As in POV-Ray a second one may follow, such as that of the line that includes this file.
        if (!numbers || peeked) return;
        const bool at_end = cursor->code == end_code && readings.size() > 1 && !readings.back().macro;
        const RawToken*& following = at_end ? readings[readings.size() - 2].cursor : cursor;
        if (following->code == ';') ++following;
    });
    if (array) {
        if (value.kind == ValueKind::array) add_level(*array, value);
        array->elements[index] = std::move(value);
    } else {
        value_of(*symbol) = std::move(value);
    }
    if (peeked && next.code == new_name_code && next.raw->index == name.index) cursor = next.raw, peeked = false;
}

void Interpreter::undefine() {
    const RawToken& name = raw_name("an identifier");
    Symbol* symbol = symbols.find(name.index);
    if (!symbol) return warn(last, "'#undef' of an unknown name");
    std::shared_ptr<ArrayThing> array;
    std::size_t index = 0;
    if (raw_element(&value_of(*symbol), array, index); array)
        array->elements[index] = {};
    else
        symbols.remove(*symbol);
}

void Interpreter::define_macro(const RawToken& raw) {
    const RawToken& name = raw_name("the macro's name");
    const TextPlace at = last;
    auto macro = std::make_shared<MacroThing>();
    macro->name = name.index;
    macro->file = readings.back().file;
    const auto sign = [&](char wanted) {
        if (cursor->code != wanted) return false;
        ++cursor;
        return true;
    };
    if (!sign('(')) fail(place_of(*cursor), "'(' expected after the macro's name");
    while (!sign(')')) {
        macro->parameters.push_back(raw_name("a parameter or ')'").index);
        sign(',');
    }
    macro->first = static_cast<std::uint32_t>(cursor - text().tokens.data());
    const RawToken& end = text().tokens[raw.index];
    if (end.code != '#') fail(place_of(raw), "this macro is not closed: '#end' expected");
    cursor = &end + 1;
    Symbol* symbol = symbols.find(name.index);
    if (symbol && value_of(*symbol).kind != ValueKind::macro)
        fail(at,
             strahl::quoted(names.text(name.index)) + " is already " + strahl::pov::name_of(value_of(*symbol).kind));
    if (!symbol) symbol = &symbols.add(name.index, true);
    value_of(*symbol) = {ValueKind::macro, {}, std::move(macro)};
}

void Interpreter::call_macro(const RawToken& raw, std::shared_ptr<const MacroThing> macro) {
    /// An argument: a value, or the identifier or element that the parameter will stand for.
    struct Argument {
        NamedValue value;
        Symbol* target = nullptr;
        NamedValue element;
        std::size_t index = 0;
    };
    const Depth guard(*this);
    const TextPlace called = place_of(raw);
    expect('(');
    std::vector<Argument> given(macro->parameters.size());
    const int table = symbols.top();
    for (Argument& argument : given) {
        if (code() == ')')
            fail(next.place, "the macro " + strahl::quoted(names.text(macro->name)) + " needs " +
                                 std::to_string(given.size()) + " arguments");
        bool reference =
            code() == value_code && next.symbol->table <= table && symbols.find(next.symbol->name) == next.symbol;
        if (reference) {
            const ValueKind kind = next.value->kind;
            const std::uint16_t after = cursor->code;
            const bool more =
                after == '+' || after == '-' || after == '*' || after == '/' || after == '.' || after == '#';
            if (kind == ValueKind::function || kind == ValueKind::vector_function)
                reference = false;
            else if (kind == ValueKind::spline)
                reference = after != '(';
            else if (kind <= ValueKind::color)
                reference = !more;
        }
        if (!reference) {
            argument.value = right_side(true);
        } else {
            if (next.array) {
                argument.element = {ValueKind::array, {}, next.array};
                argument.index = next.index;
            } else if (next.symbol->element.thing) {
                argument.element = next.symbol->element;
                argument.index = next.symbol->index;
            } else {
                argument.target = next.symbol->target ? next.symbol->target : next.symbol;
            }
            take();
        }
        accept(',');
    }
    if (code() != ')') expected("')' after the arguments of the macro " + strahl::quoted(names.text(macro->name)));
    take();
    symbols.push();
    for (std::size_t i = 0; i < given.size(); ++i) {
        Symbol& parameter = symbols.add(macro->parameters[i], false);
        parameter.value = std::move(given[i].value);
        parameter.element = std::move(given[i].element);
        parameter.index = given[i].index;
        if (given[i].target) symbols.refer(parameter, given[i].target);
    }
    push_file(macro->file, called);
    readings.back().macro = macro;
    cursor += macro->first;
    if (readings.size() > 2 * static_cast<std::size_t>(options.limits.nesting)) check_limits();
}

void Interpreter::include_file() {
    const TextPlace at = last;
    const std::string name = read_file_name();
    if (readings.size() > static_cast<std::size_t>(options.limits.nesting))
        fail(at, "files include each other without an end");
    const std::string path = find_text(name, {".inc", ".INC"});
    const auto count = static_cast<std::uint32_t>(texts.size());
    auto [known, fresh] = file_numbers.emplace(path, count);
    if (fresh || is_written(path)) {  // the file may have changed
        known->second = count;
        texts.push_back(std::make_unique<TextFile>(path, load(path), names));
    }
    symbols.push();
    push_file(known->second, at);
}

void Interpreter::set_version() {
    std::string program;  // another one, whose numbers say nothing
    const double wanted = with_directives(false, [&] {
        if (code() == new_name_code && names.text(next.raw->index) == "unofficial") {
            take();
            if (code() == new_name_code) program = names.text(next.raw->index), take();
        }
        const double value = read_number();
        accept(';');
        return value;
    });
    if (!program.empty()) return warn(last, "a scene for " + program + " is read as if it was for POV-Ray");
    has_version = true;
    language_version = std::round(wanted * 100) / 100;
    if (!noise_generator_given) *generator_of_functions = noise_generator = language_version < 3.5 ? 1 : 2;
    if (language_version > 3.7)
        warn(last, "#version " + std::to_string(language_version).substr(0, 4) + " is read as 3.7");
}

}  // namespace strahl::pov
