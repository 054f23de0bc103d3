// Power cuts: after every file call of a command, folders as a weak file system may leave them.
#include <set>

#include "disk.h"
#include "parts.h"

namespace strahl::attack {
namespace {

/// Returns the fault of the files that the power cut left, or "". `promised` are the files that were written before.
std::string verdict_of(const Files& left, const Files& before, const Files& good,
                       const std::set<std::string>& promised) {
    bool copied = false;
    for (const auto& [name, bytes] : left) {
        const auto picture = good.find("picture.bmp");
        copied |= name.ends_with(".copy") && picture != good.end() && bytes == picture->second;
    }
    for (const auto& [name, bytes] : left) {
        if (name.ends_with(".checkpoint")) continue;  // each of its bands is whole or absent, which the next run shows
        if (name.starts_with(".strahl-") || whole(name, bytes, before, good)) continue;
        if (!copied) return name + " is not whole: " + std::to_string(bytes.size()) + " bytes";
    }
    for (const auto& [name, bytes] : before)
        if (!left.contains(name)) return name + " is gone";
    for (const std::string& name : promised)
        if (!left.contains(name) || !whole(name, left.at(name), {}, good))
            return name + " was written, and is not there";
    return "";
}

struct Cuts {
    Attacker& attacker;
    Tally& tally;
    std::mt19937& random;
    double end;
    long went_on = 0;
};

/// Cuts the power after each event, several times each, and lets the command go on in a sample of what is left.
void cut_power(Cuts& cuts, const Case& attacked, const Ran& good, Disk disk, const std::vector<Event>& events,
               int times) {
    Files before = attacked.before;
    if (attacked.hard_link) before["other.bmp"] = before["picture.bmp"];
    Case again = attacked;
    again.words = resumed(attacked.words);
    std::set<std::string> written, promised;
    std::set<Disk::State> seen;
    for (std::size_t done = 0; done <= events.size(); ++done) {
        // The next file is begun, or the command has ended: by then the files before must be on the disk.
        if (done < events.size() && (events[done].what == "nameless" || events[done].what == "create"))
            promised = written, seen.clear();
        if (done == events.size())
            for (const auto& [name, bytes] : good.files) promised.insert(name), seen.clear();
        for (int i = 0, runs = 0; i < 50 && now() < cuts.end; ++i) {
            const Disk::State state = disk.cut(cuts.random);
            if (!seen.insert(state).second) continue;
            ++cuts.tally.tried;
            std::string fault = verdict_of(state.files(), before, good.files, promised);
            Ran ran;
            if (fault.empty() && runs++ < times) {
                state.put(cuts.attacker.folder());
                ran = cuts.attacker.run(again);
                ++cuts.went_on;
                fault = finished(attacked, good, ran);
            }
            if (!fault.empty())
                cuts.tally.fault(attacked.name + ", power cut after file call " + std::to_string(done) + ": " + fault,
                                 ran);
        }
        if (done == events.size()) break;
        disk.apply(events[done]);
        if (events[done].what == "rename" && !events[done].to.ends_with(".checkpoint")) written.insert(events[done].to);
    }
}

}  // namespace

int power(Attacker& attacker, const Plan& plan) {
    Tally tally;
    std::mt19937 random(1);
    Cuts cuts{attacker, tally, random, now() + plan.seconds};
    const std::vector<Case> all = attacker.completed(cases());
    for (int round = 0; now() < cuts.end; ++round)
        for (const Case& attacked : all) {
            if (attacked.name == "crosscheck") continue;  // POV-Ray's files are temporary
            attacker.control().only_named = round % 2 == 1;
            attacker.order(Watched::nothing, 0);
            attacker.prepare(attacked);
            const Disk disk(attacker.folder());
            attacker.record("calls");
            const Ran good = attacker.run(attacked);
            attacker.record("");
            const std::vector<Event> events = read_log("calls");
            if (!events.empty()) cut_power(cuts, attacked, good, disk, events, 1 + round);
        }
    return tally.row("power cuts",
                     "in " + std::to_string(cuts.went_on) + " of these folders the command was run again");
}

}  // namespace strahl::attack
