// The demo's side of GNU Rocket's protocol: an editor listens at the loopback address, and changes tracks meanwhile.
// As github.com/rocket/rocket, lib/device.c, has it: numbers are big-endian, tracks are numbered as they are asked for.
#pragma once
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "scene/motion/track.h"

namespace strahl {

/// What an editor asks for.
struct RocketCommand {
    enum class Kind { set_key, delete_key, set_row, pause, save } kind;
    std::uint32_t track = 0;  // of a key
    TrackKey key{};           // or the row alone
    bool paused = false;
};

/// Takes apart what an editor sends, however it is cut into packets.
class RocketDecoder {
  public:
    /// Adds what these bytes complete. A key whose value is no number or whose row is beyond 1e9 is left out, and
    /// values stay within -1e9 to 1e9. False once there was something else than the protocol's commands: what follows
    /// can't be read.
    bool feed(std::string_view bytes, std::vector<RocketCommand>& commands);

  private:
    std::string rest;
    bool broken = false;
};

/// What has happened since it was asked last; of rows and pauses the last one.
struct RocketNews {
    bool keys = false;
    std::optional<int> row;
    std::optional<bool> paused;
    bool save = false;
    std::string lost;  // why the editor is gone, or empty
};

class Rocket {
  public:
    static constexpr int usual_port = 1338;

    /// Connects and exchanges greetings, for which it waits 2 seconds. Throws FileError.
    explicit Rocket(int port);
    ~Rocket();
    Rocket(const Rocket&) = delete;

    /// From now on `notify` is called, from another thread, when there are news.
    void listen(std::function<void()> notify);
    RocketNews take();

    /// Asks for the tracks of these names, those already asked for excepted. They have no keys until some arrive.
    void ask(const std::vector<std::string>& names);
    /// Those asked for.
    const std::vector<Track>& tracks() const { return asked; }
    /// Says where the flight is, if it was elsewhere before.
    void tell_row(int row);

  private:
    void read(std::stop_token quit);
    void send(std::string_view bytes);
    void apply(const RocketCommand& command, RocketNews& news);

    int socket = -1;
    std::vector<Track> asked;
    std::optional<int> told;
    std::string unsent;
    std::mutex mutex;
    std::vector<RocketCommand> commands;
    std::string lost;
    std::function<void()> notify;
    std::jthread thread;
};

/// A scene's tracks with those of an editor in place of those that have their names.
std::vector<Track> with_tracks(std::vector<Track> tracks, const std::vector<Track>& newer);

}  // namespace strahl
