// Messages of errors in files, and the memory that reading them takes.
#pragma once
#include <sys/resource.h>

#include <string>

#include "files/error.h"

namespace strahl {

/// Returns the message of the FileError that the call throws, or `none`.
template <class Call>
std::string fault_of(const Call& call, const char* none = "") {
    try {
        call();
    } catch (const FileError& error) {
        return error.what();
    }
    return none;
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Returns the most memory that this process has used so far, in MiB.
inline double memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace strahl
