// Tracks: numbers that change with the rows of the music, as GNU Rocket has them, and the numbers that follow them.
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strahl {

/// How a track goes from a key to the next, with t the share of the rows between them that is over: it stays, or goes
/// as t, t^2 (3 - 2 t) or t^2. Numbered as in GNU Rocket's protocol.
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
    std::vector<TrackKey> keys;  // rows increase strictly
    bool operator==(const Track&) const = default;
};
/// The value at a row, or between two: that of the first key before it, that of the last key after it. Needs a key.
double value_at(const Track& track, double row);
/// Puts a key into a track, in place of one in the same row.
void set_key(Track& track, const TrackKey& key);
/// Removes the key of a row, if there is one.
void delete_key(Track& track, int row);

/// The tempo of the tracks, and the sound.
struct Music {
    double bpm = 120;   // beats per minute
    double rows = 8;    // per beat
    std::string sound;  // an Ogg Vorbis file, as the scene names it, heard from the start of the flight; or empty
    double offset = 0;  // when the first beat is, row 0: seconds from the start of the flight, 0 or more
    /// The row at a time, negative before the first beat; a whole number if it is one up to rounding.
    double row_at(double seconds) const {
        const double row = (seconds - offset) * (bpm * rows / 60), whole = std::round(row);
        return std::fabs(row - whole) < 1e-6 ? whole : row;
    }
    double time_of(double row) const { return offset + row * 60 / (bpm * rows); }
    bool operator==(const Music&) const = default;
};

/// A number of a struct that follows a track. For a track without keys the number stays as it is.
struct Follow {
    std::string track, parameter;
    int component = 0;         // of a vector
    double factor = 1;         // by which the track's value is multiplied
    double low = 0, high = 0;  // the range of the number
    bool operator==(const Follow&) const = default;
};
/// Sorts them by parameter and component, so that the order in a text does not matter.
void sort(std::vector<Follow>& follows);
/// Does any number of this parameter follow a track?
bool any_follows(const std::vector<Follow>& follows, std::string_view parameter);

/// The values of tracks at a row, by name. Tracks without keys have none.
class TrackValues {
  public:
    TrackValues() = default;
    TrackValues(const std::vector<Track>& tracks, double row);
    /// The value of a track; null if it has none.
    const double* find(std::string_view track) const;

  private:
    std::vector<std::pair<std::string, double>> values;  // sorted
};

}  // namespace strahl
