#include "tests/attack/readers.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "files/error.h"
#include "image/band_file.h"
#include "show/window/window_state.h"
#include "show/window/with/samples.h"
#include "show/work/rocket.h"
#include "text/reading/tracks_file.h"

namespace strahl {
namespace {

void promise(bool kept, const char* what) {
    if (!kept) throw std::logic_error(what);
}

/// Tracks that are read are the same after they were written and read again, and their rows increase.
void tracks(std::string_view bytes) {
    const std::vector<Track> tracks = parse_tracks(bytes, "fuzz");
    promise(parse_tracks(write_tracks(tracks), "written") == tracks, "tracks written and read again are others");
    for (const Track& track : tracks)
        promise(std::ranges::adjacent_find(track.keys, std::greater_equal(), &TrackKey::row) == track.keys.end(),
                "rows do not increase");
}

/// Commands are the same whether they come byte by byte or at once.
void rocket(std::string_view bytes) {
    RocketDecoder whole, cut;
    std::vector<RocketCommand> commands, others;
    const bool good = whole.feed(bytes, commands);
    bool good_in_pieces = true;
    for (std::size_t i = 0; i < bytes.size(); ++i) good_in_pieces &= cut.feed(bytes.substr(i, 1), others);
    promise(good == good_in_pieces && commands.size() == others.size(), "commands depend on where they are cut");
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const RocketCommand &a = commands[i], &b = others[i];
        promise(a.kind == b.kind && a.track == b.track && a.key == b.key && a.paused == b.paused, "another command");
        promise(a.key.row >= 0 && a.key.row <= 1'000'000'000 && std::abs(a.key.value) <= 1e9, "a key out of range");
    }
    if (!good) throw FileError("not in the protocol");
}

/// Sound has as many bytes as whole moments have.
void sound(std::string_view bytes) {
    if (bytes.empty()) throw FileError("empty");
    // fmemopen does not write to a file that is opened for reading.
    std::FILE* const file = ::fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb");
    const Samples samples = decode_ogg(file, "fuzz", std::atomic<bool>(false));
    if (!samples.fault.empty()) throw FileError(samples.fault);
    promise(samples.channels == 1 || samples.channels == 2, "too many channels");
    promise(samples.rate > 0, "no rate");
    promise(samples.bytes.size() % (2 * unsigned(samples.channels)) == 0, "a part of a sample");
}

/// All bands that a checkpoint has can be read, and are as long as it is at most.
void checkpoint(std::string_view bytes) {
    const int memory = ::memfd_create("checkpoint", MFD_CLOEXEC);
    std::FILE* const file = memory < 0 ? nullptr : ::fdopen(memory, "wb");
    if (!file) throw std::runtime_error("no file in memory");
    const auto close = [](std::FILE* own) { std::fclose(own); };
    const std::unique_ptr<std::FILE, decltype(close)> closer(file, close);
    if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fflush(file) != 0)
        throw std::runtime_error("the file in memory cannot be written");
    const BandFile bands("/proc/self/fd/" + std::to_string(memory));
    for (int band = 0; band < 1000; ++band)
        if (bands.has(band))
            promise(bands.bytes(band).size() + bands.note(band).size() <= bytes.size(), "a band longer than its file");
    const BandHeader& header = bands.header();
    promise(header.layout.width > 0 && header.layout.height > 0 && header.parts >= header.part, "a broken header");
}

/// The sizes of a window are 0 for the default or usable.
void window(std::string_view bytes) {
    const std::optional<WindowState> state = window_state_in(bytes);
    if (!state) throw FileError("no state");
    const auto usable = [](int size) { return size >= 64 && size <= 16384; };
    promise((state->width == 0 && state->height == 0) || (usable(state->width) && usable(state->height)),
            "impossible sizes");
}

}  // namespace

const std::array<AttackedReader, 5> attacked_readers{
    {{".tracks", tracks}, {".rocket", rocket}, {".ogg", sound}, {".checkpoint", checkpoint}, {".window", window}}};

}  // namespace strahl
