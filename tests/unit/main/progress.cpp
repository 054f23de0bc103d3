// The progress line.
#include "main/process/progress.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <thread>
#include <vector>

namespace strahl {
namespace {

TEST_CASE("the text of the progress line") {
    CHECK(progress_text(0, 0) == "  0 %");
    CHECK(progress_text(0, 100) == "  0 %");
    CHECK(progress_text(.5, .1) == " 50 %");  // too early to estimate
    CHECK(progress_text(.25, 10) == " 25 %, 0:30 left");
    CHECK(progress_text(.999999, 65) == " 99 %, 0:01 left");
    CHECK(progress_text(.5, 65) == " 50 %, 1:05 left");
    CHECK(progress_text(.5, 3725) == " 50 %, 1:02:05 left");
    CHECK(progress_text(1e-9, 10) == "  0 %");  // years
    CHECK(progress_text(1, 10) == "100 %");
    CHECK(progress_text(1.5, 10) == "100 %");
}

/// Returns what is written to standard error, which is a terminal here, while `act` runs.
template <class Act>
std::string on_terminal(Act act) {
    const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
    REQUIRE(terminal >= 0);
    REQUIRE(::grantpt(terminal) == 0);
    REQUIRE(::unlockpt(terminal) == 0);
    const int end = ::open(::ptsname(terminal), O_RDWR | O_NOCTTY);
    REQUIRE(end >= 0);
    const int saved = ::dup(STDERR_FILENO);
    ::dup2(end, STDERR_FILENO);
    act();
    std::fputs(".", stderr);  // the end, for the reader
    ::dup2(saved, STDERR_FILENO);
    std::string text;
    for (char byte = 0; byte != '.' && ::read(terminal, &byte, 1) == 1;) text += byte;
    ::close(saved), ::close(end), ::close(terminal);
    return text;
}

void work(bool quiet) {
    ProgressLine progress(quiet, "frame 2 ");
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 1000; ++i) progress.advance(i, 1000);
        });
    threads.clear();
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    progress.advance(250, 1000);  // reported late
}

TEST_CASE("on a terminal progress never decreases, and the line is erased at the end") {
    const std::string text = on_terminal([] { work(false); });
    CHECK(text.find("\rframe 2  99 %") != std::string::npos);
    CHECK(text.find("25 %") == std::string::npos);
    CHECK(text.substr(text.size() - 5) == "\r\033[K.");
}

TEST_CASE("--quiet writes nothing") {
    CHECK(on_terminal([] { work(true); }) == ".");
}

TEST_CASE("nothing is written to a pipe") {
    std::array<int, 2> pipe;
    REQUIRE(::pipe(pipe.data()) == 0);
    const int saved = ::dup(STDERR_FILENO);
    ::dup2(pipe[1], STDERR_FILENO);
    work(false);
    ::dup2(saved, STDERR_FILENO);
    ::close(saved), ::close(pipe[1]);
    char byte;
    CHECK(::read(pipe[0], &byte, 1) == 0);
    ::close(pipe[0]);
}

}  // namespace
}  // namespace strahl
