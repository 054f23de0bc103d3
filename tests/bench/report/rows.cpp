#include "rows.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace strahl::bench {
namespace {

std::optional<double> number(const std::string& word) {
    if (word.empty() || word == "-") return {};
    return std::stod(word);
}

}  // namespace

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

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

const Summary* World::find(const std::string& program) const {
    for (const Summary& s : programs)
        if (s.row.program == program) return &s;
    return nullptr;
}

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

}  // namespace strahl::bench
