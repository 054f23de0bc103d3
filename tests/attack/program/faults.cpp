// Every thread start and file call of the program, and the first allocation by every path of calls, fails in turn.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "parts.h"

namespace strahl::attack {
namespace {

struct Trial {
    const Case* attacked;
    const Ran* good;
    double seconds;  // that the run without harm takes
    Watched watched;
    Harm harm;
    int error;
    long at;
    bool only_named;

    /// Returns a number that is the same in every run. Sorted by it, trials are in random order.
    long number() const;
};

constexpr Watched kinds[] = {Watched::allocations, Watched::loading, Watched::threads, Watched::files};

const char* name_of(Watched watched) {
    return watched == Watched::allocations ? "allocation"
           : watched == Watched::loading   ? "library allocation"
           : watched == Watched::threads   ? "thread"
                                           : "file call";
}

long Trial::number() const {
    std::uint64_t hash = 0;
    for (const char c : attacked->name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x9e3779b97f4a7c15;
    for (const long value : {long(watched), long(harm), long(error), at, long(only_named)})
        hash = (hash ^ (hash >> 32) ^ static_cast<std::uint64_t>(value)) * 0x9e3779b97f4a7c15;
    return static_cast<long>(hash >> 32);
}

std::string in_words(const Trial& trial, const Control& control) {
    const std::string harm = trial.harm == Harm::cut ? "is cut off"
                             : trial.watched == Watched::files
                                 ? "fails with " + std::string(strerrorname_np(trial.error))
                                 : "fails";
    return trial.attacked->name + ": " + name_of(trial.watched) + " " + std::to_string(trial.at) + " " + harm + " (" +
           control.where + ")";
}

/// The numbers of the calls that the last run made. Of allocations, of which there are far more, the first by each path
/// that is not known from another case.
std::vector<long> calls(const Control& control, Watched watched, std::set<std::uint64_t>& known) {
    std::vector<long> numbers;
    if (watched == Watched::allocations || watched == Watched::loading) {
        for (const Path& path : control.paths)
            if (path.hash != 0 && path.kind == watched && known.insert(path.hash).second) numbers.push_back(path.first);
        std::ranges::sort(numbers);
    } else {
        for (long at = 1; at <= control.counts[static_cast<int>(watched)]; ++at) numbers.push_back(at);
    }
    return numbers;
}

/// Adds all trials of a case: one for each call of the run without harm and each kind of harm.
void add_trials(Attacker& attacker, const Case& attacked, Ran& good, std::set<std::uint64_t>& known,
                std::vector<Trial>& trials) {
    attacker.order(Watched::nothing, 0);
    for (const bool only_named : {true, false}) {
        attacker.control().only_named = only_named;
        if (!only_named) {
            attacker.control().finds_paths = true;
            attacker.prepare(attacked);
            attacker.run(attacked, 10 * longest);
            attacker.control().finds_paths = false;
        }
        const double start = now();
        good = attacker.run_fresh(attacked);
        const double seconds = now() - start;
        for (const Watched watched : kinds) {
            if (only_named && watched != Watched::files) continue;
            for (const long at : calls(attacker.control(), watched, known)) {
                const auto add = [&](Harm harm, int error) {
                    trials.push_back({&attacked, &good, seconds, watched, harm, error, at, only_named});
                };
                if (watched != Watched::files) {
                    add(Harm::error, 0);
                    continue;
                }
                for (const int error : {ENOSPC, EIO, EDQUOT, EACCES, EINTR}) add(Harm::error, error);
                add(Harm::cut, 0);
            }
        }
    }
}

/// Puts them in a random order in which all cases and kinds of calls get the same time: a short attack tries some of
/// each, a longer one all of those that are quick.
void mix(std::vector<Trial>& trials) {
    std::ranges::sort(trials, {}, &Trial::number);
    std::map<std::pair<const Case*, Watched>, long> counts;
    std::vector<std::pair<double, Trial>> turns;
    for (const Trial& trial : trials)
        turns.emplace_back(trial.seconds * static_cast<double>(counts[{trial.attacked, trial.watched}]++), trial);
    for (const auto& [kind, count] : counts)
        std::fprintf(stderr, "%s: %ld trials of %ss\n", kind.first->name.c_str(), count, name_of(kind.second));
    std::ranges::stable_sort(turns, {}, &std::pair<double, Trial>::first);
    std::ranges::transform(turns, trials.begin(), &std::pair<double, Trial>::second);
}

}  // namespace

int faults(Attacker& attacker, const Plan& plan) {
    std::vector<Case> all = cases();
    std::ranges::move(cases_with_others(), std::back_inserter(all));
    all = attacker.completed(all);
    const double start = now();
    std::vector<Ran> good(all.size());
    std::vector<Trial> trials;
    std::set<std::uint64_t> known;
    // Tries as many cases as there is time for.
    for (std::size_t i = 0; i < all.size() && (plan.only >= 0 || now() < start + plan.seconds / 4); ++i)
        add_trials(attacker, all[i], good[i], known, trials);
    mix(trials);
    const double end = std::max(start + plan.seconds, now() + plan.seconds / 2);  // finding paths may take long
    Tally tally;
    long foreign = 0, per_kind[5] = {}, all_of_kind[5] = {};
    for (const Trial& trial : trials) ++all_of_kind[static_cast<int>(trial.watched)];
    for (const Trial& trial : trials) {
        if (plan.only >= 0 ? static_cast<long>(plan.only) != trial.number() : now() > end) continue;
        attacker.control().only_named = trial.only_named;
        attacker.order(trial.watched, trial.at, trial.harm, trial.error);
        const Ran ran = attacker.run_fresh(*trial.attacked);
        ++tally.tried, ++per_kind[static_cast<int>(trial.watched)];
        const std::string fault = verdict(*trial.attacked, *trial.good, ran, attacker.control());
        foreign += fault.empty() && (ran.status < 0 || ran.status == 127 || (ran.status > 0 && ran.err.empty()));
        if (fault.empty()) continue;
        tally.fault(std::to_string(trial.number()) + ": " + in_words(trial, attacker.control()) + ": " + fault, ran);
    }
    std::string notes;
    for (const Watched watched : kinds)
        notes += (notes.empty() ? "" : ", ") + std::to_string(per_kind[static_cast<int>(watched)]) + " of " +
                 std::to_string(all_of_kind[static_cast<int>(watched)]) + " " + name_of(watched) + "s";
    return tally.row("faults", notes + "; ended by a library: " + std::to_string(foreign));
}

}  // namespace strahl::attack
