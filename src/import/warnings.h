// Collects what can't be said in the language, with its lines.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace strahl {

class Warnings {
  public:
    /// What is said again of another line is told once, with both lines.
    void add(std::size_t line, const std::string& message);
    /// "file:12: message (and in lines 15, 18 and 7 more)"
    std::vector<std::string> told(std::string_view file) const;

  private:
    static constexpr std::size_t most_lines = 10;  // that are told one by one
    struct Warning {
        std::string message;
        std::vector<std::size_t> lines;
        std::size_t count = 0, last = 0;
    };
    std::vector<Warning> list;
    std::unordered_map<std::string, std::size_t> places;
};

}  // namespace strahl
