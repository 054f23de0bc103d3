// One run of `strahl` under attack: how it ends, what it says, and the files that it leaves.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fail.h"

namespace strahl::attack {

/// The files below a folder, by their paths.
using Files = std::map<std::string, std::string>;
Files files_in(const std::filesystem::path& folder);
/// Makes these, and no others, the files of the folder.
void put(const Files& files, const std::filesystem::path& folder);

/// A command, and the files that are there before it.
struct Case {
    std::string name;
    std::vector<std::string> words;
    Files before;
    /// Commands that make more of these files.
    std::vector<std::vector<std::string>> first = {};
    bool times = false;      // it prints times, so that no two runs print the same
    bool hard_link = false;  // picture.bmp has a second name, other.bmp
};
std::vector<Case> cases();
/// Cases in which other programs or the kernel write files. Only `faults` knows what to expect of them.
std::vector<Case> cases_with_others();
/// Stills and films that take long enough to be killed at any moment.
std::vector<Case> larger_cases();

struct Ran {
    int status = 0;  // exit status; -N for signal N, -1000 if it had to be ended
    std::string out, err;
    Files files;
};

/// Returns the fault of a run, or "". `good` is the run without harm.
std::string verdict(const Case& attacked, const Ran& good, const Ran& ran, const Control& control);

/// Is this file's content that from before or that of the undisturbed run?
bool whole(const std::string& name, const std::string& bytes, const Files& before, const Files& good);

/// The words of the command that goes on after a kill or a power cut.
std::vector<std::string> resumed(std::vector<std::string> words);
/// Returns the fault of the folder after the command has ended, or "".
std::string finished(const Case& attacked, const Ran& good, const Ran& ran);

/// The most seconds that a run may take.
inline constexpr double longest = 20;

class Attacker {
  public:
    /// `program` is run in the folder `work` below the current one, with `library` preloaded.
    Attacker(std::string program, std::string library);
    Attacker(const Attacker&) = delete;

    Control& control() { return *orders; }
    const std::filesystem::path& folder() const { return work; }

    /// Sets the harm that is done to the next run.
    void order(Watched watched, long at, Harm harm = Harm::error, int error = 0);

    /// The path of the log of the next runs' file calls, or nothing.
    void record(const std::string& path);

    /// Runs the commands that make files for these cases.
    std::vector<Case> completed(std::vector<Case> all);

    /// Makes the folder as it should be before.
    void prepare(const Case& attacked) const;
    /// Runs the case in the folder as it is. Kills it after `seconds`; its status is -1000 then.
    Ran run(const Case& attacked, double seconds = longest, bool preloaded = true);
    /// Runs the case after preparing its folder.
    Ran run_fresh(const Case& attacked);

  private:
    std::string program, library;
    std::filesystem::path work, control_path, log;
    Control* orders;
};

}  // namespace strahl::attack
