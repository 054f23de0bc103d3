// The camera's path while it is edited, with undo and redo.
#pragma once
#include <optional>
#include <vector>

#include "scene/camera.h"

namespace strahl {

/// A key at the camera, rounded to a 100,000th of the distance to look_at or less, so that it is short to read. It
/// omits values that equal those of the scene's camera.
Keyframe key_of(const Camera& camera, const Camera& scene_camera, double time);

/// `path` with a key at its time, in place of one that is there already.
Flythrough with_key(Flythrough path, const Keyframe& key);
/// `path` continued by a key `seconds` after its last one. A path that returns to its first key loops.
Flythrough continued(Flythrough path, Keyframe key, double seconds);
Flythrough without_key(Flythrough path, std::size_t number);
/// `path` with a key moved to another time; it stays between its neighbours, 1 ms from them.
Flythrough retimed(Flythrough path, std::size_t number, double time);

/// The number of the key at this time, to half a millisecond.
std::optional<std::size_t> key_at(const Flythrough& path, double time);

/// The times that hands give keys are whole milliseconds.
double rounded_time(double seconds);

class PathEditor {
  public:
    explicit PathEditor(const std::optional<Flythrough>& in_file) { reload(in_file), past.clear(); }

    /// Perhaps of one key or of none, and so no path yet.
    const Flythrough& path() const { return present; }
    bool changed() const { return present != saved; }

    /// The scene file was read, and has this path. If it is another one than before it is taken, and can be undone.
    void reload(const std::optional<Flythrough>& in_file);

    /// If `merged` this and the change before are undone together, as the steps of one drag are.
    void change(Flythrough newer, bool merged = false);
    bool undo();
    bool redo();

  private:
    Flythrough present, saved;
    std::vector<Flythrough> past, future;
};

}  // namespace strahl
