// Plays nothing, in builds without sound.
#include "show/window/sound.h"

namespace strahl {

struct Sound::Implementation {};

Sound::Sound(const std::string&, std::function<void()>) {}
Sound::~Sound() = default;
bool Sound::loading() const { return false; }
std::string Sound::fault() const { return "strahl was built without sound (OpenAL and libvorbisfile)"; }
void Sound::play(double) {}
void Sound::pause() {}
std::optional<double> Sound::heard() const { return std::nullopt; }

}  // namespace strahl
