#include "files/os/connection.h"

#include <winsock2.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include "files/os/windows/win32.h"

namespace strahl::os {
namespace {

SOCKET socket_of(const Descriptor& socket) { return reinterpret_cast<SOCKET>(handle_of(socket)); }

Descriptor new_socket() {
    WSADATA ignored;
    ::WSAStartup(MAKEWORD(2, 2), &ignored);
    return descriptor_of(reinterpret_cast<HANDLE>(::WSASocketW(AF_INET, SOCK_STREAM, IPPROTO_TCP, nullptr, 0, 0)));
}

int last_error() {
    switch (::WSAGetLastError()) {
        case WSAECONNREFUSED:
            return ECONNREFUSED;
        case WSAECONNRESET:
            return ECONNRESET;
        case WSAETIMEDOUT:
            return EAGAIN;
        default:
            return EIO;
    }
}

}  // namespace

Connection::Connection(int port) : socket(new_socket()) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = ::htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    if (!socket || ::connect(socket_of(socket), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::system_error(last_error(), std::generic_category());
    const int on = 1;
    ::setsockopt(socket_of(socket), IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&on), sizeof on);
}

std::ptrdiff_t Connection::receive(char* buffer, std::size_t size) {
    const int got = ::recv(socket_of(socket), buffer, int(std::min<std::size_t>(size, 1 << 30)), 0);
    return got >= 0 ? got : -last_error();
}

void Connection::set_timeout(int seconds) {
    const DWORD time = DWORD(seconds) * 1000;
    ::setsockopt(socket_of(socket), SOL_SOCKET, SO_RCVTIMEO, reinterpret_cast<const char*>(&time), sizeof time);
}

std::size_t Connection::send(std::string_view bytes) {
    std::size_t done = 0;
    timeval now{};
    while (done < bytes.size()) {
        fd_set ready{1, {socket_of(socket)}};
        if (::select(0, nullptr, &ready, nullptr, &now) != 1) break;
        const int sent = ::send(socket_of(socket), bytes.data() + done, int(bytes.size() - done), 0);
        if (sent < 0) break;
        done += std::size_t(sent);
    }
    return done;
}

void Connection::end() {
    ::shutdown(socket_of(socket), SD_BOTH);    // ends what receives later,
    ::CancelIoEx(handle_of(socket), nullptr);  // and this what receives now
}

}  // namespace strahl::os
