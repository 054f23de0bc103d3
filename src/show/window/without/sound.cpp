// Plays nothing, in builds without sound.
#include "show/window/sound.h"

namespace strahl {

struct Sound::Implementation {
    std::vector<float> peaks;
};

Sound::Sound(const std::string&, std::function<void()>) : implementation(std::make_unique<Implementation>()) {}
Sound::~Sound() = default;
bool Sound::loading() const { return false; }
std::string Sound::fault() const { return "strahl was built without sound (OpenAL and libvorbisfile)"; }
const std::vector<float>& Sound::peaks() const { return implementation->peaks; }
void Sound::play(double) {}
void Sound::pause() {}
std::optional<double> Sound::heard() const { return std::nullopt; }

}  // namespace strahl
