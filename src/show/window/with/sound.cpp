// Plays by OpenAL Soft (openal-soft.org) what libvorbisfile decodes.
#include "show/window/sound.h"

#define AL_ALEXT_PROTOTYPES
#define OV_EXCLUDE_STATIC_CALLBACKS
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <dlfcn.h>
#include <vorbis/vorbisfile.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstdlib>
#include <memory>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace strahl {
namespace {

/// Samples of 16 bits, one per channel and moment.
struct Samples {
    std::vector<char> bytes;
    int channels = 0, rate = 0;
    std::string fault;
};

/// A handler of ALSA's messages: file, line, function, error, form.
void ignore_message(const char*, int, const char*, int, const char*, ...) {}

/// Keeps the messages of OpenAL and of ALSA, which it loads, off the terminal: fault() says why there is no sound.
void quieten() {
    ::setenv("ALSOFT_LOGLEVEL", "0", 0);
    void* const alsa = ::dlopen("libasound.so.2", RTLD_LAZY);
    if (void* const set = alsa ? ::dlsym(alsa, "snd_lib_error_set_handler") : nullptr)
        reinterpret_cast<int (*)(decltype(&ignore_message))>(set)(ignore_message);
}

Samples decoded(const std::string& path, const std::stop_token& stop) {
    Samples samples;
    OggVorbis_File opened;
    if (::ov_fopen(path.c_str(), &opened) != 0) return {{}, 0, 0, "'" + path + "' is not an Ogg Vorbis file"};
    const std::unique_ptr<OggVorbis_File, int (*)(OggVorbis_File*)> file(&opened, ::ov_clear);
    const vorbis_info first = *::ov_info(&opened, -1);
    samples.channels = first.channels, samples.rate = static_cast<int>(first.rate);
    constexpr std::size_t most = std::size_t(1) << 30;
    std::array<char, 1 << 16> block;
    for (int part = 0; !stop.stop_requested();) {
        const int big_endian = std::endian::native == std::endian::big;
        const long got = ::ov_read(&opened, block.data(), static_cast<int>(block.size()), big_endian, 2, 1, &part);
        const vorbis_info* const now = ::ov_info(&opened, -1);
        if (got == OV_HOLE) continue;
        if (got < 0) return {{}, 0, 0, "'" + path + "' is damaged"};
        if (got == 0) break;
        if (now->channels != first.channels || now->rate != first.rate || first.channels > 2)
            return {{}, 0, 0, "'" + path + "' must be mono or stereo, and the same throughout"};
        samples.bytes.insert(samples.bytes.end(), block.data(), block.data() + got);
        if (samples.bytes.size() > most) return {{}, 0, 0, "'" + path + "' is longer than a gigabyte of samples"};
    }
    if (samples.bytes.empty()) samples.fault = "'" + path + "' holds no sound";
    return samples;
}

}  // namespace

struct Sound::Implementation {
    ALCdevice* device = nullptr;
    ALCcontext* context = nullptr;
    ALuint source = 0, buffer = 0;
    double length = 0;  // in seconds
    bool tells_latency = false;
    std::string fault;
    std::atomic<bool> done = false;
    std::jthread thread;

    void load(const std::string& path, const std::stop_token& stop) {
        device = ::alcOpenDevice(nullptr);
        context = device ? ::alcCreateContext(device, nullptr) : nullptr;
        if (!context || !::alcMakeContextCurrent(context)) return void(fault = "there is no sound device");
        const Samples samples = decoded(path, stop);
        fault = samples.fault;
        if (!fault.empty() || stop.stop_requested()) return;
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
        thread = {};
        if (source) ::alDeleteSources(1, &source);
        if (buffer) ::alDeleteBuffers(1, &buffer);
        ::alcMakeContextCurrent(nullptr);
        if (context) ::alcDestroyContext(context);
        if (device) ::alcCloseDevice(device);
    }
};

Sound::Sound(const std::string& path, std::function<void()> notify)
    : implementation(std::make_unique<Implementation>()) {
    quieten();
    implementation->thread = std::jthread([own = implementation.get(), path, notify](const std::stop_token& stop) {
        own->load(path, stop);
        own->done = true;
        notify();
    });
}
Sound::~Sound() = default;

bool Sound::loading() const { return !implementation->done; }

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
