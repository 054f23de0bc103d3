// Attacks the finished program: makes its allocations, threads and file calls fail, kills it, and cuts the power.
//
// attack_io PART --seconds S STRAHL LIBRARY     in an empty folder; prints one row of the table
// attack_io PART --only N STRAHL LIBRARY        one trial again, with what it said
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "parts.h"

namespace strahl::attack {

void Tally::fault(const std::string& what, const Ran& ran) {
    if (faults++ == 0) worst = what;
    std::fprintf(stderr, "FAULT: %s\n%s\n", what.c_str(), ran.err.substr(0, 2000).c_str());
}

int Tally::row(const char* part, const std::string& notes) const {
    std::string shown = worst.empty() ? notes : worst;
    std::ranges::replace(shown, '|', '/');
    std::printf("| %s | %ld | %ld | %s |\n", part, tried, faults, shown.c_str());
    return faults > 0 || tried == 0;
}

}  // namespace strahl::attack

int main(int count, char** words) {
    using namespace strahl::attack;
    if (count != 6) return std::fprintf(stderr, "attack_io PART --seconds S STRAHL LIBRARY\n"), 2;
    const std::string part = words[1];
    Attacker attacker(words[4], words[5]);
    Plan plan;
    (std::strcmp(words[2], "--only") == 0 ? plan.only : plan.seconds) = std::atof(words[3]);
    return part == "faults" ? faults(attacker, plan) : part == "kills" ? kills(attacker, plan) : power(attacker, plan);
}
