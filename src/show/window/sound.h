// Plays an Ogg Vorbis file from any moment on.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strahl {

class Sound {
  public:
    /// Decodes the file on a thread of its own, which calls `notify` when it is done.
    Sound(const std::string& path, std::function<void()> notify);
    ~Sound();
    Sound(const Sound&) = delete;

    /// Is the file still being decoded? Until then nothing is played, and fault() is empty.
    bool loading() const;
    /// The reason why nothing can be heard: there is no device, or the file is damaged. Empty if it can be played.
    std::string fault() const;
    /// The greatest amplitude in each hundredth of a second, from 0 to 1, also where nothing can be heard. Empty while
    /// the file is being decoded.
    const std::vector<float>& peaks() const;
    /// Plays from a moment, in seconds; after the end of the file there is silence.
    void play(double seconds);
    void pause();
    /// The moment of the file that leaves the loudspeakers now, if the device tells its latency; nothing in silence.
    std::optional<double> heard() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
};

}  // namespace strahl
