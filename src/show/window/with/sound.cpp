// Plays samples by OpenAL Soft (openal-soft.org).
#include "show/window/sound.h"

#define AL_ALEXT_PROTOTYPES
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "files/os/system.h"
#include "show/window/with/samples.h"
#include "show/work/worker.h"

namespace strahl {
namespace {

/// A handler of ALSA's messages: file, line, function, error, form.
void ignore_message(const char*, int, const char*, int, const char*, ...) {}

/// Keeps the messages of OpenAL and of ALSA, which it loads, off the terminal: fault() says why there is no sound.
void quieten() {
    os::set_variable("ALSOFT_LOGLEVEL", "0");
    const os::Library alsa("libasound.so.2");
    if (auto* const set = alsa.function<int(decltype(&ignore_message))>("snd_lib_error_set_handler"))
        set(ignore_message);
}

}  // namespace

struct Sound::Implementation {
    ALCdevice* device = nullptr;
    ALCcontext* context = nullptr;
    ALuint source = 0, buffer = 0;
    double length = 0;  // in seconds
    bool tells_latency = false;
    std::vector<float> peaks;
    std::string fault;
    Worker<std::monostate> worker;

    explicit Implementation(std::function<void()> notify) : worker(std::move(notify)) {}

    void load(const std::string& path, const std::atomic<bool>& stop) {
        const Samples samples = decode_ogg(std::fopen(path.c_str(), "rb"), "'" + path + "'", stop);
        fault = samples.fault;
        if (!fault.empty() || stop) return;
        peaks = peaks_of(samples);
        fault = os::Library(STRAHL_OPENAL).fault();  // Windows links it at the first call, which must not fail
        if (!fault.empty()) return;
        device = ::alcOpenDevice(nullptr);
        context = device ? ::alcCreateContext(device, nullptr) : nullptr;
        if (!context || !::alcMakeContextCurrent(context)) return void(fault = "there is no sound device");
        length = double(samples.bytes.size()) / (2. * samples.channels * samples.rate);
        ::alGenSources(1, &source), ::alGenBuffers(1, &buffer);
        ::alBufferData(buffer, samples.channels == 1 ? AL_FORMAT_MONO16 : AL_FORMAT_STEREO16, samples.bytes.data(),
                       static_cast<ALsizei>(samples.bytes.size()), samples.rate);
        ::alSourcei(source, AL_BUFFER, static_cast<ALint>(buffer));
        if (::alIsExtensionPresent("AL_SOFT_direct_channels")) ::alSourcei(source, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
        tells_latency = ::alIsExtensionPresent("AL_SOFT_source_latency");
        if (::alGetError() != AL_NO_ERROR) fault = "the sound device does not accept '" + path + "'";
    }
    ~Implementation() {
        worker.cancel();
        if (source) ::alDeleteSources(1, &source);
        if (buffer) ::alDeleteBuffers(1, &buffer);
        if (context) ::alcMakeContextCurrent(nullptr), ::alcDestroyContext(context);
        if (device) ::alcCloseDevice(device);
    }
};

Sound::Sound(const std::string& path, std::function<void()> notify)
    : implementation(std::make_unique<Implementation>(std::move(notify))) {
    quieten();
    implementation->worker.add([own = implementation.get(), path](const std::atomic<bool>& stop) {
        own->load(path, stop);
        return std::nullopt;
    });
}
Sound::~Sound() = default;

bool Sound::loading() const { return implementation->worker.busy(); }

const std::vector<float>& Sound::peaks() const {
    static const std::vector<float> none;
    return loading() ? none : implementation->peaks;
}

std::string Sound::fault() const { return loading() ? "" : implementation->fault; }

void Sound::play(double seconds) {
    if (loading() || !implementation->fault.empty()) return;
    const ALuint source = implementation->source;
    ::alSourceStop(source);
    if (!(seconds >= 0 && seconds < implementation->length)) return;
    ::alSourcef(source, AL_SEC_OFFSET, static_cast<float>(seconds));
    ::alSourcePlay(source);
}

void Sound::pause() {
    if (!loading() && implementation->fault.empty()) ::alSourceStop(implementation->source);
}

std::optional<double> Sound::heard() const {
    if (loading() || !implementation->fault.empty()) return std::nullopt;
    ALint state = 0;
    ::alGetSourcei(implementation->source, AL_SOURCE_STATE, &state);
    if (state != AL_PLAYING) return std::nullopt;
    std::array<ALdouble, 2> place{};  // the moment that is mixed, and the time until it is heard
    if (implementation->tells_latency)
        ::alGetSourcedvSOFT(implementation->source, AL_SEC_OFFSET_LATENCY_SOFT, place.data());
    else
        ::alGetSourcedvSOFT(implementation->source, AL_SEC_OFFSET, place.data());
    return place[0] - place[1];
}

}  // namespace strahl
