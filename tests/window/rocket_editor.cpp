// A small GNU Rocket editor for tests of the window. Says "port P"; once a client is there "connected", and then what
// it sends: "asks NAME", "row R". Its own commands are lines of standard input: `key TRACK ROW VALUE WAY`, `delete
// TRACK ROW`, `row R`, `pause 0|1`, `save`; the numbers are those of the protocol. Its argument is the port.
#include "tests/unit/show/rocket_editor.h"

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <sstream>
#include <thread>

using namespace strahl;

namespace {

std::uint32_t number_from(Editor& editor) {
    std::uint32_t number = 0;
    for (const char byte : editor.read(4)) number = number << 8 | static_cast<unsigned char>(byte);
    return number;
}

void hear(Editor& editor) {
    for (std::string command; !(command = editor.read(1)).empty();) {
        const std::uint32_t number = number_from(editor);
        if (command == "\2")
            std::printf("asks %s\n", editor.read(number).c_str());
        else
            std::printf("row %u\n", number);
        std::fflush(stdout);
    }
    std::puts("disconnected"), std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    Editor editor(600, argc > 1 ? std::atoi(argv[1]) : 0);
    std::printf("port %d\n", editor.port), std::fflush(stdout);
    if (!editor.accept()) return 1;
    std::puts("connected"), std::fflush(stdout);
    std::thread(hear, std::ref(editor)).detach();
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream words(line);
        std::string word;
        std::uint32_t track = 0, row = 0;
        float value = 0;
        int number = 0;
        words >> word;
        if (word == "key" && words >> track >> row >> value >> number)
            editor.send(key_bytes(track, row, value, char(number)));
        if (word == "delete" && words >> track >> row) editor.send(delete_bytes(track, row));
        if (word == "row" && words >> row) editor.send(row_bytes(row));
        if (word == "pause" && words >> number) editor.send(pause_bytes(number != 0));
        if (word == "save") editor.send(save_bytes);
    }
    std::quick_exit(0);
}
