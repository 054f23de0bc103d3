#include "show/work/rocket.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include "files/bytes.h"
#include "files/error.h"
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

std::uint32_t number_at(std::string_view bytes, std::size_t at) { return get_big<std::uint32_t>(bytes, at); }
std::string bytes_of(std::uint32_t number) {
    std::string bytes;
    put_big(bytes, number);
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
std::string greeting_from(os::Connection& connection) {
    std::string text;
    char buffer[editor_greeting.size()];
    while (text.size() < editor_greeting.size()) {
        const std::ptrdiff_t got = connection.receive(buffer, editor_greeting.size() - text.size());
        if (got <= 0) break;
        text.append(buffer, static_cast<std::size_t>(got));
    }
    return text;
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

Rocket::Rocket(int port) try : connection(port) {
    connection.set_timeout(2);
    const bool sent = connection.send(demo_greeting) == demo_greeting.size();
    const std::string answer = sent ? greeting_from(connection) : "";
    if (answer != editor_greeting)
        throw FileError(address_of(port) + " is not a GNU Rocket editor: it " +
                        (answer.empty() ? "sends no greeting" : "greets with " + strahl::quoted(answer)));
    connection.set_timeout(0);
} catch (const std::system_error& error) {
    throw FileError("no GNU Rocket editor at " + address_of(port) + ": " + error.code().message());
}

Rocket::~Rocket() { connection.end(); }

void Rocket::listen(std::function<void()> notify) {
    worker.emplace(std::move(notify));
    worker->add([this](const std::atomic<bool>&) { return receive(); });
}

/// Receives until the connection ends.
Rocket::Received Rocket::receive() {
    RocketDecoder decoder;
    std::vector<char> buffer(1 << 16);
    while (true) {
        Received received;
        const std::ptrdiff_t got = connection.receive(buffer.data(), buffer.size());
        if (got <= 0) return {{}, got ? std::strerror(int(-got)) : "it has ended the connection"};
        if (!decoder.feed({buffer.data(), static_cast<std::size_t>(got)}, received.commands))
            received.lost = "it sent something that is not in the protocol";
        if (!received.lost.empty()) return received;
        worker->give(std::move(received));
    }
}

RocketNews Rocket::take() {
    RocketNews news;
    while (auto received = worker ? worker->take() : std::nullopt) {
        for (const RocketCommand& command : received->commands) apply(command, news);
        if (lost.empty()) lost = received->lost;
    }
    if (!unsent.empty()) send("");
    if (news.lost.empty()) news.lost = lost;
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
    unsent.erase(0, connection.send(unsent));
    if (unsent.size() >= most_unsent) lost = "it does not read what it is sent";
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
