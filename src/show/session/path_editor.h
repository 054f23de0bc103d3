// The camera's path while it is edited, with undo and redo.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/camera.h"
#include "show/session/edits.h"
#include "text/write.h"

namespace strahl {

/// Returns a key at the camera. Its numbers are rounded to 1/100,000 of the distance to look_at or less, to be short in
/// the file. Values that equal those of the scene's camera are omitted.
Keyframe key_of(const Camera& camera, const Camera& scene_camera, double time);

/// Returns `path` with this key, which replaces one at the same time.
Flythrough with_key(Flythrough path, const Keyframe& key);
/// Returns `path` continued by a key `seconds` after its last one. A path that returns to its first key loops.
Flythrough continued(Flythrough path, Keyframe key, double seconds);
Flythrough without_key(Flythrough path, std::size_t number);
/// Returns `path` with a key moved to another time; it stays between its neighbours, 1 ms from them.
Flythrough retimed(Flythrough path, std::size_t number, double time);

/// Returns `path` with another duration, which reaches at least to its last key, or beyond it if the path loops.
Flythrough lasting(Flythrough path, double seconds);
/// Returns `path` closed, with so many seconds for the way back to its first key unless it has them; or, if it is
/// closed, open, ending with its last key.
Flythrough looped(Flythrough path, double seconds);

/// Returns the number of the key at this time, within half a millisecond.
std::optional<std::size_t> key_at(const Flythrough& path, double time);

/// Rounds to milliseconds, as all times of keys are that the user sets.
double rounded_time(double seconds);

class PathEditor {
  public:
    explicit PathEditor(const std::optional<Flythrough>& in_file)
        : present(in_file.value_or(Flythrough{})), saved(present) {}

    /// May have one key or none: then it cannot be flown yet.
    const Flythrough& path() const { return present; }
    bool changed() const { return present != saved; }

    /// To be called when the scene file was read, with its path. If that has changed it replaces the edited one, which
    /// undo brings back. Returns whether the edited one had changes that were not written.
    bool reload(const std::optional<Flythrough>& in_file, EditOrder& order);

    void change(Flythrough newer, const Edit& edit);
    /// Replaces the path by one that is not made from it.
    void replace(Flythrough newer, const Edit& edit);
    /// Takes the last change back, or makes it again. Returns what it was; nothing if there is none.
    std::optional<std::string> undo(bool back, EditOrder& order);
    /// See EditSteps::next.
    std::size_t next_step(bool back, const EditOrder& order) const { return steps.next(back, order); }

    EyeWords words;  // in which the scene says directions up and angles of view

    /// Returns the paths that would be lost now: those that were replaced before they were written, the oldest first,
    /// and the present one.
    std::vector<Flythrough> unwritten() const;

  private:
    Flythrough present, saved;
    EditSteps<Flythrough> steps;       // undo and redo: the path before or after each step
    std::vector<Flythrough> replaced;  // paths as they were before each was written
};

}  // namespace strahl
