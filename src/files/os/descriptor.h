// Numbers that the system gives to what is open.
#pragma once
#include <utility>

namespace strahl::os {

/// The number of an open file or connection, or -1. It is closed in the end.
struct Descriptor {
    int number = -1;

    Descriptor() = default;
    Descriptor(int number) : number(number) {}
    Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number, other.number);
        return *this;
    }
    ~Descriptor();
    explicit operator bool() const { return number >= 0; }
};

}  // namespace strahl::os
