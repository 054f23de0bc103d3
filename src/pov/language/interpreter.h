// Reads a POV-Ray scene: executes its directives, macros and expressions, and hands the rest on, token by token.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/error.h"
#include "num/vec.h"
#include "pov/language/interpreter_options.h"
#include "pov/language/scene_layer.h"
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
    ~Interpreter();
    Interpreter(const Interpreter&) = delete;

    // Tokens.
    /// Returns the code of the next token: of a sign, of a reserved word, `number_code`, `string_code`, `new_name_code`
    /// (an identifier that is not declared), `value_code` (one that is, or an element of an array) or `end_code`.
    std::uint16_t code();
    bool at(TokenCode wanted) { return code() == wanted.value; }
    /// Takes the next token if it is this one.
    bool accept(TokenCode wanted);
    /// Takes the next token if it is this one and stands right here, with no directive before it. Between the layers of
    /// a declared texture POV-Ray executes none.
    bool accept_here(TokenCode wanted);
    /// Takes this token, or fails: "'{' expected, but found ...".
    void expect(TokenCode wanted);
    /// Takes the next token, whatever it is.
    void skip();
    /// Takes the commas that may stand between two values.
    void skip_comma() { accept(','); }
    bool at_end() { return code() == end_code; }
    /// Take '{' and '}', and limit how deep blocks are nested.
    void begin_block();
    void end_block();
    /// Counts memory that a thing at this place needs. Fails if the scene needs too much.
    void count_bytes(std::size_t bytes, TextPlace at);
    /// Reads over a whole block, from '{' to its '}'.
    void skip_block();

    // Identifiers.
    /// Returns the kind of the identifier's value that comes next, `none` if there is no declared identifier.
    ValueKind kind();
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
    const std::vector<std::string>& files() const;

    // Messages.
    /// Returns the place of the next token, and of the one that was taken last.
    TextPlace place();
    TextPlace last_place() const;
    void remark(Remark::Kind kind, TextPlace at, const std::string& text);
    void warn(const std::string& text) { remark(Remark::Kind::warning, last_place(), text); }
    const std::vector<Remark>& remarks() const;
    /// Throws FileError with file, line, column and the chain of includes and macro calls.
    [[noreturn]] void fail(TextPlace at, const std::string& text);
    /// Fails at the token that was taken last.
    [[noreturn]] void fail(const std::string& text) { fail(last_place(), text); }
    /// Fails at the next token: "`what` expected, but found 'x'; did you mean 'y'?".
    [[noreturn]] void expected(const std::string& what);
    /// Fails at the token that was asked for last, also if it is taken: it does not belong here.
    [[noreturn]] void misplaced();
    /// How the arguments are written that are read now, as in "sphere { <centre>, radius }", for messages; "" for none.
    const char* form = "";
    /// Returns the text of a file from a place on, and the file's path.
    std::string_view text_at(TextPlace at) const;
    const std::string& path_of(TextPlace at) const;
    /// Returns a message about the line of a place.
    Message message_at(TextPlace at, const std::string& text) const;

    // Settings that the language itself needs to know.
    /// Returns the version that holds here, 3.7 if none was given yet.
    double version() const;
    /// Was there any #version, in the scene or in a file that it includes?
    bool version_given() const;
    /// Was `clock`, `clock_on` or `frame_number` read? Without them a scene is the same in all frames.
    bool clock_used() const;
    /// Was `image_width` or `image_height` read? Without them a scene is the same in pictures of any size.
    bool size_used() const;
    const InterpreterOptions& options() const;
    std::optional<double> assumed_gamma;  // of global_settings; for srgb
    int noise_generator = 2;              // of global_settings, or by the version; for functions
    bool noise_generator_given = false;   // in global_settings

    struct State;

  private:
    std::unique_ptr<State> state;
};

}  // namespace strahl::pov
