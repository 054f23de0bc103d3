#include "main/lsp/server.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "files/error.h"
#include "files/read_file.h"
#include "files/regular_file.h"
#include "files/utf8.h"
#include "main/lsp/document.h"
#include "main/lsp/problems.h"
#include "main/lsp/protocol.h"
#include "main/lsp/questions.h"
#include "main/lsp/scene_names.h"

namespace strahl {
namespace {

using Json = nlohmann::json;

/// The error that answers a message which cannot be followed. `code` is one of JSON-RPC 2.0 or of the protocol.
struct Refusal {
    int code;
    const char* message;
};

Json json_of(const EditorPosition& position) { return {{"line", position.line}, {"character", position.unit}}; }
Json range_of(const Document& document, std::size_t begin, std::size_t end) {
    return {{"start", json_of(document.position(begin))}, {"end", json_of(document.position(end))}};
}
Json range_of(const DocumentSlice& slice) { return range_of(*slice.document, slice.at, slice.at + slice.size); }
std::size_t offset_of(const Document& document, const Json& position) {
    const Json &line = position.at("line"), &unit = position.at("character");
    if (!line.is_number_unsigned() || !unit.is_number_unsigned())
        throw Refusal{-32602, "line and character are whole numbers from 0 on"};
    return document.offset({line, unit});
}
Json markdown(const std::string& text) { return {{"kind", "markdown"}, {"value", text}}; }

/// Reads JSON that is not nested deeper than messages are: values are copied by recursion.
Json parse(const std::string& content) {
    const auto limit = [](int depth, Json::parse_event_t, const Json&) {
        if (depth > 64) throw Refusal{-32600, "this message is nested too deeply"};
        return true;
    };
    Json message = Json::parse(content, limit, false);
    if (message.is_discarded()) throw Refusal{-32700, "this is not JSON"};
    if (!message.is_object()) throw Refusal{-32600, "a message is an object"};
    return message;
}

class Server {
  public:
    Server(std::istream& in, std::ostream& out) : in(in), out(out) {}
    int run();

  private:
    struct OpenText {
        EditedScene scene;
        Json version{};
        bool checked = false;
        bool slow = false;  // the last check took more than a second
        const Document& document() const { return *scene.document; }
    };
    /// A place that the editor asks about.
    struct AskedPlace {
        const EditedScene& scene;
        std::size_t at;
    };

    void handle(const std::string& content);
    Json answer(const std::string& method, const Json& params);
    void take_notice(const std::string& method, const Json& params);
    void send(Json message);

    void change(const Json& params);
    void publish(const std::string& uri, OpenText& open);
    Json diagnostic(const Document& document, const Problem& problem) const;
    const OpenText& open_text(const Json& params) const;
    AskedPlace place_in(const Json& params) const;
    std::shared_ptr<const Document> read(const std::string& path) const;
    Json hover(const AskedPlace& place) const;
    Json definition(const AskedPlace& place) const;
    Json completion(const AskedPlace& place) const;
    Json outline(const Json& params) const;
    Json fixes(const Json& params) const;

    std::istream& in;
    std::ostream& out;
    std::map<std::string, OpenText> texts;  // by their URIs
    bool initialized = false, shut_down = false, ended = false;
};

int Server::run() {
    while (!ended) {
        if (in.rdbuf()->in_avail() <= 0)  // else the next message may change the text again
            for (auto& [uri, open] : texts)
                if (!std::exchange(open.checked, true)) publish(uri, open);
        const std::optional<std::string> content = read_frame(in);
        if (!content) break;
        handle(*content);
    }
    return shut_down ? 0 : 1;
}

void Server::send(Json message) {
    message["jsonrpc"] = "2.0";
    write_frame(out, message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void Server::handle(const std::string& content) {
    Json id, error;
    bool request = true;
    try {
        const Json message = parse(content);
        if (message.contains("result") || message.contains("error")) return;  // the server asks nothing
        request = message.contains("id") || !message.contains("method");
        if (request) id = message.value("id", Json());
        if (!id.is_string() && !id.is_number_integer() && request) {
            id = nullptr;
            throw Refusal{-32600, "the id of a request is a string or a whole number"};
        }
        const std::string method = message.at("method");
        const Json params = message.value("params", Json::object());
        if (!request) return take_notice(method, params);
        return send({{"id", id}, {"result", answer(method, params)}});
    } catch (const Refusal& refusal) {
        error = {{"code", refusal.code}, {"message", refusal.message}};
    } catch (const Json::exception& wrong) {
        error = {{"code", -32602}, {"message", wrong.what()}};
    } catch (const OutputError&) {
        throw;
    } catch (const std::exception& failure) {
        error = {{"code", -32603}, {"message", failure.what()}};
    }
    if (request)
        send({{"id", id}, {"error", error}});
    else
        std::cerr << "strahl lsp: " << printable(error["message"].get<std::string>()) << '\n';
}

Json Server::answer(const std::string& method, const Json& params) {
    if (shut_down) throw Refusal{-32600, "the server has been shut down"};
    if (method == "initialize") {
        if (std::exchange(initialized, true)) throw Refusal{-32600, "the server has been initialized before"};
        const Json sync{{"openClose", true}, {"change", 1}, {"save", true}};
        return {{"capabilities",
                 {{"textDocumentSync", sync},
                  {"hoverProvider", true},
                  {"definitionProvider", true},
                  {"completionProvider", Json::object()},
                  {"documentSymbolProvider", true},
                  {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}}}},
                {"serverInfo", {{"name", "strahl"}}}};
    }
    if (!initialized) throw Refusal{-32002, "'initialize' must come first"};
    if (method == "shutdown") return shut_down = true, Json();
    if (method == "textDocument/hover") return hover(place_in(params));
    if (method == "textDocument/definition") return definition(place_in(params));
    if (method == "textDocument/completion") return completion(place_in(params));
    if (method == "textDocument/documentSymbol") return outline(params);
    if (method == "textDocument/codeAction") return fixes(params);
    throw Refusal{-32601, "the server does not know this method"};
}

void Server::take_notice(const std::string& method, const Json& params) {
    if (method == "exit") ended = true;
    if (!initialized || shut_down) return;
    if (method == "textDocument/didOpen") {
        const Json& text = params.at("textDocument");
        const std::string uri = text.at("uri");
        texts[uri] = {{std::make_shared<const Document>(path_of_uri(uri), text.at("text"))},
                      text.value("version", Json())};
    } else if (method == "textDocument/didChange") {
        change(params);
    } else if (method == "textDocument/didSave") {
        const std::string saved = params.at("textDocument").at("uri");
        for (auto& [uri, open] : texts) open.checked &= open.slow && uri != saved;  // each may include what was saved
    } else if (method == "textDocument/didClose") {
        const std::string uri = params.at("textDocument").at("uri");
        if (texts.erase(uri))
            send({{"method", "textDocument/publishDiagnostics"},
                  {"params", {{"uri", uri}, {"diagnostics", Json::array()}}}});
    }
}

void Server::change(const Json& params) {
    const Json &text = params.at("textDocument"), &changes = params.at("contentChanges");
    const auto found = texts.find(text.at("uri").get<std::string>());
    if (found == texts.end()) throw Refusal{-32602, "a text that is not open has changed"};
    if (changes.empty()) return;
    if (changes.back().contains("range")) throw Refusal{-32602, "changed texts must come whole"};
    OpenText& open = found->second;
    open.scene.document = std::make_shared<const Document>(open.document().path, changes.back().at("text"));
    open.version = text.value("version", Json()), open.checked &= open.slow;
}

void Server::publish(const std::string& uri, OpenText& open) {
    Json list = Json::array();
    const std::clock_t begin = std::clock();
    for (const Problem& problem : check_scene(open.document().text, open.document().path, open.scene.files))
        list.push_back(diagnostic(open.document(), problem));
    open.slow = std::clock() - begin > CLOCKS_PER_SEC;
    Json params{{"uri", uri}, {"diagnostics", list}};
    if (open.version.is_number_integer()) params["version"] = open.version;
    send({{"method", "textDocument/publishDiagnostics"}, {"params", params}});
}

/// Places a problem: where it is, or else where its file is included, or else in the first line.
Json Server::diagnostic(const Document& document, const Problem& problem) const {
    const std::string_view text = document.text;
    const Message& said = problem.message;
    const bool here = said.file == document.path;
    const std::size_t line = std::max<std::size_t>(here ? said.line : said.caller, 1) - 1;
    const std::size_t line_end = document.line_end(line);
    std::size_t begin = document.line_start(line), end = line_end;
    if (here && said.column > 0) {
        begin = forth(text, begin, line_end, static_cast<int>(said.column - 1));
        end = forth(text, begin, line_end, static_cast<int>(std::max<std::size_t>(said.length, 1)));
        if (said.length <= 1) end = std::max(end, begin + cursor_at(text.substr(begin), 0).at.text.size());
    } else {
        begin = std::min(text.find_first_not_of(" \t", begin), end);
    }
    Json own{{"range", range_of(document, begin, end)},
             {"severity", problem.warning ? 2 : 1},
             {"source", "strahl"},
             {"message", said.text + said.calls}};
    if (!here && said.line > 0) {
        const Json place = json_of({said.line - 1, std::max<std::size_t>(said.column, 1) - 1});
        const Json location{{"uri", uri_of_path(said.file)}, {"range", {{"start", place}, {"end", place}}}};
        own["message"] = said.file + ":" + std::to_string(said.line) + ": " + said.text + said.calls;
        own["relatedInformation"] = {{{"location", location}, {"message", said.text + said.calls}}};
    }
    return own;
}

const Server::OpenText& Server::open_text(const Json& params) const {
    const auto found = texts.find(params.at("textDocument").at("uri").get<std::string>());
    if (found == texts.end()) throw Refusal{-32602, "this text is not open"};
    return found->second;
}

Server::AskedPlace Server::place_in(const Json& params) const {
    const OpenText& open = open_text(params);
    return {open.scene, offset_of(open.document(), params.at("position"))};
}

std::shared_ptr<const Document> Server::read(const std::string& path) const try {
    for (const auto& [uri, open] : texts)
        if (open.document().path == path) return open.scene.document;
    constexpr std::size_t limit = std::size_t(64) << 20;
    const RegularFile regular(path);  // throws for a pipe, which might never end
    return std::make_shared<const Document>(path, read_text(path, limit));
} catch (const FileError&) {
    return nullptr;
}

Json Server::definition(const AskedPlace& place) const {
    const auto found = definition_at(place.scene, place.at, [&](const std::string& path) { return read(path); });
    if (!found) return nullptr;
    std::string uri = uri_of_path(found->document->path);
    for (const auto& [own, open] : texts)
        if (open.scene.document == found->document) uri = own;
    return {{"uri", uri}, {"range", range_of(*found)}};
}

Json Server::hover(const AskedPlace& place) const {
    DocumentSlice word;
    const auto read = [&](const std::string& path) { return this->read(path); };
    const std::string help = help_at(place.scene, place.at, read, word);
    if (help.empty()) return nullptr;
    return {{"contents", markdown(help)}, {"range", range_of(word)}};
}

Json Server::completion(const AskedPlace& place) const {
    constexpr std::array kinds{6, 22, 14};  // the protocol's numbers: a variable, a structure, a keyword
    Json items = Json::array();
    const auto read = [&](const std::string& path) { return this->read(path); };
    for (const OfferedWord& own : words_at(place.scene, place.at, read)) {
        items.push_back({{"label", own.word}, {"kind", kinds[own.kind]}});
        if (!own.help.empty()) items.back()["documentation"] = markdown(own.help);
    }
    return items;
}

Json Server::outline(const Json& params) const {
    const Document& document = open_text(params).document();
    const auto range = [&](std::string_view slice) {
        const auto at = static_cast<std::size_t>(slice.data() - document.text.data());
        return range_of(document, at, at + slice.size());
    };
    Json symbols = Json::array();
    for (const SceneBlock& block : blocks_in(document.text))
        symbols.push_back({{"name", block.name},
                           {"kind", block.declared ? 13 : 19},  // the protocol's numbers: a variable, an object
                           {"range", range(block.whole)},
                           {"selectionRange", range(block.declared ? block.name : block.whole)}});
    return symbols;
}

/// Offers what a message names: the word that was meant, or the line that includes a file.
Json Server::fixes(const Json& params) const {
    const Document& document = open_text(params).document();
    const auto between = [](const std::string& text, std::string_view first, std::string_view last) {
        const std::size_t begin = text.find(first), end = text.find(last, begin + first.size());
        if (begin == text.npos || end == text.npos) return std::string();
        return text.substr(begin + first.size(), end - begin - first.size());
    };
    Json list = Json::array();
    for (const Json& told : params.at("context").at("diagnostics")) {
        const std::string message = told.at("message");
        const Json& range = told.at("range");
        std::string meant = between(message, "did you mean '", "'?"), file = between(message, "#include \"", "\"");
        if (meant.empty()) meant = between(message, "; use '", "'");
        if (meant.find_first_of(" {") != meant.npos) continue;  // it is more than a word
        Json edit{{"range", range}, {"newText", meant}};
        std::string title = "Write '" + meant + "'";
        if (!meant.empty()) {
            const std::size_t at = offset_of(document, range.at("start"));
            if (at < document.text.size() && document.text[at] == '"') edit["newText"] = '"' + meant + '"';
        } else if (!file.empty()) {
            edit = {{"range", range_of(document, 0, 0)}, {"newText", "#include \"" + file + "\"\n"}};
            title = "Include " + file;
        } else {
            continue;
        }
        const Json changes{{params.at("textDocument").at("uri").get<std::string>(), Json::array({edit})}};
        list.push_back({{"title", title},
                        {"kind", "quickfix"},
                        {"diagnostics", Json::array({told})},
                        {"edit", {{"changes", changes}}}});
    }
    return list;
}

}  // namespace

int serve_editor(std::istream& in, std::ostream& out) { return Server(in, out).run(); }

}  // namespace strahl
