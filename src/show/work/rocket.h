// The player's side of GNU Rocket's protocol, as in lib/device.c of github.com/rocket/rocket: an editor listens at the
// loopback address and changes tracks. Numbers are big-endian; tracks are numbered in the order they are asked for.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/os/connection.h"
#include "scene/motion/track.h"
#include "show/work/worker.h"

namespace strahl {

/// A command of the editor.
struct RocketCommand {
    enum class Kind { set_key, delete_key, set_row, pause, save } kind;
    std::uint32_t track = 0;  // index of the track, in messages about keys
    TrackKey key{};           // the key; messages about rows set only its row
    bool paused = false;
};

/// Decodes what an editor sends, however it is cut into packets.
class RocketDecoder {
  public:
    /// Adds the commands that these bytes complete. Keys whose value is NaN or infinite or whose row is beyond 1e9 are
    /// ignored; values are clamped to -1e9 to 1e9. False once there was an invalid command: what follows cannot be
    /// read.
    bool feed(std::string_view bytes, std::vector<RocketCommand>& commands);

  private:
    std::string rest;
    bool broken = false;
};

/// The news since they were taken last; of several rows or pauses only the last one.
struct RocketNews {
    bool keys = false;
    std::optional<int> row;
    std::optional<bool> paused;
    bool save = false;
    std::string lost;  // the reason why the connection has ended, or empty
};

class Rocket {
  public:
    /// Connects and exchanges greetings, for which it waits 2 seconds. Throws FileError.
    explicit Rocket(int port);
    ~Rocket();
    Rocket(const Rocket&) = delete;

    /// Starts to receive. `notify` is called from another thread when there are news.
    void listen(std::function<void()> notify);
    RocketNews take();

    /// Asks for the tracks of these names, unless it has done so before. They have no keys until some arrive.
    void ask(const std::vector<std::string>& names);
    /// The tracks asked for, as the editor has them.
    const std::vector<Track>& tracks() const { return asked; }
    /// Tells the editor the row of the flight, if it has changed.
    void tell_row(int row);

  private:
    /// Holds the commands of one packet, or the reason why the connection has ended.
    struct Received {
        std::vector<RocketCommand> commands;
        std::string lost{};
    };
    Received receive();
    void send(std::string_view bytes);
    void apply(const RocketCommand& command, RocketNews& news);

    os::Connection connection;
    std::vector<Track> asked;
    std::optional<int> told;
    std::string unsent;
    std::string lost;
    std::optional<Worker<Received>> worker;  // once there is one to listen
};

/// Returns `tracks` with those of `newer` added; of equal names the newer one counts.
std::vector<Track> with_tracks(std::vector<Track> tracks, const std::vector<Track>& newer);

}  // namespace strahl
