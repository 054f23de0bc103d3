// Drives the attacks on the parser and on the importer without libFuzzer: mutates seeds. Each input follows from one
// number.
//
// attack_parser|attack_importer [--seconds S] [--seed N] DICTIONARY.dict SEEDS...
// attack_parser --words    prints the words of the language as lines of a dictionary
// While it runs, and after a crash, the file attack-parser-seed in the working directory holds the number of the input:
// pass it as --seed to reproduce the crash.
#include <sys/time.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/attack/options.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// Words that the attacked reader itself knows.
std::vector<std::string> attacked_words();

namespace {

namespace fs = std::filesystem;
namespace attack = strahl::attack;
using Seeds = std::vector<std::string>;

/// Texts that mutations start from, and words, numbers and statements that they insert.
struct Ingredients {
    Seeds seeds, words, numbers, statements;
};

/// The content of a line of the dictionary: in quotes, with escapes \x00 to \xFF.
std::string unquoted(const std::string& line) {
    std::string word;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
        if (line.compare(i, 2, "\\x") == 0)
            word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16)), i += 3;
        else
            word += line[i];
    return word;
}

/// Words are sorted by what they are good for: a number replaces a number, and a statement keeps the form of a scene.
void read_dictionary(const fs::path& path, Ingredients& ingredients) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with('"')) continue;
        const std::string word = unquoted(line);
        const bool number = word.find_first_not_of("0123456789.e-") == word.npos;
        const bool statement = word.find(' ') != word.npos && word.size() > 1;
        (number ? ingredients.numbers : statement ? ingredients.statements : ingredients.words).push_back(word);
    }
}

Ingredients read_ingredients(const std::vector<fs::path>& paths) {
    Ingredients ingredients;
    ingredients.words = attacked_words();
    const auto read = [&](const fs::path& path) {
        if (path.extension() == ".dict") return read_dictionary(path, ingredients);
        std::ifstream file(path, std::ios::binary);
        std::string text(std::istreambuf_iterator<char>(file), {});
        if (text.size() < 20000) ingredients.seeds.push_back(std::move(text));
    };
    for (const fs::path& path : paths) {
        if (!fs::is_directory(path)) {
            read(path);
            continue;
        }
        for (const auto& entry : fs::recursive_directory_iterator(path))
            if (entry.path().extension() == ".rt") read(entry.path());
    }
    return ingredients;
}

class Mutator {
  public:
    Mutator(const Ingredients& ingredients, std::uint64_t number) : ingredients(ingredients), random(number) {}

    /// Half of the inputs keep the form of a scene and mostly parse; the others usually do not.
    std::string input() {
        text = any(ingredients.seeds);
        const bool keep_form = below(2) == 0;
        for (std::size_t i = 1 + below(6); i > 0; --i)
            if (keep_form)
                change_value();
            else
                change_letters();
        return text;
    }

  private:
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(random() % n); }
    const std::string& any(const Seeds& list) { return list[below(list.size())]; }

    void change_value() {
        const std::size_t at = below(text.size() + 1);
        if (below(4) == 0) {
            const std::size_t brace = text.find('}', at);
            if (brace != text.npos) text.insert(brace + below(2), " " + any(ingredients.statements) + " ");
            return;
        }
        const std::size_t number = text.find_first_of("-.0123456789", at);
        if (number == text.npos) return;
        const std::size_t end = std::min(text.size(), text.find_first_not_of("0123456789.e-+", number));
        text.replace(number, end - number, any(ingredients.numbers));
    }
    void change_letters() {
        const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 20) + 1);
        switch (below(7)) {
            case 0:
                text.insert(at, " " + any(ingredients.words) + " ");
                break;
            case 1:
                text.replace(at, length, any(ingredients.words));
                break;
            case 2:
                text.erase(at, length);
                break;
            case 3:
                text.insert(at, text.substr(below(text.size() + 1), below(200)));
                break;
            case 4:
                if (at < text.size()) text[at] = static_cast<char>(random());
                break;
            case 5:
                text.resize(at);
                break;
            default:
                change_value();
        }
    }

    const Ingredients& ingredients;
    std::mt19937_64 random;
    std::string text;
};

}  // namespace

int main(int count, char** arguments) {
    attack::Options options(count, arguments);
    if (options.take("--words")) {  // as lines of a dictionary
        for (const std::string& word : attacked_words()) std::printf("\"%s\"\n", word.c_str());
        return 0;
    }
    const std::vector<fs::path> paths(options.words.begin(), options.words.end());
    const Ingredients ingredients = read_ingredients(paths);
    if (ingredients.seeds.empty() || ingredients.words.empty() || ingredients.numbers.empty() ||
        ingredients.statements.empty())
        return std::fputs("this attack needs a dictionary and seeds\n", stderr), 2;
    attack::Progress progress("attack-parser-seed");
    const std::uint64_t first = options.number;
    std::uint64_t number = first;
    for (const double end = attack::now() + options.seconds; attack::now() < end; ++number) {
        const std::string input = Mutator(ingredients, number).input();
        progress.note(number);
        const itimerval most{{}, {10, 0}};  // of the processor's time: a busy machine kills no reader that ends
        ::setitimer(ITIMER_PROF, &most, nullptr);
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    }
    std::printf("%llu inputs, --seed %llu to %llu\n", static_cast<unsigned long long>(number - first),
                static_cast<unsigned long long>(first), static_cast<unsigned long long>(number - 1));
}
