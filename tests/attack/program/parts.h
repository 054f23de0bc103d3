// The parts of the attack on the finished program.
#pragma once
#include <string>

#include "../options.h"
#include "attacked.h"

namespace strahl::attack {

/// How many seconds to attack, or which trial alone.
struct Plan {
    double seconds = 0, only = -1;
};

/// Counts for one row of the table.
struct Tally {
    long tried = 0, faults = 0;
    std::string worst = {};
    void fault(const std::string& what, const Ran& ran);
    /// Prints it, with these notes if there was no fault; returns the exit status.
    int row(const char* part, const std::string& notes) const;
};

/// Every allocation, thread start and file call fails in turn.
int faults(Attacker& attacker, const Plan& plan);
/// SIGKILL before and after every file call, and at random moments.
int kills(Attacker& attacker, const Plan& plan);
/// Folders as a power cut may leave them.
int power(Attacker& attacker, const Plan& plan);

}  // namespace strahl::attack
