// Works out what a disk may hold after a power cut, from a log of a program's file calls.
#pragma once
#include <map>
#include <random>
#include <string>
#include <vector>

#include "attacked.h"

namespace strahl::attack {

struct Event {
    std::string what;  // nameless, create, write, truncate, sync, link, rename, unlink
    unsigned long inode = 0;
    long at = 0;  // of a write, or the size of truncate
    std::string bytes, name, to;
};
std::vector<Event> read_log(const std::string& path);

/// The names of a folder, and the inodes behind them.
using Names = std::map<std::string, int>;

/// A weak file system. What is written may reach the disk in pieces, in any order, or not at all before the file is
/// synced. Changes of names reach it in their order, some of them perhaps only when the folder is synced.
class Disk {
  public:
    /// Begins with the files that are in this folder.
    explicit Disk(const std::filesystem::path& folder);

    void apply(const Event& event);

    struct State {
        Names names;
        std::map<int, std::string> contents;
        Files files() const;
        /// Makes it the content of the folder, hard links included.
        void put(const std::filesystem::path& folder) const;
        bool operator<(const State& other) const;
    };
    /// Returns a state that a power cut at this moment may leave.
    State cut(std::mt19937& random) const;

  private:
    struct Change {
        long at;  // position of a write, or the new size
        bool is_size;
        std::string bytes;
    };
    struct Inode {
        std::string durable;
        std::vector<Change> pending;
    };
    static void change(std::string& bytes, const Change& change);

    Names durable;
    std::vector<Event> pending;  // changes of names; the inode is ours
    std::vector<Inode> inodes;
    std::map<unsigned long, int> known;  // by the real number, which may come again for another file
    unsigned long folder_inode;
};

}  // namespace strahl::attack
