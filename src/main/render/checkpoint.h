// What is kept of a picture while it is traced: its finished bands, in a file beside it.
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

/// A hash of the running program, and one of the files of meshes that a scene names.
std::string hash_of_program();
std::string hash_of_meshes(const Scene& scene);

/// The file beside a picture in which its bands are kept, and its removal, if it is there.
std::string checkpoint_of(const std::string& picture);
void remove_checkpoint(const std::string& picture);

class Checkpoint {
  public:
    /// `path` is empty for pictures that go to a pipe: of these nothing is kept. `header` is asked for when it is
    /// needed. Bands are kept every `interval` seconds, and when those in memory have become many.
    Checkpoint(PictureWriter& writer, std::string path, std::function<BandHeader()> header, double interval);

    /// Goes on from the file, if it is there. Throws UsageError if that is of another picture.
    void resume();
    /// Keeps what is finished, if it is time for that. From any thread.
    void save_if_due();
    /// Keeps what is finished. Returns whether there is a file.
    bool save();
    /// The file becomes that of a finished part.
    void become(const std::string& part);

  private:
    void append();

    using Clock = std::chrono::steady_clock;

    PictureWriter& writer;
    const std::string own_path;
    const std::function<BandHeader()> header;
    const Clock::duration interval;
    std::mutex mutex;  // of all that follows
    Clock::time_point last = Clock::now();
    std::shared_ptr<BandFile> file;
};

/// Throws UsageError, which names `path`, if the file is of another picture than `header` says.
void require_same(const BandFile& file, const BandHeader& header);

}  // namespace strahl
