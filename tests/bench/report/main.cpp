// Table, JSON and plot data of a measurement: bench_report ROWS.tsv FOLDER MACHINE > results.md
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <stdexcept>

#include "rows.h"

namespace {

using namespace strahl::bench;

const std::array<std::pair<const char*, const char*>, 10> programs{{{"float", "Strahl float"},
                                                                    {"double", "Strahl double"},
                                                                    {"float-16", "Strahl float, 16 bits"},
                                                                    {"double-16", "Strahl double, 16 bits"},
                                                                    {"render-float", "`strahl render`, float"},
                                                                    {"render-double", "`strahl render`, double"},
                                                                    {"embree", "Embree"},
                                                                    {"tachyon", "Tachyon"},
                                                                    {"povray", "POV-Ray"},
                                                                    {"povray-16", "POV-Ray, 16 bits"}}};

std::string title(const std::string& program) {
    for (const auto& [name, words] : programs)
        if (program == name) return words;
    return program;
}

std::string text(const char* format, double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}
/// Three significant digits.
std::string digits(double value) {
    if (!(value > 0)) return "0";
    return text(value < 9.995 ? value < .9995 ? "%.3f" : "%.2f" : value < 99.95 ? "%.1f" : "%.0f", value);
}

const Summary* any_of_ours(const World& world) {
    const Summary* s = world.find("double");
    return s ? s : world.find("float");
}

/// Seconds of two of our programs, and how many times as long the others take.
void write_overview(const std::vector<World>& worlds, const std::array<const char*, 2>& ours,
                    const std::vector<const char*>& peers) {
    std::cout << "| Scene | Threads | " << title(ours[0]) << " | " << title(ours[1]) << " |";
    for (const char* peer : peers) std::cout << ' ' << title(peer) << ": to float | to double |";
    std::cout << "\n|---|--:|--:|--:|";
    for (std::size_t i = 0; i < peers.size(); ++i) std::cout << "--:|--:|";
    std::cout << '\n';
    for (const World& world : worlds) {
        std::cout << "| " << world.name << " | " << world.threads;
        for (const char* own : ours) {
            const Summary* s = world.find(own);
            std::cout << " | " << (s ? digits(s->row.seconds()) + " s" : "");
        }
        for (const char* peer : peers)
            for (const char* own : ours) {
                const Summary* s = world.find(peer);
                const bool both = s && s->ratio.contains(own);
                std::cout << " | " << (both ? digits(s->ratio.at(own)) : "");
            }
        std::cout << " |\n";
    }
}

void write_details(const World& world) {
    const Row& first = world.programs[0].row;
    std::cout
        << "\n## " << world.name << "\n\n"
        << first.width << 'x' << first.height << ", " << first.objects << " objects, " << first.lights << " lights, "
        << world.threads << " threads\n\n"
        << "| Program | Build s | Trace s | Rays | Mrays/s | Memory MiB | Largest difference | Pixels differing by "
           "more than 1/255 |\n|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const auto& [row, ratio] : world.programs) {
        std::cout << "| " << title(row.program) << " | " << digits(row.build) << " | " << digits(row.trace) << " | "
                  << (row.rays > 0 ? text("%.0f", row.rays) : "") << " | "
                  << (row.rays > 0 && row.trace > 0 ? digits(row.rays / row.trace * 1e-6) : "") << " | "
                  << text("%.0f", row.memory / 1024) << " | " << (row.difference ? text("%.2g", *row.difference) : "")
                  << " | " << (row.beyond ? text("%.4f", 100 * *row.beyond / row.width / row.height) + " %" : "")
                  << " |\n";
    }
}

/// All names are our own except the machine's.
std::string quoted(const std::string& words) {
    std::string result = "\"";
    for (const char c : words) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) >= ' ') result += c;
    }
    return result + '"';
}

void write_run(std::ostream& out, const Row& row) {
    const auto maybe = [](const std::optional<double>& value) { return value ? text("%.9g", *value) : "null"; };
    out << "{\"world\": " << quoted(row.world) << ", \"program\": " << quoted(row.program)
        << ", \"objects\": " << row.objects << ", \"lights\": " << row.lights << ", \"width\": " << row.width
        << ", \"height\": " << row.height << ", \"threads\": " << row.threads << ", \"round\": " << row.round
        << ", \"build_seconds\": " << row.build << ", \"trace_seconds\": " << row.trace
        << ", \"rays\": " << text("%.0f", row.rays) << ", \"memory_kib\": " << text("%.0f", row.memory)
        << ", \"largest_difference\": " << maybe(row.difference) << ", \"pixels_beyond\": " << maybe(row.beyond) << "}";
}

void write_json(const std::string& path, const std::string& machine, const std::vector<Row>& rows,
                const std::vector<World>& worlds) {
    std::ofstream out(path);
    out << "{\n\"machine\": " << quoted(machine) << ",\n\"runs\": [\n";
    for (std::size_t i = 0; i < rows.size(); ++i) out << (i ? ",\n" : ""), write_run(out, rows[i]);
    out << "\n],\n\"ratios\": [\n";
    const char* separator = "";
    for (const World& world : worlds)
        for (const Summary& s : world.programs) {
            if (s.row.program == "float" || s.row.program == "double") continue;
            out << separator << "{\"world\": " << quoted(world.name) << ", \"threads\": " << world.threads
                << ", \"program\": " << quoted(s.row.program);
            for (const char* own : {"float", "double", "float-16", "double-16"})
                if (s.ratio.contains(own)) out << ", \"to_" << own << "\": " << s.ratio.at(own);
            out << "}";
            separator = ",\n";
        }
    out << "\n]\n}\n";
    if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

/// In a plot, `strahl render` would be hidden behind the tracer alone; and plots show no pruned pictures.
bool shown(std::string_view program) { return !program.starts_with("render-") && !program.ends_with("-16"); }

/// A line per scene for which `x` is above 0, a column per program; no file if there are too few points for a line.
void write_plot(const std::string& path, const std::string& label, const std::vector<World>& worlds,
                const std::function<double(const World&)>& x) {
    std::vector<const World*> points;
    for (const World& world : worlds)
        if (x(world) > 0) points.push_back(&world);
    if (points.size() < 2) return;
    std::ofstream out(path);
    out << label;
    std::vector<std::string> columns;
    for (const auto& [name, words] : programs)
        for (const World* world : points)
            if (world->find(name) && shown(name)) {
                columns.push_back(name);
                out << " \"" << words << '"';
                break;
            }
    for (const World* world : points) {
        out << '\n' << text("%.0f", x(*world));
        for (const std::string& column : columns) {
            const Summary* s = world->find(column);
            out << ' ' << (s && s->row.seconds() > 0 ? text("%.6g", s->row.seconds()) : "-");
        }
    }
    out << '\n';
    if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

void write_plots(const std::string& folder, const std::vector<World>& worlds) {
    const int threads = worlds[0].threads;
    const auto of_kind = [&](const std::string& kind, auto value) {
        return [=](const World& w) -> double {
            return w.threads == threads && w.name.starts_with(kind) ? value(w.programs[0].row) : 0;
        };
    };
    const auto objects = [](const Row& row) { return row.objects; };
    const auto pixels = [](const Row& row) { return double(row.width) * row.height; };
    write_plot(folder + "/plot-flake.dat", "objects_(sphere_flake)", worlds, of_kind("flake-", objects));
    write_plot(folder + "/plot-grid.dat", "objects_(balls_and_cylinders_in_rows)", worlds, of_kind("grid-", objects));
    write_plot(folder + "/plot-lights.dat", "lights", worlds,
               of_kind("lights-", [](const Row& row) { return row.lights; }));
    write_plot(folder + "/plot-pixels.dat", "pixels_(the_article's_scene)", worlds, of_kind("article-", pixels));
    write_plot(folder + "/plot-rays.dat", "rays_(all_scenes)", worlds, [&](const World& w) {
        const Summary* s = any_of_ours(w);
        return w.threads == threads && s ? s->row.rays : 0;
    });
    std::string varied;
    for (const World& world : worlds)
        if (world.threads != threads) varied = world.name;
    write_plot(folder + "/plot-threads.dat", "threads_(the_article's_scene)", worlds,
               [&](const World& w) { return w.name == varied ? w.threads : 0.; });
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 4) throw std::invalid_argument("bench_report ROWS.tsv FOLDER MACHINE > results.md");
    const std::string folder = argv[2];
    const auto rows = read_rows(argv[1]);
    const auto worlds = summarize(rows);
    std::cout
        << "# Strahl compared with other programs\n\nMeasured by tests/bench/run on: " << argv[3]
        << ".\n\nTimes are wall time for building the hierarchy and tracing, without start-up, parsing and writing; "
           "medians of all\nrounds. Ratios say how many times as long as Strahl a program takes in the same round.\n\n";
    write_overview(worlds, {"float", "double"}, {"embree", "tachyon", "povray"});
    std::cout
        << "\nThe same for a picture of 16 bits. Strahl omits light that adds up to less than half a step, which is "
           "guaranteed.\nPOV-Ray drops rays that weigh less than half a step (`adc_bailout`), which guarantees nothing "
           "for their sum.\n\n";
    write_overview(worlds, {"float-16", "double-16"}, {"povray-16", "povray"});
    for (const World& world : worlds) write_details(world);
    write_json(folder + "/results.json", argv[3], rows, worlds);
    write_plots(folder, worlds);
} catch (const std::exception& error) {
    std::cerr << "bench_report: " << error.what() << '\n';
    return 1;
}
