// The interpreter's state: where it reads, what identifiers stand for, and the readers of the language's own parts.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "num/lattice_noise.h"
#include "pov/language/file_search.h"
#include "pov/language/interpreter.h"
#include "pov/language/symbols.h"
#include "pov/language/text_file.h"

namespace strahl::pov {

/// Differences below this are none for POV-Ray's comparisons.
inline constexpr double tiny = 1e-10;
inline bool is_true(double value) { return value < -tiny || value > tiny; }

/// A macro: its parameters, and where its text is.
struct MacroThing : Thing {
    std::uint32_t name = 0, file = 0, first = 0;  // the token after the parameters
    std::vector<std::uint32_t> parameters;
};

/// A file that #fopen opened. The tokens of one that is read are numbers, vectors and strings.
struct FileThing : Thing {
    std::string path;
    std::unique_ptr<TextFile> reading;
    mutable std::size_t next = 0;
    std::shared_ptr<std::ostream> writing;
};

struct Interpreter::State {
    State(Interpreter& in, InterpreterOptions options, SceneLayer& layer);

    /// A text or a macro that is being read.
    struct Reading {
        std::uint32_t file = 0;
        const RawToken* cursor = nullptr;         // where it goes on; valid while another is read
        std::shared_ptr<const MacroThing> macro;  // null for a file
        std::size_t controls = 0;                 // number of the enclosing directives
        TextPlace called;                         // place of the call
    };
    /// A conditional block or a loop that is open.
    struct Control {
        enum class ControlType : std::uint8_t { condition, loop_while, loop_for, choice } type = ControlType::condition;
        bool chosen = false;               // for #switch: is one of its cases being read?
        const RawToken* opener = nullptr;  // '#' of its first directive
        const RawToken* body = nullptr;    // of #for: after its parentheses
        std::uint32_t variable = 0;        // of #for
        double end = 0, step = 0;          // of #for; `end` is the value of a #switch
        std::uint64_t changes = 0;         // of #while: State::changes when its condition was last read
    };
    /// A block of the scene that is open: the token before its '{', and its '{'.
    struct OpenBlock {
        TextPlace word, brace;
    };
    /// The next token.
    struct NextToken {
        std::uint16_t code = end_code;
        bool postponed = false;  // a directive or a macro call that may not be executed yet
        TextPlace place;
        const RawToken* raw = nullptr;
        NamedValue* value = nullptr;        // of a declared identifier or an element
        Symbol* symbol = nullptr;           // of an identifier
        std::shared_ptr<ArrayThing> array;  // of an element: its array
        std::size_t index = 0;              // index of the element in it
    };

    std::uint16_t code() {
        if (!peeked) advance();
        return next.code;
    }
    bool accept(std::uint16_t wanted) {
        if (code() != wanted) return false;
        take();
        return true;
    }
    void expect(std::uint16_t wanted) {
        if (!accept(wanted)) expected(name_of_code(wanted));
    }
    void take() {
        code();
        last = next.place;
        peeked = false;
    }
    void advance();
    /// Finds what an identifier stands for; false if it was a macro, whose call has begun.
    bool resolve(const RawToken& raw);
    /// Allows directives and macro calls to be executed, or postpones them.
    bool execute(bool now) {
        const bool before = executing;
        executing = now;
        if (now && peeked && next.postponed) {
            peeked = false;
            cursor = next.raw;
        }
        return before;
    }
    /// Does something with directives allowed or postponed, and sets the former state afterwards.
    template <class Do>
    auto with_directives(bool now, const Do& something) {
        struct Restore {
            State& state;
            bool before;
            ~Restore() { state.execute(before); }
        } restore{*this, execute(now)};
        return something();
    }
    void count_step() {
        if ((++steps & 1023) == 0) check_limits();
    }
    void check_limits();
    /// Returns where the outermost loop that is being read begins, or the last token if there is none.
    TextPlace place_of_loop() const;
    void push_file(std::uint32_t file, TextPlace called);
    void pop_reading();
    const TextFile& text() const { return *files[readings.back().file]; }
    TextPlace place_of(const RawToken& raw) const { return {readings.back().file, raw.at}; }

    // Directives.
    void directive(const RawToken& raw);
    void read_old_directive(const RawToken& raw);
    void leave(const RawToken& from);  // goes to the end of a block
    /// Goes from a branch that is not read to the block's next one. At the block's end closes it and returns null.
    /// `tokens` are those of the text, which an expression in the branch may have left.
    const RawToken* next_branch(const RawToken* tokens, const RawToken* at);
    void branch(const RawToken* at);  // finds the branch that counts, from one that does not
    bool starts(Control& loop);
    bool within(const Control& loop, double value) const;
    void choose(const RawToken* at);
    void end_block(const RawToken& raw);
    void break_block(const RawToken& raw);
    bool is_left(const RawToken& loop) const;  // is there a #break in it?
    void declare(bool local);
    void undefine();
    void define_macro(const RawToken& raw);
    void call_macro(const RawToken& raw, std::shared_ptr<const MacroThing> macro);
    void include_file();
    void set_version();
    void open_file();
    void read_file();
    void write_file();
    double parenthesised_number();
    bool read_defined();
    /// Reads the name of an identifier as it stands, without what it stands for.
    const RawToken& raw_name(const std::string& what);
    /// The element after an array's name as it stands, or nothing if no '[' follows.
    NamedValue* raw_element(NamedValue* value, std::shared_ptr<ArrayThing>& array, std::size_t& index);
    NamedValue& value_of(Symbol& symbol);

    // Values.
    NamedValue right_side(bool argument);
    std::shared_ptr<ArrayThing> new_array(std::vector<int> sizes, int levels);
    NamedValue copy(const NamedValue& value);
    std::size_t subscripts(const ArrayThing& array);
    NamedValue read_array();
    void add_level(ArrayThing& array, const NamedValue& element);  // of arrays in arrays
    void read_elements(ArrayThing& array, std::size_t dimension, std::size_t& element);
    NamedValue read_spline();
    NamedValue named(const Components& value) const;
    NamedValue named(std::string text);

    // Expressions. `count` of the result says beforehand how many components are wanted: a number becomes so many, as
    // in POV-Ray, where <1, 2> + 2 * <3, 4, 5> is <7, 10, 0>.
    /// Reads operands and the operators between them, and combines the values from left to right.
    template <auto read_operand>
    void read_chain(Components& result, const auto& is_operator, const auto& operation);
    void sum(Components& result);
    void product(Components& result);
    void factor(Components& result);
    void full(Components& result, int wanted);
    void logical(Components& result);
    void relation(Components& result);
    void vector_literal(Components& result);
    void identifier(Components& result);
    void component(Components& result);
    void call(std::uint16_t code, Components& result);
    double number();
    DVec3 vector();
    double parameter();        // (E)
    DVec3 vector_parameter();  // (V)
    std::string string_parameter();
    void arguments(double* values, int count);
    std::string string();
    bool at_string();
    bool at_value();
    bool at_color();
    FilterColor color();
    std::shared_ptr<const Thing> object_argument();
    std::shared_ptr<const FunctionThing> function(std::array<int, 2>* size = nullptr);
    double decode(double value) const;

    // Files.
    bool is_written(const std::string& name) const;
    std::string find_text(const std::string& name, const std::vector<std::string>& extensions);
    std::string load(const std::string& path);
    std::string find(const std::string& name, const std::vector<std::string>& extensions, bool must);

    // Messages.
    std::string_view text_at(TextPlace at) const;
    [[noreturn]] void fail(TextPlace at, const std::string& text);
    [[noreturn]] void expected(const std::string& what);
    /// Fails at the token `next`, also if it is taken already. `what` is expected, or with "" the end of a block.
    [[noreturn]] void wrong_token(const std::string& what);
    /// Fails if the innermost block seems to lack its '}' before `next`.
    void tell_open_block(bool at_end_of_block);
    /// Fails at the value behind the token `before`, which has another number of components than it should.
    [[noreturn]] void wrong_size(TextPlace before, const std::string& message);
    /// Fails at a vector without '>'.
    [[noreturn]] void open_vector(TextPlace start);
    /// Returns what an unknown name may stand for, or how to declare it.
    std::string advice_on_name(const std::string& name, const std::string& what);
    void warn(TextPlace at, const std::string& text) { in.remark(Remark::Kind::warning, at, text); }
    Message message_at(TextPlace at, const std::string& text) const;
    std::string where(TextPlace at) const;

    /// Counts how deeply the interpreter calls itself.
    struct Depth {
        explicit Depth(State& state) : state(state) {
            if (++state.depth > state.options.limits.nesting) state.fail(state.last, "this is nested too deeply");
        }
        ~Depth() { --state.depth; }
        State& state;
    };

    Interpreter& in;
    InterpreterOptions options;
    SceneLayer& layer;

    NamePool names;
    Symbols symbols;
    FileSearch search{options.file, options.library};
    std::vector<std::unique_ptr<TextFile>> files;
    std::unordered_map<std::string, std::uint32_t> file_numbers;
    std::map<std::string, std::shared_ptr<std::ostringstream>> kept_files;  // that the scene has written
    std::vector<Reading> readings;
    std::vector<Control> controls;
    std::vector<OpenBlock> blocks;
    std::optional<TextPlace> closed;   // '{' of the block that was closed last
    const RawToken* cursor = nullptr;  // of the text that is being read
    NextToken next;
    TextPlace last;  // of the token taken last
    bool peeked = false, executing = true;
    std::size_t steps = 0;
    std::uint64_t changes = 0;  // counts whatever may change what a condition finds when it is read again
    std::shared_ptr<std::size_t> bytes = std::make_shared<std::size_t>(0);  // of arrays and strings
    int depth = 0;
    std::vector<std::uint32_t> streams;  // of rand
    double version = 3.7;
    bool version_given = false;
    bool clock_used = false, size_used = false;
    std::uint32_t frame_number = 0, image_width = 0, image_height = 0;  // the numbers of these names
    std::vector<Remark> remarks;
    std::set<std::pair<std::uint64_t, std::string>> told;
};

}  // namespace strahl::pov
