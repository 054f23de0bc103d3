// The language server, by a client that speaks its protocol.
#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

#include "files/error.h"
#include "main/lsp/document.h"
#include "main/lsp/protocol.h"
#include "main/lsp/scene_names.h"
#include "main/lsp/server.h"
#include "tests/unit/scratch.h"

using namespace strahl;
using Json = nlohmann::json;

namespace {

std::string framed(const std::string& content) {
    return "Content-Length: " + std::to_string(content.size()) + "\r\n\r\n" + content;
}

/// Messages that come one after the other, as through a pipe: what is not asked for has not come yet.
class Pipe : public std::streambuf {
  public:
    explicit Pipe(std::vector<std::string> messages) : messages(std::move(messages)) {}

  private:
    int_type underflow() override {
        if (next == messages.size()) return traits_type::eof();
        std::string& text = messages[next++];
        setg(text.data(), text.data(), text.data() + text.size());
        return text.empty() ? underflow() : traits_type::to_int_type(text[0]);
    }
    std::vector<std::string> messages;
    std::size_t next = 0;
};

class Client {
  public:
    explicit Client(bool begin = true) {
        if (!begin) return;
        ask("initialize", {{"capabilities", Json::object()}});
        notify("initialized", Json::object());
    }
    void send(const std::string& content) { contents.push_back(content); }
    int ask(const std::string& method, const Json& params) {
        send(Json{{"jsonrpc", "2.0"}, {"id", ++requests}, {"method", method}, {"params", params}}.dump());
        return requests;
    }
    void notify(const std::string& method, const Json& params) {
        send(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}}.dump());
    }
    void open(const std::string& uri, const std::string& text) {
        notify("textDocument/didOpen",
               {{"textDocument", {{"uri", uri}, {"languageId", "strahl"}, {"version", 1}, {"text", text}}}});
    }
    void change(const std::string& uri, const std::string& text) {
        notify("textDocument/didChange",
               {{"textDocument", {{"uri", uri}, {"version", 2}}}, {"contentChanges", {{{"text", text}}}}});
    }
    int ask_at(const std::string& what, const std::string& uri, std::size_t line, std::size_t character) {
        return ask("textDocument/" + what,
                   {{"textDocument", {{"uri", uri}}}, {"position", {{"line", line}, {"character", character}}}});
    }
    /// Ends the session and lets the server answer all of it.
    void run() {
        ask("shutdown", nullptr);
        notify("exit", nullptr);
        status = serve();
    }
    int serve() {
        std::vector<std::string> messages;
        for (const std::string& content : contents) messages.push_back(framed(content));
        Pipe pipe(std::move(messages));
        std::istream in(&pipe);
        std::ostringstream out;
        const int status = serve_editor(in, out);
        std::istringstream said(out.str());
        while (const auto content = read_frame(said)) {
            const Json message = Json::parse(*content);
            REQUIRE(message.at("jsonrpc") == "2.0");
            if (message.contains("id") && message["id"].is_number())
                answers[message["id"]] = message;
            else if (message.contains("id"))
                refused.push_back(message);
            else
                published.push_back(message.at("params"));
        }
        return status;
    }
    const Json& result(int id) { return answers.at(id).at("result"); }
    int error(int id) { return answers.at(id).at("error").at("code"); }

    std::vector<std::string> contents;  // of the messages so far
    std::map<int, Json> answers;
    std::vector<Json> refused, published;
    int status = -1;

  private:
    int requests = 0;
};

const std::string uri = "file:///nowhere/a.rt";
const std::string eye =
    "camera { position <0, -9, 0>  look_at <0, 0, 0>  sky <0, 0, 1>  angle 50 }\n"
    "light { position <0, -9, 9>  color <1, 1, 1> }\n";

/// Returns what is published about this text.
Json diagnostics_of(const std::string& text, const std::string& uri = ::uri) {
    Client client;
    client.open(uri, text);
    client.run();
    CHECK(client.status == 0);
    REQUIRE(client.published.size() == 1);
    CHECK(client.published[0].at("uri") == uri);
    CHECK(client.published[0].at("version") == 1);
    return client.published[0].at("diagnostics");
}
Json range(std::size_t line, std::size_t begin, std::size_t end) {
    return {{"start", {{"line", line}, {"character", begin}}}, {"end", {{"line", line}, {"character", end}}}};
}
/// Asks about the place of `marked`, where `text` has it first.
Json asked(const std::string& what, const std::string& text, const std::string& marked, const std::string& uri = ::uri,
           std::size_t behind = 1) {
    Client client;
    client.open(uri, text);
    const EditorPosition place = Document("", text).position(text.find(marked) + behind);
    const int id = client.ask_at(what, uri, place.line, place.unit);
    client.run();
    return client.result(id);
}
std::vector<std::string> labels(const Json& items) {
    std::vector<std::string> all;
    for (const Json& item : items) all.push_back(item.at("label"));
    return all;
}
bool offers(const Json& items, const std::string& word) {
    const auto all = labels(items);
    return std::find(all.begin(), all.end(), word) != all.end();
}

}  // namespace

TEST_CASE("frames are read whole, and wrong ones end with an error") {
    const auto read = [](const std::string& text) {
        std::istringstream in(text);
        return read_frame(in);
    };
    CHECK(read("") == std::nullopt);
    CHECK(read("Content-Length: 2\r\n\r\n{}") == "{}");
    CHECK(read("content-length:2\nContent-Type: application/vscode-jsonrpc; charset=utf-8\n\n{}") == "{}");
    CHECK(read(framed(std::string(200'000, 'x'))) == std::string(200'000, 'x'));
    for (const char* const wrong :
         {"\r\n", "{}", "Content-Length: 3\r\n\r\n{}", "Content-Length: 2", "Content-Length: -1\r\n\r\n",
          "Content-Length: 2x\r\n\r\n{}", "Content-Length: 99999999999999999999\r\n\r\n{}",
          "Content-Length: 268435457\r\n\r\n{}", "Content-Type: x\r\n\r\n{}"})
        CHECK_THROWS_AS(read(wrong), FileError);
    CHECK_THROWS_AS(read(std::string(100'000, 'x')), FileError);
    for (const std::string path : {"/a.rt", "/a b/ä%.rt", "/a/100%25", "/x#y?z"})
        CHECK(path_of_uri(uri_of_path(path)) == path);
    CHECK(path_of_uri("file://localhost/a%2fb") == "/a/b");
    CHECK(path_of_uri("untitled:Untitled-1") == "untitled:Untitled-1");
    CHECK(path_of_uri("file:///%zz%4") == "/%zz%4");
}

TEST_CASE("positions count UTF-16 code units and lines of all systems") {
    const Document document("", "aäb\r\n\U0001F600x\ry\n");
    const auto at = [&](std::size_t line, std::size_t unit) { return document.offset({line, unit}); };
    CHECK(at(0, 2) == 3);
    CHECK(at(0, 99) == 4);
    CHECK(at(1, 2) == 10);
    CHECK(at(2, 1) == 13);
    CHECK(at(3, 0) == 14);
    CHECK(at(99, 99) == 14);
    for (const std::size_t i : {0, 1, 3, 4, 6, 10, 11, 12, 13, 14}) {
        const EditorPosition position = document.position(i);
        CHECK(document.offset(position) == i);
    }
    CHECK(document.position(10).unit == 2);
}

TEST_CASE("errors are where strahl check says") {
    const Json list =
        diagnostics_of(eye + "/* Kugel für \U0001F600 */ shpere { <0, 0, 0>, 1 }\nsphere { <0, 0, 0> }\n");
    REQUIRE(list.size() == 2);
    CHECK(list[0].at("range") == range(2, 19, 25));
    CHECK(list[0].at("severity") == 1);
    CHECK(list[0].at("message") == "unknown word 'shpere'; did you mean 'sphere'?");
    CHECK(list[1].at("range").at("start").at("line") == 3);
    std::string many = eye;
    for (int i = 0; i < 20; ++i) many += "shpere { }\n";
    CHECK(diagnostics_of(many).size() == 11);  // ten, and that there may be more
    CHECK(diagnostics_of("").size() == 1);
    CHECK(diagnostics_of(eye + "sphere { <0, 0, 0>, 1 }").empty());
    const Json pov = diagnostics_of("camera { location <0,0,-9> }\n/* ä */ spere { 0, 1 }\n", "file:///nowhere/a.pov");
    REQUIRE(pov.size() == 1);
    CHECK(pov[0].at("range") == range(1, 8, 13));
    // A declaration with an error declares nothing; that its name is unknown later is no further message.
    const Json several = diagnostics_of(
        "#declare A = 2 +* 3;\n#declare M = material { txture { } }\nsphere { 0, A }\nspere { 0, 1 }\n"
        "box { 0, 1 material { M } }\nplane { y, 0 pigmnet { rgb 1 } }\ncamera { location <0,0,-9> }\n",
        "file:///nowhere/a.pov");
    REQUIRE(several.size() == 4);
    for (const auto& [number, line] : {std::pair(0, 0), {1, 1}, {2, 3}, {3, 5}}) {
        CHECK(several[std::size_t(number)].at("range").at("start").at("line") == line);
        CHECK(several[std::size_t(number)].at("severity") == 1);
    }
    // After an error in a loop no more errors are sought.
    CHECK(diagnostics_of("#while (Foo)\nspere { 0, 1 }\n#end\nspere { 0, 1 }\n", "file:///nowhere/a.pov").size() == 1);
}

TEST_CASE("warnings are published, and a change replaces what was") {
    const Json dark =
        diagnostics_of("camera { position <0,-9,0> look_at <0,0,0> sky <0,0,1> angle 50 }\nsphere { <0,0,0>, 1 }");
    REQUIRE(dark.size() == 1);
    CHECK(dark[0].at("severity") == 2);
    CHECK(std::string(dark[0].at("message")).starts_with("the scene has no light"));
    const Json left_out = diagnostics_of(
        "light_source { <9,9,-9>, 1 }\ncamera { location <0,0,-9> }\n  media { }\n"
        "sphere { 0, 1 }\n",
        "file:///nowhere/a.pov");
    REQUIRE(left_out.size() >= 1);
    CHECK(left_out[0].at("severity") == 2);
    CHECK(left_out[0].at("range").at("start") == Json{{"line", 2}, {"character", 2}});
    Client client;
    client.open(uri, "shpere");
    client.change(uri, eye);
    client.notify("textDocument/didSave", {{"textDocument", {{"uri", uri}}}});
    client.notify("textDocument/didClose", {{"textDocument", {{"uri", uri}}}});
    client.run();
    REQUIRE(client.published.size() == 4);
    CHECK(client.published[0].at("diagnostics").size() > 0);
    CHECK(client.published[1].at("diagnostics").empty());
    CHECK(client.published[1].at("version") == 2);
    CHECK(client.published[3].at("diagnostics").empty());
}

TEST_CASE("changes that wait are checked together") {
    std::string all = framed(R"({"id":1,"method":"initialize","params":{}})");
    const std::string id = R"({"method":"textDocument/didChange","params":{"textDocument":{"uri":"x.rt"},)";
    all += framed(R"({"method":"textDocument/didOpen","params":{"textDocument":{"uri":"x.rt","text":"sphere"}}})");
    for (int i = 0; i < 50; ++i) all += framed(id + R"("contentChanges":[{"text":"box"}]}})");
    std::istringstream in(all);
    std::ostringstream out;
    CHECK(serve_editor(in, out) == 1);
    const std::string said = out.str();
    const std::size_t first = said.find("publishDiagnostics");
    CHECK(first != said.npos);
    CHECK(said.find("publishDiagnostics", first + 1) == said.npos);
}

TEST_CASE("hover shows the manual's rows, and the lines of names") {
    const std::string text = eye +
                             "define gold material { rgb <1, .8, .2>  pow 90 }\n"
                             "sphere { <0, 0, 0>, 1  material gold { specular .5 } }\n"
                             "flythrough { duration 9  key { time 3 } }\n"
                             "sphere { <0, 0, 0>, 1  motion { key { time 3 } } }  // pow\n";
    const auto help = [&](const std::string& marked) -> std::string {
        const Json shown = asked("hover", text, marked);
        return shown.is_null() ? "" : shown.at("contents").at("value");
    };
    CHECK(help("pow 90").find("**pow**: exponent of the highlight") == 0);
    CHECK(help("specular").find("strength of the highlight") != std::string::npos);
    CHECK(help("sphere").find("- radius: the radius") != std::string::npos);
    CHECK(help("time 3 } }\ns").find("when the camera is there") != std::string::npos);
    CHECK(help("time 3 } } }").find("the time of the key") != std::string::npos);
    CHECK(help("gold {") == "```\ndefine gold material { rgb <1, .8, .2>  pow 90 }\n```");
    CHECK(help("90") == "");
    CHECK(help("// pow") == "");
    CHECK(asked("hover", text, "pow 90").at("range") == range(2, 40, 43));
}

TEST_CASE("completion offers what may stand there") {
    const std::string text = eye +
                             "define gold material { }\ndefine post cylinder { <0, 0, 0>, <0, 0, 1>, 1 }\n"
                             "#declare Size = 2;\n union { material { s } }\n"
                             "flythrough { key { } }\nsphere { motion { key {  } }  material  }\n"
                             "box { material { rgb  bump solid { } }  post { ro } // x\n";
    const auto at = [&](const std::string& marked, std::size_t behind) {
        return asked("completion", text, marked, uri, behind);
    };
    const Json top = at(" union", 1), parameters = at("{ s }", 3), key = at("key { }", 6), motion = at("key {  }", 6);
    for (const char* const word : {"camera", "sphere", "define", "post", "Size"}) CHECK(offers(top, word));
    for (const char* const word : {"gold", "pow", "rotate"}) CHECK_FALSE(offers(top, word));
    for (const char* const word : {"specular", "rgb", "coat"}) CHECK(offers(parameters, word));
    CHECK_FALSE(offers(parameters, "camera"));
    CHECK(offers(at("union { ", 8), "post"));
    CHECK(offers(key, "look_at"));
    CHECK_FALSE(offers(key, "rotate"));
    CHECK(offers(motion, "rotate"));
    CHECK(labels(at("material  }", 9)) == std::vector<std::string>{"Size", "gold"});
    CHECK(offers(at("rgb  ", 4), "marble"));
    CHECK(offers(at("solid { ", 8), "granite"));
    CHECK(offers(at("{ ro ", 4), "rotate"));
    CHECK(labels(at("// x", 4)).empty());
    CHECK(std::string(parameters[0].at("documentation").at("value")).starts_with("**rgb**: colour of the body"));
}

TEST_CASE("completion in a .pov offers POV-Ray's words and the names of included files") {
    const Scratch folder;
    const std::string path = folder / "a.pov";
    std::ofstream(folder / "more.inc") << "#declare Far = rgb 3;\n#macro Row(N) sphere { 0, N } #end\n";
    const std::string text =
        "#include \"more.inc\"\ncamera { location -9*z }\nlight_source { 9, rgb 1 }\n#declare Own = 1;\n"
        "sphere { 0, 1 pigment { Far } }\n";
    const Json words = asked("completion", text, "Far }", uri_of_path(path), 1);
    for (const char* const word : {"checker", "light_source", "Own", "Far", "Row"}) CHECK(offers(words, word));
    for (const char* const word : {"pow2", "defaultmaterial"}) CHECK_FALSE(offers(words, word));
}

TEST_CASE("definitions are found in the text, in included files, and beside the scene") {
    const Scratch folder;
    const std::string path = folder / "a b.rt", uri = uri_of_path(path), other = uri_of_path(folder / "more.inc");
    std::ofstream(folder / "more.inc") << "// ä\n#declare Far = 3;\n#macro Row(N) #end\n";
    std::ofstream(folder / "a b.tracks") << "track \"x\" { 0 1 linear }\ntrack \"y\" { 0 2 linear }\n";
    std::ofstream(folder / "ball.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string text =
        "#include \"more.inc\"\n" + eye +
        "define gold material { }\n#declare A = 1;\n"
        "sphere { <A, Far, 0>, 1  material gold }\n#declare A = 2;\nsphere { <A + 1, 0, track \"y\" 1>, 1 }\n"
        "mesh { file \"ball.obj\" }\n";
    const auto to = [&](const std::string& marked, std::size_t behind = 1) {
        return asked("definition", text, marked, uri, behind);
    };
    CHECK(to("gold }") == Json{{"uri", uri}, {"range", range(3, 7, 11)}});
    CHECK(to("A, Far") == Json{{"uri", uri}, {"range", range(4, 9, 10)}});
    CHECK(to("A + 1") == Json{{"uri", uri}, {"range", range(6, 9, 10)}});
    CHECK(to("\"more").at("uri") == other);
    CHECK(to("\"ball").at("uri") == uri_of_path(folder / "ball.obj"));
    CHECK(to("\"y\"").at("uri") == uri_of_path(folder / "a b.tracks"));
    CHECK(to("sphere") == nullptr);
    CHECK(to("\"absent.inc\"", 0) == nullptr);

    // Names of included files are known once the text was read without an error; errors in them are at their #include.
    const std::string good = "#include \"more.inc\"\n" + eye + "sphere { <0, Far, 0>, 1 }\n";
    CHECK(asked("definition", good, "Far", uri) == Json{{"uri", other}, {"range", range(1, 9, 12)}});
    CHECK(asked("hover", good, "Far", uri).at("contents").at("value") == "```\n#declare Far = 3;\n```");
    std::ofstream(folder / "more.inc") << "\n#declare Far = ;\n";
    const Json list = diagnostics_of("\n" + good, uri);
    REQUIRE(list.size() == 1);
    CHECK(list[0].at("range") == range(1, 0, 19));
    CHECK(list[0].at("relatedInformation")[0].at("location").at("uri") == other);
    CHECK(list[0].at("relatedInformation")[0].at("location").at("range").at("start").at("line") == 1);
}

TEST_CASE("messages that make no sense are refused, and the session goes on") {
    Client client(false);
    const int early = client.ask_at("hover", uri, 0, 0);
    client.notify("textDocument/didOpen", {{"textDocument", 1}});  // before `initialize`: ignored
    const int begin = client.ask("initialize", {}), again = client.ask("initialize", {});
    client.send("{");
    client.send("[]");
    client.send("\"\xff\"");
    client.send(std::string(100'000, '['));
    const std::string deep = std::string(300'000, '[') + std::string(300'000, ']');
    client.send("{\"id\":5,\"method\":\"exit\",\"params\":" + deep + "}");
    client.send("{\"id\":" + deep + ",\"method\":\"exit\"}");
    client.send(R"({"jsonrpc":"2.0","id":{},"method":"shutdown"})");
    client.send(R"({"jsonrpc":"2.0","id":null,"method":7})");
    client.send(R"({"jsonrpc":"2.0","id":77,"result":null})");  // an answer to nothing
    const int unknown = client.ask("textDocument/rename", {}), closed = client.ask_at("hover", uri, 0, 0);
    client.open(uri, eye);
    for (const Json& position : {Json{{"line", -1}, {"character", 0}}, Json{{"line", 1e300}, {"character", 0}},
                                 Json{{"line", "0"}}, Json::array(), Json()})
        CHECK(client.ask("textDocument/hover", {{"textDocument", {{"uri", uri}}}, {"position", position}}) > 0);
    const int far = client.ask_at("completion", uri, 4'000'000'000, 4'000'000'000);
    client.notify("textDocument/didChange", {{"textDocument", {{"uri", uri}}}, {"contentChanges", {{{"range", 1}}}}});
    client.notify("textDocument/didChange", {{"textDocument", {{"uri", "b"}}}, {"contentChanges", Json::array()}});
    client.notify("$/setTrace", {{"value", "off"}});
    client.run();
    CHECK(client.status == 0);
    CHECK(client.error(early) == -32002);
    CHECK(client.result(begin).at("capabilities").at("hoverProvider") == true);
    CHECK(client.error(again) == -32600);
    CHECK(client.refused.size() == 8);
    CHECK(client.error(unknown) == -32601);
    CHECK(client.error(closed) == -32602);
    for (int id = closed + 1; id < far; ++id) CHECK(client.error(id) == -32602);
    CHECK(client.result(far).is_array());

    Client silent;
    CHECK(silent.serve() == 1);  // the editor has ended
}

TEST_CASE("any bytes end in answers or in an error") {
    std::mt19937 random(7);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const std::vector<std::string> pieces{
        "{",     "}",    "\"",      "\\u0000", "/*",   "#",       "#include \"a.rt\"", "define a ", "-1",
        "1e999", "\xff", "\\ud83d", "[",       "null", "solid {", "track \"",          "\\\"",      ","};
    std::size_t refused = 0;
    for (int i = 0; i < 300; ++i) {
        Client client;
        client.open(uri, eye +
                             "define gold material { rgb marble { colors { 0 <1, 1, 1> } } }\n#declare A = 1;\n"
                             "sphere { <A, 0, 0>, 1  material gold }\n");
        for (const char* const what : {"hover", "completion", "definition"})
            for (int k = 0; k < 3; ++k) client.ask_at(what, uri, below(6), below(80));
        std::string all;
        for (std::string content : client.contents) {
            for (std::size_t k = below(3); k > 0; --k) {
                const std::size_t at = below(content.size() + 1);
                const std::string& piece = pieces[below(pieces.size())];
                content = content.substr(0, at) + piece + content.substr(std::min(content.size(), at + below(4)));
            }
            all += framed(content);
        }
        if (i % 4 == 0) all[below(all.size())] = static_cast<char>(random());
        std::istringstream in(all);
        std::ostringstream out;
        try {
            serve_editor(in, out);
        } catch (const FileError&) {
            ++refused;
        }
        std::istringstream said(out.str());
        while (const auto content = read_frame(said)) CHECK(Json::accept(*content));
    }
    CHECK(refused > 3);
}

TEST_CASE("lsp: an outline lists blocks and declarations of the top level") {
    Client client;
    client.open(uri, eye + "define gold material { rgb <1, .8, 0> }\nsphere {\n  <0, 0, 0>, 1 material gold\n}\n");
    client.open("file:///nowhere/b.pov", "#declare R = 2;\n#macro M(A) box { A, 1 } #end\nsphere { 0, R }\ncamera {");
    const int rt = client.ask("textDocument/documentSymbol", {{"textDocument", {{"uri", uri}}}});
    const int pov = client.ask("textDocument/documentSymbol", {{"textDocument", {{"uri", "file:///nowhere/b.pov"}}}});
    client.run();
    const auto names = [](const Json& symbols) {
        std::vector<std::string> all;
        for (const Json& symbol : symbols) all.push_back(symbol.at("name"));
        return all;
    };
    CHECK(names(client.result(rt)) == std::vector<std::string>{"camera", "light", "gold", "sphere"});
    CHECK(client.result(rt)[2].at("selectionRange") == range(2, 7, 11));
    CHECK(client.result(rt)[3].at("range").at("end") == Json{{"line", 5}, {"character", 1}});
    CHECK(names(client.result(pov)) == std::vector<std::string>{"R", "M", "sphere", "camera"});
}

TEST_CASE("lsp: a quick fix writes the word that was meant") {
    const auto fixed = [](const std::string& text, const std::string& uri) {
        Client client;
        client.open(uri, text);
        const Json diagnostics = diagnostics_of(text, uri);
        const int id = client.ask(
            "textDocument/codeAction",
            {{"textDocument", {{"uri", uri}}}, {"range", range(0, 0, 0)}, {"context", {{"diagnostics", diagnostics}}}});
        client.run();
        const Json list = client.result(id);
        return list.empty() ? Json() : list[0].at("edit").at("changes").at(uri)[0];
    };
    const std::string pov = "file:///nowhere/b.pov";
    CHECK(fixed(eye + "shpere { <0, 0, 0>, 1 }", uri) == Json{{"range", range(2, 0, 6)}, {"newText", "sphere"}});
    CHECK(fixed(eye + "ball { <0, 0, 0>, 1 }", uri) == Json{{"range", range(2, 0, 4)}, {"newText", "sphere"}});
    CHECK(fixed(eye + "sphere { <0, 0, 0>, 0 }", uri) == Json());
    CHECK(fixed("sphere { 0, 1 pigmnet { rgb 1 } }", pov) == Json{{"range", range(0, 14, 21)}, {"newText", "pigment"}});
}
