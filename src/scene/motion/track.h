// Tracks: numbers that change with the rows of the music, as GNU Rocket has them, and the numbers that follow them.
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strahl {

/// How a track gets from a key to the next, t being the share of the rows between them that is over: not at all, as t,
/// t^2 (3 - 2 t) or t^2. Numbered as in GNU Rocket's protocol.
enum class Interpolation { step, linear, smooth, ramp };
inline constexpr int interpolations = 4;

struct TrackKey {
    int row = 0;  // 0 or more
    double value = 0;
    Interpolation way = Interpolation::step;  // to the next key
    bool operator==(const TrackKey&) const = default;
};
struct Track {
    std::string name;
    std::vector<TrackKey> keys;  // rows rise strictly
    bool operator==(const Track&) const = default;
};
/// At a row, or between two; before the first key as at that, after the last one as at that. There is a key at least.
double value_at(const Track& track, double row);
/// Puts a key into a track, in place of the one in the same row if there is one. And takes one out.
void set_key(Track& track, const TrackKey& key);
void delete_key(Track& track, int row);

/// How long the rows of the tracks are.
struct Music {
    double bpm = 120;  // beats in a minute
    double rows = 8;   // in a beat
    std::string sound;  // an Ogg Vorbis file, as the scene names it, heard from the start of the flight; or empty
    /// A whole number where it is one but for rounding.
    double row_at(double seconds) const {
        const double row = seconds * (bpm * rows / 60), whole = std::round(row);
        return std::fabs(row - whole) < 1e-6 ? whole : row;
    }
    double time_of(double row) const { return row * 60 / (bpm * rows); }
    bool operator==(const Music&) const = default;
};

/// A number of a struct that follows a track. While the track has no keys it is what the struct says.
struct Follow {
    std::string track, parameter;
    int component = 0;           // of a vector
    double factor = 1;           // by which the track's value is multiplied
    double low = 0, high = 0;    // the number stays within
    bool operator==(const Follow&) const = default;
};
/// In one order, whatever the order in which they were written.
void sort(std::vector<Follow>& follows);
bool any_follows(const std::vector<Follow>& follows, std::string_view parameter);

/// The values of tracks at a moment, by name. Those without keys have none.
class TrackValues {
  public:
    TrackValues() = default;
    TrackValues(const std::vector<Track>& tracks, double row);
    /// Null if there is none.
    const double* find(std::string_view track) const;

  private:
    std::vector<std::pair<std::string, double>> values;  // sorted
};

}  // namespace strahl
