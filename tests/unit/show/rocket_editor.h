// The editor's side of GNU Rocket's protocol, as far as tests need it: it listens at a port of the loopback address.
#pragma once
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace strahl {

inline std::string big_endian(std::uint32_t number) {
    return {char(number >> 24), char(number >> 16), char(number >> 8), char(number)};
}
inline std::string key_bytes(std::uint32_t track, std::uint32_t row, float value, char way) {
    return std::string(1, '\0') + big_endian(track) + big_endian(row) +
           big_endian(std::bit_cast<std::uint32_t>(value)) + way;
}
inline std::string delete_bytes(std::uint32_t track, std::uint32_t row) {
    return "\1" + big_endian(track) + big_endian(row);
}
inline std::string row_bytes(std::uint32_t row) { return "\3" + big_endian(row); }
inline std::string pause_bytes(bool paused) { return std::string("\4") + char(paused); }
inline const std::string save_bytes = "\5";

/// Listens at a port of its own and takes one connection.
class Editor {
  public:
    /// Sets for how many seconds reads wait. Any free port is taken if none is given.
    explicit Editor(int patience = 10, int wanted = 0)
        : listener(::socket(AF_INET, SOCK_STREAM, 0)), patience(patience) {
        const int on = 1;
        ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(wanted));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        const auto own = reinterpret_cast<sockaddr*>(&address);
        if (::bind(listener, own, size) != 0 || ::listen(listener, 1) != 0 || ::getsockname(listener, own, &size) != 0)
            throw std::runtime_error("no port to listen at");
        port = ntohs(address.sin_port);
    }
    ~Editor() { end(), ::close(listener); }
    void end() {
        if (connection >= 0) ::close(std::exchange(connection, -1));
    }
    /// Waits for a client, expects its greeting and answers. False if it does not greet.
    bool accept(const std::string& greeting = "hello, demo!") {
        connection = ::accept(listener, nullptr, nullptr);
        const timeval wait{patience, 0};
        ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
        return read(19) == "hello, synctracker!" && send(greeting);
    }
    bool send(const std::string& bytes) {
        return ::send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL) == ssize_t(bytes.size());
    }
    std::string read(std::size_t size) {
        std::string bytes(size, '\0');
        const ssize_t got = ::recv(connection, bytes.data(), size, MSG_WAITALL);
        bytes.resize(std::size_t(std::max<ssize_t>(got, 0)));
        return bytes;
    }
    int port = 0;

  private:
    int listener, patience, connection = -1;
};

}  // namespace strahl
