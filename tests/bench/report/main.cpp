// Tables of a measurement: bench_report ROWS.tsv MACHINE > results.md
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/measure.h"

namespace {

using strahl::bench::median;

/// One run. Seconds without start-up, parsing and writing.
struct Row {
    std::string world, program;
    int objects = 0, lights = 0, width = 0, height = 0, threads = 0, round = 0;
    double build = 0, trace = 0;
    double rays = 0;                           // 0: the program does not report them
    double memory = 0;                         // peak, in KiB
    std::optional<double> difference, beyond;  // from Strahl's double picture: the largest, and pixels beyond 1/255
    double seconds() const { return build + trace; }
};

std::optional<double> number(const std::string& word) {
    if (word.empty() || word == "-") return {};
    return std::stod(word);
}

/// Tab-separated, in the order in which tests/bench/run writes them. Throws std::runtime_error.
std::vector<Row> read_rows(const std::string& path) {
    std::vector<Row> rows;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::vector<std::string> w;
        for (std::string word; std::getline(words, word, '\t');) w.push_back(word);
        if (w.size() != 14) throw std::runtime_error(path + ": not a line of fourteen: " + line);
        Row row;
        row.world = w[0], row.program = w[7];
        row.objects = std::stoi(w[1]), row.lights = std::stoi(w[2]);
        row.width = std::stoi(w[3]), row.height = std::stoi(w[4]);
        row.threads = std::stoi(w[5]), row.round = std::stoi(w[6]);
        row.build = std::stod(w[8]), row.trace = std::stod(w[9]);
        row.rays = std::stod(w[10]), row.memory = std::stod(w[11]);
        row.difference = number(w[12]), row.beyond = number(w[13]);
        rows.push_back(row);
    }
    if (rows.empty()) throw std::runtime_error(path + ": nothing was measured");
    return rows;
}

/// All rounds of one program in one world, with one number of threads: medians.
struct Summary {
    Row row;
    std::map<std::string, double> ratio;  // its time to another program's of the same round
};

struct World {
    std::string name;
    int threads = 0;
    std::vector<Summary> programs;  // in the order measured
    const Summary* find(const std::string& program) const {
        for (const Summary& s : programs)
            if (s.row.program == program) return &s;
        return nullptr;
    }
};

/// In the order measured.
std::vector<World> summarize(const std::vector<Row>& rows) {
    std::vector<World> worlds;
    std::map<std::string, std::vector<Row>> all;  // by world, threads and program
    const auto key = [](const std::string& world, int threads, const std::string& program) {
        return world + '/' + std::to_string(threads) + '/' + program;
    };
    for (const Row& row : rows) {
        auto world = std::find_if(worlds.begin(), worlds.end(),
                                  [&](const World& w) { return w.name == row.world && w.threads == row.threads; });
        if (world == worlds.end()) world = worlds.insert(worlds.end(), {row.world, row.threads, {}});
        auto& rounds = all[key(row.world, row.threads, row.program)];
        if (rounds.empty()) world->programs.push_back({row, {}});
        rounds.push_back(row);
    }
    for (World& world : worlds)
        for (Summary& s : world.programs) {
            const auto& rounds = all[key(world.name, world.threads, s.row.program)];
            const auto middle = [&](double Row::*value) {
                std::vector<double> values;
                for (const Row& r : rounds) values.push_back(r.*value);
                return median(values);
            };
            s.row.build = middle(&Row::build), s.row.trace = middle(&Row::trace), s.row.memory = middle(&Row::memory);
            for (const Summary& other : world.programs) {
                std::vector<double> ratios;
                for (const Row& mine : rounds)
                    for (const Row& theirs : all[key(world.name, world.threads, other.row.program)])
                        if (mine.round == theirs.round && theirs.seconds() > 0)
                            ratios.push_back(mine.seconds() / theirs.seconds());
                if (!ratios.empty()) s.ratio[other.row.program] = median(ratios);
            }
        }
    return worlds;
}

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

/// Every program in every scene. A scene's first line says what it is.
void write_details(const std::vector<World>& worlds) {
    std::cout << "\n## Scene by scene\n\n"
                 "| Scene | Program | Build s | Trace s | Rays | Mrays/s | Memory MiB | Largest difference | Pixels "
                 "differing by more than 1/255 |\n|---|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const World& world : worlds) {
        const Row& first = world.programs[0].row;
        std::cout << "| **" << world.name << "**, " << first.width << 'x' << first.height << ", " << first.objects
                  << " objects, " << first.lights << " lights, " << world.threads << " threads ";
        for (const auto& [row, ratio] : world.programs) {
            std::cout << (&row == &first ? "| " : "| | ") << title(row.program) << " | " << digits(row.build) << " | "
                      << digits(row.trace) << " | " << (row.rays > 0 ? text("%.0f", row.rays) : "") << " | "
                      << (row.rays > 0 && row.trace > 0 ? digits(row.rays / row.trace * 1e-6) : "") << " | "
                      << text("%.0f", row.memory / 1024) << " | "
                      << (row.difference ? text("%.2g", *row.difference) : "") << " | "
                      << (row.beyond ? text("%.4f", 100 * *row.beyond / row.width / row.height) + " %" : "") << " |\n";
        }
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 3) throw std::invalid_argument("bench_report ROWS.tsv MACHINE > results.md");
    const auto worlds = summarize(read_rows(argv[1]));
    std::cout
        << "# Strahl compared with other programs\n\nFor those who ask how fast Strahl is beside other programs.\n\n"
           "Measured by tests/bench/run on: "
        << argv[2]
        << ".\n\nTimes are wall time for building the hierarchy and tracing, without start-up, parsing and writing; "
           "medians of all\nrounds. Ratios say how many times as long as Strahl a program takes in the same round.\n\n";
    write_overview(worlds, {"float", "double"}, {"embree", "tachyon", "povray"});
    std::cout
        << "\nThe same for a picture of 16 bits. Strahl omits light that adds up to less than half a step, which is "
           "guaranteed.\nPOV-Ray drops rays that weigh less than half a step (`adc_bailout`), which guarantees nothing "
           "for their sum.\n\n";
    write_overview(worlds, {"float-16", "double-16"}, {"povray-16", "povray"});
    write_details(worlds);
} catch (const std::exception& error) {
    std::cerr << "bench_report: " << error.what() << '\n';
    return 1;
}
