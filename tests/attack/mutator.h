// Changes that mutations of all kinds of files share.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/referee/dice.h"

namespace strahl {

class Mutator {
  public:
    Mutator(const std::vector<std::string>& valid, std::uint64_t number) : valid(valid), dice(number) {}

  protected:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(dice.in(0, 1) * static_cast<double>(n)); }
    const std::string& any() { return valid[below(valid.size())]; }

    enum Change { cut_off, erase, insert, splice, overwrite };
    /// Changes the file from `at` on: its end or a piece goes, a piece from `from()` comes in, the end of another file
    /// takes the place of its own, or a byte is another one.
    template <class From>
    void change_bytes(Change how, std::size_t at, std::size_t length, const From& from) {
        switch (how) {
            case cut_off:
                file.resize(at);
                break;
            case erase:
                file.erase(at, length);
                break;
            case insert:
                if (file.size() < 30000) file.insert(at, file.substr(from(), length));
                break;
            case splice: {
                const std::string& other = any();
                file = file.substr(0, at) + other.substr(std::min(at, other.size()));
                break;
            }
            case overwrite:
                file[at] = dice.chance(.5) ? static_cast<char>(dice.upto(255))
                                           : static_cast<char>(file[at] ^ 1 << dice.upto(7));
        }
    }

    const std::vector<std::string>& valid;
    Dice dice;
    std::string file;
};

}  // namespace strahl
