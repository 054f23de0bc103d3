// The program: runs the command line, and makes an exit status of what is thrown.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

#include "files/error.h"
#include "files/os/system.h"
#include "files/utf8.h"
#include "main/options/command_line.h"
#include "main/process/exit_status.h"

namespace strahl {
namespace {

int fail(const std::exception& error, int status, const char* prefix = "strahl: ") {
    std::cerr << prefix << printable(error.what()) << '\n';
    return status;
}

constexpr const char* out_of_memory = "out of memory; a smaller picture, or fewer --threads, need less";
/// Ends the program for an exception that nothing can catch, such as a library's while it is loaded.
[[noreturn]] void end_at_once() {
    try {
        if (std::current_exception()) throw;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "strahl: %s\n", out_of_memory);
        std::_Exit(exit_status::failed);
    } catch (...) {
    }
    std::abort();
}

/// Writes what was printed but is still in a buffer: the disk may be full.
void flush_output() {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
    throw OutputError(std::string("cannot write 'standard output': ") + std::strerror(errno));
}

}  // namespace
}  // namespace strahl

int main(int argc, char** argv) {
    using namespace strahl;
    std::set_terminate(end_at_once);
    os::prepare_streams();
    try {
        const int status = run_command_line(argc, argv);
        flush_output();
        return status;
    } catch (const UsageError& error) {
        return fail(error, exit_status::usage);
    } catch (const OutputError& error) {
        return fail(error, dynamic_cast<const Interrupted*>(&error) ? exit_status::interrupted : exit_status::failed);
    } catch (const FileError& error) {
        return fail(error, exit_status::bad_file, "");
    } catch (const std::bad_alloc&) {
        return fail(std::runtime_error(out_of_memory), exit_status::failed);
    } catch (const std::exception& error) {
        return fail(error, exit_status::failed);
    }
}
