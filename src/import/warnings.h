// Collects warnings about what the scene language cannot express, with their lines.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace strahl {

class Warnings {
  public:
    /// Adds a warning. The same warning about several lines becomes one with all these lines.
    void add(std::size_t line, const std::string& message);
    /// Returns the warnings in the order of their lines, as in "file:12: message (and in lines 15, 18 and 7 more)".
    std::vector<std::string> messages(std::string_view file) const;

  private:
    static constexpr std::size_t most_lines = 10;  // listed one by one
    struct Warning {
        std::string message;
        std::vector<std::size_t> lines;
        std::size_t count = 0, last = 0;
    };
    std::vector<Warning> list;
    std::unordered_map<std::string, std::size_t> places;
};

}  // namespace strahl
