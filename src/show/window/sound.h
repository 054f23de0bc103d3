// Sound beside the picture: an Ogg Vorbis file that is played from any moment on.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace strahl {

class Sound {
  public:
    /// Decodes the file on a thread of its own, which calls `notify` when it is done.
    Sound(const std::string& path, std::function<void()> notify);
    ~Sound();
    Sound(const Sound&) = delete;

    /// While it does, nothing is played, and there is no fault yet.
    bool loading() const;
    /// Why nothing will be heard: there is no device, or the file is damaged. Empty if it can be played.
    std::string fault() const;
    /// From a moment in seconds; after the end there is silence.
    void play(double seconds);
    void pause();
    /// The moment that leaves the loudspeakers now, as far as the device tells; nothing while there is silence.
    std::optional<double> heard() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
};

}  // namespace strahl
