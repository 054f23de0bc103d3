#include "files/os/connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace strahl::os {

Connection::Connection(int port) : socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (!socket || ::connect(socket.number, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::system_error(errno, std::generic_category());
    const int on = 1;
    ::setsockopt(socket.number, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

std::ptrdiff_t Connection::receive(char* buffer, std::size_t size) {
    while (true) {
        const ssize_t got = ::recv(socket.number, buffer, size, 0);
        if (got >= 0) return got;
        if (errno != EINTR) return -errno;
    }
}

void Connection::set_timeout(int seconds) {
    const timeval time{seconds, 0};
    ::setsockopt(socket.number, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
}

std::size_t Connection::send(std::string_view bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t sent =
            ::send(socket.number, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno != EINTR) break;
        if (sent > 0) done += static_cast<std::size_t>(sent);
    }
    return done;
}

void Connection::end() { ::shutdown(socket.number, SHUT_RDWR); }

}  // namespace strahl::os
