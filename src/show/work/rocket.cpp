#include "show/work/rocket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "scene/error.h"
#include "text/reading/messages.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

constexpr std::string_view demo_greeting = "hello, synctracker!", editor_greeting = "hello, demo!";
constexpr char get_track = 2, set_row = 3;
constexpr std::uint32_t last_row = 1'000'000'000;
constexpr std::size_t most_unsent = 1 << 20;

/// Returns the length of a command by its first byte; 0 if the protocol has no such command.
std::size_t length_of(char command) {
    constexpr std::array<std::size_t, 6> lengths{14, 9, 0, 5, 2, 1};
    const auto number = static_cast<unsigned char>(command);
    return number < lengths.size() ? lengths[number] : 0;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[i]);
    return number;
}
std::string bytes_of(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xFF);
    return bytes;
}

/// Decodes a whole command; nothing if it is to be ignored. Sets `broken` if it is invalid.
std::optional<RocketCommand> command_of(std::string_view bytes, bool& broken) {
    using Kind = RocketCommand::Kind;
    switch (bytes[0]) {
        case 0:
        case 1: {
            RocketCommand command{bytes[0] == 0 ? Kind::set_key : Kind::delete_key, number_at(bytes, 1)};
            const std::uint32_t row = number_at(bytes, 5);
            command.key.row = static_cast<int>(std::min(row, last_row));
            if (row > last_row) return std::nullopt;
            if (command.kind == Kind::delete_key) return command;
            const float value = std::bit_cast<float>(number_at(bytes, 9));
            const auto way = static_cast<unsigned char>(bytes[13]);
            broken |= way >= interpolations;
            if (broken || !std::isfinite(value)) return std::nullopt;
            command.key.value = std::clamp<double>(value, coordinates.low, coordinates.high);
            command.key.way = static_cast<Interpolation>(way);
            return command;
        }
        case set_row: {
            RocketCommand command{Kind::set_row};
            command.key.row = static_cast<int>(std::min(number_at(bytes, 1), last_row));
            return command;
        }
        case 4:
            return RocketCommand{.kind = Kind::pause, .paused = bytes[1] != 0};
        default:
            return RocketCommand{Kind::save};
    }
}

std::string address_of(int port) { return "127.0.0.1:" + std::to_string(port); }

/// Receives as many bytes as the greeting has; fewer if the connection ends or nothing comes for 2 seconds.
std::string greeting_from(int socket) {
    std::string text;
    char buffer[editor_greeting.size()];
    while (text.size() < editor_greeting.size()) {
        const ssize_t got = ::recv(socket, buffer, editor_greeting.size() - text.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        text.append(buffer, static_cast<std::size_t>(got));
    }
    return text;
}

void set_timeout(int socket, int seconds) {
    const timeval time{seconds, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
}

}  // namespace

bool RocketDecoder::feed(std::string_view bytes, std::vector<RocketCommand>& commands) {
    rest += bytes;
    std::string_view left = rest;
    while (!broken && !left.empty()) {
        const std::size_t length = length_of(left[0]);
        broken = length == 0;
        if (broken || left.size() < length) break;
        if (const auto command = command_of(left.substr(0, length), broken)) commands.push_back(*command);
        left.remove_prefix(length);
    }
    rest.erase(0, rest.size() - left.size());
    return !broken;
}

Rocket::Rocket(int port) : socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const auto fail = [&](const std::string& why) -> void {
        if (socket >= 0) ::close(socket);
        throw FileError(why);
    };
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (socket < 0 || ::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        fail("no GNU Rocket editor at " + address_of(port) + ": " + std::strerror(errno));
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    set_timeout(socket, 2);
    const ssize_t sent = ::send(socket, demo_greeting.data(), demo_greeting.size(), MSG_NOSIGNAL);
    const std::string answer = sent == ssize_t(demo_greeting.size()) ? greeting_from(socket) : "";
    if (answer != editor_greeting)
        fail(address_of(port) + " is not a GNU Rocket editor: it " +
             (answer.empty() ? "sends no greeting" : "greets with " + strahl::quoted(answer)));
    set_timeout(socket, 0);
}

Rocket::~Rocket() {
    thread.request_stop();
    ::shutdown(socket, SHUT_RDWR);
    if (thread.joinable()) thread.join();
    ::close(socket);
}

void Rocket::listen(std::function<void()> function) {
    notify = std::move(function);
    thread = std::jthread([this](std::stop_token quit) { read(quit); });
}

void Rocket::read(std::stop_token quit) {
    RocketDecoder decoder;
    std::vector<char> buffer(1 << 16);
    for (bool well = true; well && !quit.stop_requested();) {
        const ssize_t got = ::recv(socket, buffer.data(), buffer.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        const std::string why = got == 0 ? "it has ended the connection" : got < 0 ? std::strerror(errno) : "";
        {
            std::lock_guard lock(mutex);
            if (got <= 0)
                lost = why, well = false;
            else if (!decoder.feed({buffer.data(), static_cast<std::size_t>(got)}, commands))
                lost = "it sent something that is not in the protocol", well = false;
        }
        notify();
    }
}

RocketNews Rocket::take() {
    RocketNews news;
    std::vector<RocketCommand> taken;
    {
        std::lock_guard lock(mutex);
        taken.swap(commands);
        news.lost = lost;
    }
    for (const RocketCommand& command : taken) apply(command, news);
    if (!unsent.empty()) send("");
    return news;
}

void Rocket::apply(const RocketCommand& command, RocketNews& news) {
    using Kind = RocketCommand::Kind;
    const bool of_key = command.kind == Kind::set_key || command.kind == Kind::delete_key;
    if (of_key && command.track >= asked.size()) {
        news.lost = "it changed a track that Strahl did not ask for";
        return;
    }
    news.keys |= of_key;
    if (command.kind == Kind::set_key) set_key(asked[command.track], command.key);
    if (command.kind == Kind::delete_key) delete_key(asked[command.track], command.key.row);
    if (command.kind == Kind::set_row) news.row = command.key.row;
    if (command.kind == Kind::pause) news.paused = command.paused;
    if (command.kind == Kind::save) news.save = true;
}

/// Sends what is not sent yet, then these bytes. What cannot be sent now is kept for later.
void Rocket::send(std::string_view bytes) {
    unsent += bytes;
    while (!unsent.empty()) {
        const ssize_t sent = ::send(socket, unsent.data(), unsent.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) break;
        unsent.erase(0, static_cast<std::size_t>(sent));
    }
    if (unsent.size() < most_unsent) return;
    std::lock_guard lock(mutex);
    lost = "it does not read what it is sent";
}

void Rocket::ask(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (std::ranges::find(asked, name, &Track::name) != asked.end()) continue;
        asked.push_back({name, {}});
        send(std::string(1, get_track) + bytes_of(static_cast<std::uint32_t>(name.size())) + name);
    }
}

void Rocket::tell_row(int row) {
    if (told == row || !unsent.empty()) return;
    told = row;
    send(std::string(1, set_row) + bytes_of(static_cast<std::uint32_t>(row)));
}

std::vector<Track> with_tracks(std::vector<Track> tracks, const std::vector<Track>& newer) {
    for (const Track& track : newer) {
        const auto old = std::ranges::find(tracks, track.name, &Track::name);
        if (old == tracks.end())
            tracks.push_back(track);
        else
            *old = track;
    }
    return tracks;
}

}  // namespace strahl
