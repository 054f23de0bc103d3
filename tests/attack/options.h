// Shared by the programs of the attacks: their options, and a file with the number of the input being tried.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace strahl::attack {

inline double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// --seconds S, --first N or --seed N, and words: other options and files.
struct Options {
    double seconds = 5;
    std::uint64_t number = 1;
    bool alone = false;  // --seed: this number alone
    std::vector<std::string> words;

    Options(int count, char** arguments) {
        for (int i = 1; i < count; ++i) {
            const std::string option = arguments[i];
            if (option == "--seconds" && i + 1 < count)
                seconds = std::stod(arguments[++i]);
            else if ((option == "--first" || option == "--seed") && i + 1 < count)
                number = std::stoull(arguments[++i]), alone = option == "--seed";
            else
                words.push_back(option);
        }
    }
    /// Removes a word; was it there?
    bool take(const char* word) { return std::erase(words, word) > 0; }
};

/// Ends the program with status 2 if a word is left that it does not know.
inline void refuse(const Options& options, const std::string& program) {
    if (options.words.empty()) return;
    std::fprintf(stderr, "%s: what is '%s'?\n", program.c_str(), options.words[0].c_str());
    std::exit(2);
}

/// A file in the working directory that holds the number of the input being tried. It stays after a crash.
class Progress {
  public:
    explicit Progress(const char* name) : name(name), file(std::fopen(name, "w")) {
        if (!file) std::perror(name), std::exit(1);
    }
    ~Progress() { std::fclose(file), std::remove(name); }
    Progress(const Progress&) = delete;
    void note(std::uint64_t number) {
        std::rewind(file);
        std::fprintf(file, "%llu\n", static_cast<unsigned long long>(number));
        std::fflush(file);
    }

  private:
    const char* name;
    std::FILE* file;
};

}  // namespace strahl::attack
