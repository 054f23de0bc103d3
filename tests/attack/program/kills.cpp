// SIGKILL: before and after every file call, and at random moments of stills and films.
#include <random>

#include "parts.h"

namespace strahl::attack {
namespace {

/// Kills at each file call in turn. Returns their number.
long at_every_call(Attacker& attacker, double end, Tally& tally) {
    const long before = tally.tried;
    for (const bool only_named : {false, true})
        for (const Case& attacked : attacker.completed(cases())) {
            attacker.control().only_named = only_named;
            attacker.order(Watched::nothing, 0);
            const Ran good = attacker.run_fresh(attacked);
            const long calls = attacker.control().counts[static_cast<int>(Watched::files)];
            Case again = attacked;
            again.words = resumed(attacked.words);
            for (long at = 1; at <= calls; ++at)
                for (const Harm harm : {Harm::kill_before, Harm::kill_after}) {
                    if (now() > end) return tally.tried - before;
                    attacker.order(Watched::files, at, harm);
                    const Ran killed = attacker.run_fresh(attacked);
                    ++tally.tried;
                    std::string fault =
                        killed.status == -9 ? verdict(attacked, good, killed, attacker.control()) : "it was not killed";
                    attacker.order(Watched::nothing, 0);
                    if (fault.empty()) fault = finished(attacked, good, attacker.run(again));
                    if (!fault.empty())
                        tally.fault(attacked.name + " killed at file call " + std::to_string(at) + ": " + fault,
                                    killed);
                }
        }
    return tally.tried - before;
}

/// Kills the command again and again, each time at a random moment, until it comes to its end.
void at_random(Attacker& attacker, const Case& attacked, const Ran& good, double seconds, std::mt19937& random,
               double end, Tally& tally) {
    Case now_on = attacked;
    put(attacked.before, attacker.folder());
    while (now() < end) {
        const double moment = std::uniform_real_distribution(0., 1.1 * seconds)(random);
        const Ran ran = attacker.run(now_on, moment, false);
        if (ran.status != -1000) {
            const std::string fault = finished(attacked, good, ran);
            if (!fault.empty()) tally.fault(attacked.name + ": " + fault, ran);
            return;
        }
        ++tally.tried;
        for (const auto& [name, bytes] : ran.files)
            if (!whole(name, bytes, attacked.before, good.files) && !name.starts_with(".strahl-"))
                tally.fault(attacked.name + " killed after " + std::to_string(moment) + " s: " + name + " is not whole",
                            ran);
        for (const auto& [name, bytes] : attacked.before)
            if (!ran.files.contains(name)) tally.fault(attacked.name + ": " + name + " is gone", ran);
        now_on.words = resumed(attacked.words);
    }
}

}  // namespace

int kills(Attacker& attacker, const Plan& plan) {
    const double start = now(), end = start + plan.seconds;
    Tally tally;
    // In the second half of the time it is killed at random moments.
    const long called = at_every_call(attacker, start + plan.seconds / 2, tally);
    attacker.control().only_named = false;
    std::mt19937 random(1);
    const std::vector<Case> all = larger_cases();
    std::vector<Ran> good;
    std::vector<double> times;
    for (const Case& attacked : all) {
        put(attacked.before, attacker.folder());
        const double begun = now();
        good.push_back(attacker.run(attacked, longest, false));
        times.push_back(now() - begun);
    }
    while (now() < end)
        for (std::size_t i = 0; i < all.size(); ++i) at_random(attacker, all[i], good[i], times[i], random, end, tally);
    return tally.row("kills", std::to_string(called) + " at every file call, " + std::to_string(tally.tried - called) +
                                  " at random moments");
}

}  // namespace strahl::attack
