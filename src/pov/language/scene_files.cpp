// Files that a scene reads and writes: #fopen, #read and #write.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "files/error.h"
#include "files/read_file.h"
#include "files/words.h"
#include "pov/language/interpreter.h"

namespace strahl::pov {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_text = 256u << 20;  // of one text

}  // namespace

bool Interpreter::is_written(const std::string& name) const { return kept_files.contains(name); }

/// Finds a text on the disk, or one that the scene has written, whose path is its name.
std::string Interpreter::find_text(const std::string& name, const std::vector<std::string>& extensions) {
    return is_written(name) ? name : find_file(name, extensions, true);
}

std::string Interpreter::load(const std::string& path) {
    if (!is_written(path)) return read_text(path, most_text);
    std::string text = kept_files.at(path)->str();
    *bytes += text.size() * sizeof(RawToken);
    check_limits();
    return text;
}

std::string Interpreter::find_file(const std::string& name, const std::vector<std::string>& extensions, bool must) {
    const auto before = static_cast<std::ptrdiff_t>(search.paths().size());
    const FileSearch::FoundFile result = search.find(name, extensions);
    if (options.files)
        options.files->insert(options.files->end(), search.paths().begin() + before, search.paths().end());
    if (!result.warning.empty()) warn(last, result.warning);
    if (must && result.path.empty()) fail(last, result.fault);
    return result.path;
}

void Interpreter::open_file() {
    const RawToken& name = raw_name("a file's identifier");
    const TextPlace at = last;
    if (const Symbol* symbol = symbols.find(name.index); symbol && symbol->value.kind == ValueKind::file)
        fail(at, "the file " + strahl::quoted(names.text(name.index)) + " is open already");
    const std::string file_name = read_file_name();
    auto file = std::make_shared<FileThing>();
    if (accept(word("read"))) {
        file->path = find_text(file_name, {});
        file->reading = std::make_unique<TextFile>(file->path, load(file->path), names);
    } else {
        const bool append = code() == word("append");
        if (!append && code() != word("write")) expected("'read', 'write' or 'append'");
        take();
        if (options.write_folder.empty()) {
            std::shared_ptr<std::ostringstream>& kept = kept_files[file_name];
            if (!append || !kept) kept = std::make_shared<std::ostringstream>();
            file->path = file_name, file->writing = kept;
            warn(at, strahl::quoted(file_name) + " is not written to the disk; only the scene itself can read it");
        } else {
            const fs::path name_only(file_name);
            if (name_only.has_parent_path() || file_name == ".." || file_name.find('\\') != file_name.npos)
                fail(at, "a scene may write only to files right in the folder that is allowed, not to " +
                             strahl::quoted(file_name));
            file->path = (fs::path(options.write_folder) / name_only).string();
            std::error_code error;
            if (fs::exists(file->path, error) && !fs::is_regular_file(file->path, error))
                fail(at, strahl::quoted(file->path) + " is not a regular file");
            file->writing = std::make_shared<std::ofstream>(
                file->path, append ? std::ios::binary | std::ios::app : std::ios::binary);
            if (!*file->writing) throw OutputError("cannot write " + strahl::quoted(file->path));
        }
    }
    Symbol* symbol = symbols.find(name.index);
    if (!symbol) symbol = &symbols.add(name.index, true);
    value_of(*symbol) = {ValueKind::file, {}, std::move(file)};
}

void Interpreter::read_file() {
    expect('(');
    const RawToken& name = raw_name("a file's identifier");
    const TextPlace at = last;
    Symbol* handle = symbols.find(name.index);
    if (!handle || value_of(*handle).kind != ValueKind::file)
        fail(at, strahl::quoted(names.text(name.index)) + " is not an open file");
    const auto file = std::static_pointer_cast<const FileThing>(value_of(*handle).thing);
    if (!file->reading) fail(at, "the file is open for writing");
    const TextFile& from = *file->reading;
    const auto skip = [&](std::uint16_t code) {
        const bool found = from.tokens[file->next].code == code;
        if (found) ++file->next;
        return found;
    };
    const auto number_in_file = [&] {
        const bool negative = skip('-');
        if (!negative) skip('+');
        if (from.tokens[file->next].code != number_code)
            fail(at, "a number expected in line " + std::to_string(line_number(from.text, from.tokens[file->next].at)) +
                         " of " + strahl::quoted(file->path));
        const double value = from.tokens[file->next++].number;
        return negative ? -value : value;
    };
    const auto sign = [&](char wanted) {
        if (cursor->code != wanted) return false;
        ++cursor;
        return true;
    };
    bool ended = false;
    sign(',');
    while (!sign(')')) {
        const RawToken& target = raw_name("an identifier to read into");
        NamedValue value;
        const RawToken& token = from.tokens[file->next];
        if (token.code == end_code) {
            ended = true;
        } else if (token.code == string_code) {
            value = named(std::string(std::string_view(from.text).substr(token.at + 1, token.index)));
            ++file->next;
        } else if (skip('<')) {
            Components read;
            read.count = 0;
            while (!skip('>')) {
                if (read.count == 5)
                    fail(at, "a vector in " + strahl::quoted(file->path) + " has more than five components");
                read.value[read.count++] = number_in_file();
                skip(',');
            }
            if (read.count < 2)
                fail(at, "a vector in " + strahl::quoted(file->path) + " has fewer than two components");
            value = named(read);
        } else {
            value = {ValueKind::number, {number_in_file()}, nullptr};
        }
        skip(',');
        Symbol* symbol = symbols.find(target.index);
        if (symbol && value_of(*symbol).kind == ValueKind::array && cursor->code == '[') {
            std::shared_ptr<ArrayThing> array;
            std::size_t index = 0;
            raw_element(&value_of(*symbol), array, index);
            if (!ended) array->elements[index] = std::move(value);
        } else if (!ended) {
            if (!symbol) symbol = &symbols.add(target.index, true);
            value_of(*symbol) = std::move(value);
        }
        sign(',');
    }
    // The identifier is gone as soon as nothing is left, so that #while (defined(FILE)) ends.
    if (from.tokens[file->next].code == end_code)
        if (Symbol* symbol = symbols.find(name.index)) symbols.remove(*symbol);
}

void Interpreter::write_file() {
    expect('(');
    const RawToken& name = raw_name("a file's identifier");
    const Symbol* handle = symbols.find(name.index);
    if (!handle || handle->value.kind != ValueKind::file)
        fail(last, strahl::quoted(names.text(name.index)) + " is not an open file");
    const auto file = std::static_pointer_cast<const FileThing>(handle->value.thing);
    if (file->reading) fail(last, "the file is open for reading");
    accept(',');
    std::ostream& writing = *file->writing;
    const auto before = writing.tellp();
    const auto print = [&](double value) {
        char text[40];
        std::snprintf(text, sizeof text, "%g", value);
        writing << text;
    };
    std::uint16_t binary = 0;
    while (code() != ')') {
        switch (code()) {
            case word("uint8"):
            case word("sint8"):
            case word("uint16le"):
            case word("uint16be"):
            case word("sint16le"):
            case word("sint16be"):
            case word("sint32le"):
            case word("sint32be"):
                binary = next.code;
                take();
                accept(',');
                continue;
        }
        if (at_string()) {
            writing << read_string();
        } else {
            Components value;
            sum(value);
            if (binary) {
                const bool is_signed = reserved_words[binary - first_word_code][0] == 's';
                const std::string_view type = reserved_words[binary - first_word_code];
                const int size = type.find("32") != type.npos ? 4 : type.find("16") != type.npos ? 2 : 1;
                const double most = std::ldexp(1., 8 * size - (is_signed ? 1 : 0)) - 1;
                for (int c = 0; c < value.count; ++c) {
                    const auto whole = static_cast<std::int64_t>(
                        std::clamp(std::floor(value.value[c] + .5), is_signed ? -most - 1 : 0., most));
                    for (int i = 0; i < size; ++i) {
                        const int byte = type.ends_with("be") ? size - 1 - i : i;
                        writing.put(static_cast<char>(whole >> (8 * byte) & 255));
                    }
                }
            } else if (value.count == 1) {
                print(value.value[0]);
            } else {
                for (int i = 0; i < value.count; ++i) {
                    writing << (i ? "," : "<");
                    print(value.value[i]);
                }
                writing << "> ";
            }
        }
        accept(',');
        if (!writing) throw OutputError("cannot write " + strahl::quoted(file->path));
    }
    if (is_written(file->path)) *bytes += static_cast<std::size_t>(writing.tellp() - before), check_limits();
    expect(')');
}

}  // namespace strahl::pov
