// Programs that run beside this one.
#include "files/os/process.h"

#include <doctest/doctest.h>
#include <signal.h>

#include <atomic>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>

namespace strahl::os {
namespace {

ProgramStart script(const std::string& text) { return {.words = {"/bin/sh", "-c", text}}; }

}  // namespace

TEST_CASE("a program says what it prints and how it ended") {
    Process shell(script("echo one; echo two >&2; exit 3"));
    CHECK(shell.wait() == 3);
    CHECK(shell.wait() == 3);
    CHECK(shell.output() == "one\ntwo\n");
    CHECK(Process(script("kill -USR1 $$")).wait() == -SIGUSR1);
    ProgramStart elsewhere = script("pwd");
    elsewhere.folder = "/";
    Process there(elsewhere);
    CHECK(there.wait() == 0);
    CHECK(there.output() == "/\n");
}

TEST_CASE("a program reads what it is sent, and then the end") {
    Process copier({.words = {"cat"}});
    const std::string bytes(1 << 20, 'x');
    CHECK(copier.send(bytes));
    CHECK(copier.send("end"));
    CHECK(copier.wait() == 0);
    CHECK(copier.output() == bytes + "end");
    Process deaf({.words = {"true"}});
    while (deaf.send(bytes)) continue;  // fails once it has ended
    CHECK(deaf.wait() == 0);
}

TEST_CASE("a program that is not there, and one in PATH") {
    try {
        Process({.words = {"no-such-program"}});
        FAIL_CHECK("it was started");
    } catch (const std::system_error& error) {
        CHECK(error.code() == std::errc::no_such_file_or_directory);
    }
    CHECK(find_program("sh").ends_with("/sh"));
    CHECK(find_program("no-such-program") == "");
}

TEST_CASE("a program is stopped while it is waited for, or with its object") {
    const std::atomic<bool> stop = true;
    CHECK(Process(script("exec sleep 1000")).wait(&stop) == -SIGKILL);
    pid_t child = 0;
    {
        Process sleeper(script("echo $$; exec sleep 1000"));
        while (sleeper.output().empty()) continue;
        child = std::atoi(sleeper.output().c_str());
        CHECK(::kill(child, 0) == 0);
    }
    CHECK(::kill(child, 0) != 0);
}

}  // namespace strahl::os
