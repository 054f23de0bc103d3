// Saves the finished bands of a picture in a file beside it while it is traced.
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "image/band_file.h"
#include "image/picture_writer.h"
#include "scene/scene.h"

namespace strahl {

/// Return a hash of the running program, and one of the mesh files that a scene names.
std::string hash_of_program();
std::string hash_of_meshes(const Scene& scene);

/// Returns the file beside a picture in which its bands are saved; removes it, if it is there.
std::string checkpoint_of(const std::string& picture);
void remove_checkpoint(const std::string& picture);

class Checkpoint {
  public:
    /// `path` is empty for pictures that go to a pipe, which have no checkpoint. `header` is called when it is first
    /// needed. Bands are saved every `interval` seconds, and when many are in memory.
    Checkpoint(PictureWriter& writer, std::string path, std::function<BandHeader()> header, double interval);

    /// Continues from the file, if it is there. Throws UsageError if it belongs to another picture.
    void resume();
    /// Saves the finished bands, if that is due. May be called from any thread.
    void save_if_due();
    /// Saves the finished bands. Returns whether there is a file.
    bool save();
    /// Renames the file to that of a finished part.
    void become(const std::string& part);

  private:
    void append();

    using Clock = std::chrono::steady_clock;

    PictureWriter& writer;
    const std::string own_path;
    const std::function<BandHeader()> header;
    const Clock::duration interval;
    std::mutex mutex;  // guards the following members
    Clock::time_point last = Clock::now();
    std::shared_ptr<BandFile> file;
};

/// Throws UsageError with the file's path if it belongs to another picture than `header`.
void require_same(const BandFile& file, const BandHeader& header);

}  // namespace strahl
