// Reads a POV-Ray scene: executes its directives, macros and expressions, and hands the rest on, token by token.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/error.h"
#include "num/vec.h"
#include "pov/language/file_search.h"
#include "pov/language/interpreter_options.h"
#include "pov/language/scene_layer.h"
#include "pov/language/symbols.h"
#include "pov/language/text_file.h"
#include "pov/language/value.h"
#include "pov/language/words.h"

namespace strahl::pov {

/// A place in one of the texts that are read: the number of the file, and the position in its text.
struct TextPlace {
    std::uint32_t file = 0, at = 0;
};

/// How much a remark matters: the picture is approximated, lacks something, or is as the scene says.
enum class RemarkKind { approximated, left_out, warning };

/// A message about a place. Each message about a place is kept once, also if a loop brings it a thousand times.
struct Remark {
    using Kind = RemarkKind;
    Kind kind;
    TextPlace place;
    std::string text;
};

/// The stream of tokens that is left of a scene once its language has been applied, and readers of values.
///
/// The functions look one token ahead, as POV-Ray does: a directive is executed when the token before it has been taken
/// and the next one is asked for.
class Interpreter {
  public:
    /// Begins to read a scene. `layer` and what the options refer to must live as long as the interpreter.
    Interpreter(std::string text, InterpreterOptions options, SceneLayer& layer);
    Interpreter(const Interpreter&) = delete;

    // Tokens.
    /// Returns the code of the next token: of a sign, of a reserved word, `number_code`, `string_code`, `new_name_code`
    /// (an identifier that is not declared), `value_code` (one that is, or an element of an array) or `end_code`.
    std::uint16_t code() {
        if (!peeked) advance();
        return next.code;
    }
    bool at(TokenCode wanted) { return code() == wanted.value; }
    /// Takes the next token if it is this one.
    bool accept(TokenCode wanted) {
        if (!at(wanted)) return false;
        take();
        return true;
    }
    /// Takes the next token if it is this one and stands right here, with no directive before it. Between the layers of
    /// a declared texture POV-Ray executes none.
    bool accept_here(TokenCode wanted);
    /// Takes this token, or fails: "'{' expected, but found ...".
    void expect(TokenCode wanted) {
        if (!accept(wanted)) expected(name_of_code(wanted.value));
    }
    /// Takes the next token, whatever it is.
    void take() {
        code();
        last = next.place;
        peeked = false;
    }
    /// Takes the commas that may stand between two values.
    void skip_comma() { accept(','); }
    bool at_end() { return code() == end_code; }
    /// Take '{' and '}', and limit how deep blocks are nested.
    void begin_block();
    void end_block();
    /// Counts memory that a thing at this place needs. Fails if the scene needs too much.
    void count_bytes(std::size_t count, TextPlace at);
    /// Reads over a whole block, from '{' to its '}'.
    void skip_block();

    // Identifiers.
    /// Returns the kind of the identifier's value that comes next, `none` if there is no declared identifier.
    ValueKind kind() { return code() == value_code ? next.value->kind : ValueKind::none; }
    /// Takes a declared identifier and returns its value.
    NamedValue take_value();
    /// Takes an identifier of this kind; returns null and takes nothing if something else comes.
    template <class T>
    std::shared_ptr<const T> accept_thing(ValueKind wanted) {
        if (kind() != wanted) return nullptr;
        return std::static_pointer_cast<const T>(take_value().thing);
    }

    // Values. A number is read as POV-Ray reads parameters: with + - * /; all other operators need parentheses.
    /// Can a number, a vector or a colour without its word begin here?
    bool at_expression();
    double read_number();
    /// Reads a whole number; a fraction is cut off.
    int read_integer();
    /// Reads a number if one comes, else returns `otherwise`.
    double read_number_or(double otherwise) { return at_expression() ? read_number() : otherwise; }
    /// Reads a flag: "on" or "off" or a number; a flag without a value is on.
    bool read_flag() { return read_number_or(1) != 0; }
    DVec3 read_vector();
    /// Reads two components, as in <u, v>.
    std::array<double, 2> read_uv();
    /// Reads an expression of up to 5 components.
    Components read_components();
    /// Does a colour begin here: a word such as `color`, `rgb` or `red`, or the identifier of a colour?
    bool at_color();
    /// Reads a colour with or without its words.
    FilterColor read_color();
    /// Can a string begin here?
    bool at_string();
    std::string read_string();
    /// Reads a string in which backslashes are literal.
    std::string read_file_name();
    /// Reads function { ... }, or the identifier of a function. With `size`, `function 300, 200 { ... }` as well, which
    /// is a picture of this size.
    std::shared_ptr<const FunctionThing> read_function(std::array<int, 2>* size = nullptr);

    // Files.
    /// Finds a file that the scene names, with one of these extensions added to it if need be. If there is none, or if
    /// it lies outside the scene's folder and the library, it fails, or without `must` returns nothing.
    std::string find_file(const std::string& name, const std::vector<std::string>& extensions = {}, bool must = true);
    /// Returns the paths of all files that were read or found, the scene's first.
    const std::vector<std::string>& files() const { return search.paths(); }

    // Messages.
    /// Returns the place of the next token, and of the one that was taken last.
    TextPlace place() {
        code();
        return next.place;
    }
    TextPlace last_place() const { return last; }
    void remark(Remark::Kind kind, TextPlace at, const std::string& text);
    void warn(TextPlace at, const std::string& text) { remark(Remark::Kind::warning, at, text); }
    void warn(const std::string& text) { warn(last, text); }
    const std::vector<Remark>& remarks() const { return kept_remarks; }
    /// Throws FileError with file, line, column and the chain of includes and macro calls.
    [[noreturn]] void fail(TextPlace at, const std::string& text);
    /// Fails at the token that was taken last.
    [[noreturn]] void fail(const std::string& text) { fail(last_place(), text); }
    /// Fails at the next token: "`what` expected, but found 'x'; did you mean 'y'?".
    [[noreturn]] void expected(const std::string& what);
    /// Fails at the token that was asked for last, also if it is taken: it does not belong here.
    [[noreturn]] void misplaced() { wrong_token(""); }
    /// How the arguments are written that are read now, as in "sphere { <centre>, radius }", for messages; "" for none.
    const char* form = "";
    /// Returns the text of a file from a place on, and the file's path.
    std::string_view text_at(TextPlace at) const;
    const std::string& path_of(TextPlace at) const { return texts[at.file]->path; }
    /// Returns a message about the line of a place.
    Message message_at(TextPlace at, const std::string& text) const;

    // Settings that the language itself needs to know.
    /// Returns the version that holds here, 3.7 if none was given yet.
    double version() const { return language_version; }
    /// Was there any #version, in the scene or in a file that it includes?
    bool version_given() const { return has_version; }
    /// Was `clock`, `clock_on` or `frame_number` read? Without them a scene is the same in all frames.
    bool clock_used() const { return uses_clock; }
    /// Was `image_width` or `image_height` read? Without them a scene is the same in pictures of any size.
    bool size_used() const { return uses_size; }
    const InterpreterOptions options;
    std::optional<double> assumed_gamma;  // of global_settings; for srgb
    int noise_generator = 2;              // of global_settings, or by the version; for functions
    bool noise_generator_given = false;   // in global_settings
    std::shared_ptr<int> generator_of_functions = std::make_shared<int>(2);  // the same, also for functions so far

  private:
    friend class FunctionReader;  // reads the expression of a function

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
        std::uint64_t changes = 0;         // of #while: Interpreter::changes when its condition was last read
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

    /// Makes `next` the next token, and executes the directives before it.
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
            Interpreter& in;
            bool before;
            ~Restore() { in.execute(before); }
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
    const TextFile& text() const { return *texts[readings.back().file]; }
    TextPlace place_of(const RawToken& raw) const { return {readings.back().file, raw.at}; }

    // Directives.
    void directive(const RawToken& raw);
    void read_old_directive(const RawToken& raw);
    void leave(const RawToken& from);  // goes to the end of a block
    /// Goes from a branch that is not read to the block's next one. At the block's end closes it and returns null.
    /// `tokens` are those of the text, which an expression in the branch may have left.
    const RawToken* next_branch(const RawToken* tokens, const RawToken* at);
    void branch(const RawToken* at);  // finds the branch that counts, from one that does not
    bool within(const Control& loop, double value) const;
    void choose(const RawToken* at);
    void end_control(const RawToken& raw);
    void break_control(const RawToken& raw);
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
    double parameter();        // (E)
    DVec3 vector_parameter();  // (V)
    std::string string_parameter();
    void arguments(double* values, int count);
    std::shared_ptr<const Thing> object_argument();
    double decode(double value) const;

    // Files.
    bool is_written(const std::string& name) const;
    std::string find_text(const std::string& name, const std::vector<std::string>& extensions);
    std::string load(const std::string& path);

    // Messages.
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
    std::string where(TextPlace at) const;

    /// Counts how deeply the interpreter calls itself.
    struct Depth {
        explicit Depth(Interpreter& in) : in(in) {
            if (++in.depth > in.options.limits.nesting) in.fail(in.last, "this is nested too deeply");
        }
        ~Depth() { --in.depth; }
        Interpreter& in;
    };

    SceneLayer& layer;

    NamePool names;
    Symbols symbols;
    FileSearch search{options.file, options.library};
    std::vector<std::unique_ptr<TextFile>> texts;
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
    double language_version = 3.7;
    bool has_version = false, uses_clock = false, uses_size = false;
    std::uint32_t frame_number = 0, image_width = 0, image_height = 0;  // the numbers of these names
    std::vector<Remark> kept_remarks;
    std::set<std::pair<std::uint64_t, std::string>> told;
};

}  // namespace strahl::pov
