// What was measured: a line per run, and what follows from all rounds of a program in a world.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace strahl::bench {

/// One run. Seconds without start-up, parsing and writing.
struct Row {
    std::string world, program;
    int objects = 0, lights = 0, width = 0, height = 0, threads = 0, round = 0;
    double build = 0, trace = 0;
    double rays = 0;                           // 0: the program does not tell
    double memory = 0;                         // peak, in KiB
    std::optional<double> difference, beyond;  // from Strahl's double picture: the largest, and pixels beyond 1/255
    double seconds() const { return build + trace; }
};

/// Tab-separated, in the order in which tests/bench/run writes them. Throws std::runtime_error.
std::vector<Row> read_rows(const std::string& path);

double median(std::vector<double> values);

/// All rounds of one program in one world, with one number of threads: medians.
struct Summary {
    Row row;
    std::map<std::string, double> ratio;  // its time to another program's of the same round
};

struct World {
    std::string name;
    int threads = 0;
    std::vector<Summary> programs;  // in the order measured
    const Summary* find(const std::string& program) const;
};

/// In the order measured.
std::vector<World> summarize(const std::vector<Row>& rows);

}  // namespace strahl::bench
