#include "disk.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>

namespace strahl::attack {
namespace {

namespace fs = std::filesystem;

unsigned long number_of(const fs::path& path) {
    struct stat status {};
    ::stat(path.c_str(), &status);
    return status.st_ino;
}

std::string plain(const std::string& path) { return fs::path(path).lexically_normal().string(); }

void rename(Names& names, const Event& event) {
    if (event.what == "unlink") {
        names.erase(event.name);
    } else if (event.what == "rename") {
        const auto old = names.find(event.name);
        if (old == names.end()) return;
        names[event.to] = old->second;
        names.erase(event.name);
    } else {
        names[event.name] = static_cast<int>(event.inode);
    }
}

}  // namespace

std::vector<Event> read_log(const std::string& path) {
    std::vector<Event> events;
    std::ifstream log(path, std::ios::binary);
    for (std::string line; std::getline(log, line);) {
        std::istringstream words(line);
        Event event;
        std::size_t count = 0;
        words >> event.what >> event.inode >> event.at >> count >> event.name >> event.to;
        event.name = plain(event.name), event.to = plain(event.to);
        if (event.what == "write") {
            event.bytes.resize(count);
            log.read(event.bytes.data(), static_cast<std::streamsize>(count));
        }
        events.push_back(std::move(event));
    }
    return events;
}

Disk::Disk(const fs::path& folder) : folder_inode(number_of(folder)) {
    for (const auto& [name, bytes] : files_in(folder)) {
        const auto [entry, is_new] = known.try_emplace(number_of(folder / name), static_cast<int>(inodes.size()));
        if (is_new) inodes.push_back({bytes, {}});
        durable[name] = entry->second;
    }
}

void Disk::apply(const Event& event) {
    if (event.what == "nameless" || event.what == "create") {
        known[event.inode] = static_cast<int>(inodes.size());
        inodes.emplace_back();
        if (event.what == "nameless") return;
    }
    if (event.what == "sync" && event.inode == folder_inode) {
        for (const Event& name : pending) rename(durable, name);
        pending.clear();
        return;
    }
    if (event.what == "rename" || event.what == "unlink") return pending.push_back(event);
    const auto found = known.find(event.inode);
    if (found == known.end()) return;  // a file of another folder, or a pipe
    Inode& inode = inodes[static_cast<std::size_t>(found->second)];
    if (event.what == "link" || event.what == "create") {
        pending.push_back(event);
        pending.back().inode = static_cast<unsigned long>(found->second);
    } else if (event.what == "sync") {
        for (const Change& each : inode.pending) change(inode.durable, each);
        inode.pending.clear();
    } else if (event.what == "truncate") {
        inode.pending.push_back({event.at, true, ""});
    } else {
        constexpr std::size_t block = 64;  // so that small pictures come in pieces too
        for (std::size_t from = 0; from < event.bytes.size(); from += block)
            inode.pending.push_back({event.at + static_cast<long>(from), false, event.bytes.substr(from, block)});
    }
}

void Disk::change(std::string& bytes, const Change& change) {
    const auto at = static_cast<std::size_t>(change.at);
    if (change.is_size) return bytes.resize(at);
    if (bytes.size() < at + change.bytes.size()) bytes.resize(at + change.bytes.size());
    bytes.replace(at, change.bytes.size(), change.bytes);
}

Disk::State Disk::cut(std::mt19937& random) const {
    const auto up_to = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random); };
    State state{durable, {}};
    const std::size_t happened = up_to(pending.size());
    for (std::size_t i = 0; i < happened; ++i) rename(state.names, pending[i]);
    for (const auto& [name, id] : state.names) {
        const Inode& inode = inodes[static_cast<std::size_t>(id)];
        std::string bytes = inode.durable;
        // Keeps none of the pending writes, all of them, the first ones, or some at random.
        const std::size_t which = up_to(3), first = up_to(inode.pending.size());
        for (std::size_t i = 0; i < inode.pending.size(); ++i)
            if (which == 1 || (which == 2 && i < first) || (which == 3 && up_to(1) == 1))
                change(bytes, inode.pending[i]);
        state.contents.try_emplace(id, std::move(bytes));
    }
    return state;
}

Files Disk::State::files() const {
    Files files;
    for (const auto& [name, id] : names) files[name] = contents.at(id);
    return files;
}

void Disk::State::put(const fs::path& folder) const {
    attack::put({}, folder);
    std::map<int, fs::path> there;
    for (const auto& [name, id] : names) {
        const auto [first, is_new] = there.try_emplace(id, folder / name);
        if (is_new)
            std::ofstream(folder / name, std::ios::binary) << contents.at(id);
        else
            fs::create_hard_link(first->second, folder / name);
    }
}

bool Disk::State::operator<(const State& other) const {
    return std::tie(names, contents) < std::tie(other.names, other.contents);
}

}  // namespace strahl::attack
