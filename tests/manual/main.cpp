// write_manual FILE: makes the tables in the manual anew.
#include <cstdio>
#include <exception>

#include "files/output_file.h"
#include "files/read_file.h"
#include "text/manual/manual.h"

int main(int argc, char** argv) try {
    if (argc != 2) return std::fputs("write_manual FILE\n", stderr), 2;
    strahl::write_file(argv[1], strahl::with_current_tables(strahl::read_text(argv[1])));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "write_manual: %s\n", error.what());
    return 1;
}
