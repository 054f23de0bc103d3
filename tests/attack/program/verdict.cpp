// Checks what must hold after every run, whatever harm was done to it.
#include <algorithm>
#include <cerrno>

#include "attacked.h"

namespace strahl::attack {

bool whole(const std::string& name, const std::string& bytes, const Files& before, const Files& good) {
    const auto old = before.find(name), done = good.find(name);
    if (old != before.end() && bytes == old->second) return true;
    if (done == good.end()) return false;
    // Statistics contain times, which differ from run to run.
    return name.ends_with(".json") ? bytes.starts_with("{") && bytes.ends_with("}\n") : bytes == done->second;
}

std::string verdict(const Case& attacked, const Ran& good, const Ran& ran, const Control& control) {
    const bool kill = control.done && control.harm != Harm::error && control.harm != Harm::cut;
    // Another library's code met the harm or, with 127, the loader for it. Some libraries end the program by exit().
    const bool quietly = control.watched == Watched::loading && ran.status > 0 && ran.err.empty();
    const bool died = control.foreign && (ran.status < 0 || ran.status == 127 || quietly);
    if (ran.status == -1000 && !died) return "it did not end within 20 s";
    const bool interrupted = ran.status == 130 && control.error == EINTR;
    if (!kill && !died && !interrupted && (ran.status < 0 || ran.status > 3))
        return ran.status < 0 ? "it was ended by signal " + std::to_string(-ran.status)
                              : "exit status " + std::to_string(ran.status);
    if (ran.status > 0 && ran.err.empty() && !died) return "no message";
    if (ran.err.find("bad_alloc") != std::string::npos) return "a message that only a programmer knows";
    for (const char* word : {"Sanitizer", "runtime error:"})
        if (ran.err.find(word) != std::string::npos) return "a sanitizer's report";
    if (ran.status == 0 && !attacked.times && ran.out != good.out) return "done, but it printed something else";

    const bool unlink_failed = std::string_view(control.where).starts_with("unlink");
    Files before = attacked.before;
    if (attacked.hard_link) before["other.bmp"] = before["picture.bmp"];
    for (const auto& [name, bytes] : before)
        if (!ran.files.contains(name)) return name + " is gone";
    for (const auto& [name, bytes] : good.files) {
        const auto found = ran.files.find(name);
        if (ran.status == 0 && (found == ran.files.end() || !whole(name, found->second, {}, good.files)))
            return "done, but " + name + " is not there or not whole";
    }
    // A file with several names is overwritten in place: while it is not whole, its copy is.
    bool copied = false;
    for (const auto& [name, bytes] : ran.files)
        copied |= name.ends_with(".copy") && bytes == good.files.at("picture.bmp");
    for (const auto& [name, bytes] : ran.files) {
        if (whole(name, bytes, before, good.files)) continue;
        if (name.ends_with(".checkpoint") && (unlink_failed || ran.status != 0)) continue;
        if (name.starts_with(".strahl-") && (unlink_failed || kill || (copied && ran.status != 0))) continue;
        if (copied && (name == "picture.bmp" || name == "other.bmp") &&
            (kill || ran.err.find("all of it is in '.strahl-") != std::string::npos))
            continue;
        if (name.starts_with("folder.tmp-") && ran.err.find("the older bundle stays in") != std::string::npos) continue;
        if ((kill || control.foreign) && name.starts_with("strahl-povray-")) continue;
        return name + " should not be there, or is not whole";
    }
    return "";
}

std::vector<std::string> resumed(std::vector<std::string> words) {
    for (const std::string& word : words)
        if (word == "--resume") return words;
    if (words[0] == "render" && std::ranges::find(words, "-") == words.end()) words.push_back("--resume");
    return words;
}

std::string finished(const Case& attacked, const Ran& good, const Ran& ran) {
    if (ran.status != good.status) return "afterwards exit status " + std::to_string(ran.status);
    for (const auto& [name, bytes] : good.files)
        if (!ran.files.contains(name) || !whole(name, ran.files.at(name), {}, good.files))
            return "afterwards " + name + " is not there or not whole";
    for (const auto& [name, bytes] : ran.files) {
        // The folder for POV-Ray is in the system's folder for temporary files. A file with several names keeps its
        // copy.
        if (name.starts_with("strahl-povray-") || (attacked.hard_link && name.ends_with(".copy"))) continue;
        if (!good.files.contains(name)) return "afterwards there is " + name;
    }
    return "";
}

}  // namespace strahl::attack
