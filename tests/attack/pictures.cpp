// Spoilt picture files for the reader that `compare` uses.
#include "image/picture.h"
#include "tests/attack/file_attack.h"
#include "tests/attack/mutated_picture.h"

using namespace strahl;

int main(int count, char** arguments) {
    return run_attack(
        {"picture", {""}, valid_pictures, mutated_picture, [](const std::string& path) { read_picture(path); }}, count,
        arguments);
}
