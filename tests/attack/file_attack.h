// Spoilt files for a reader. A crash, an exception of the wrong type, more than 1 GB or more than 5 s is a fault.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace strahl {

struct FileAttack {
    const char* what;                  // "picture"
    std::vector<const char*> endings;  // of the names by which each file is read
    std::vector<std::string> (*valid)();
    std::string (*mutated)(const std::vector<std::string>& valid, std::uint64_t number);
    void (*read)(const std::string& path);  // throws FileError if the file is unusable
};

/// The main function of such a program:
///
///     attack_pictures [--seconds S] [--first N]   the files from number N on
///     attack_pictures --seed N [--write]          this one alone, in this process; or its bytes
///
/// A worker reads them, one after the other; if one kills it, the next worker goes on.
int run_attack(const FileAttack& attack, int count, char** arguments);

}  // namespace strahl
