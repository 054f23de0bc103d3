// A library to preload: the n-th allocation, thread or file call of `strahl` comes to harm, counted from main().
#include "fail.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>
#include <unwind.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "calls.h"

namespace strahl::attack {
namespace {

Control* control = nullptr;
bool begun = false;
thread_local bool loading = false;  // within dlopen()
thread_local bool inside = false;   // one of our own calls, or one that is counted already

/// The functions on the stack, and whether one of them is in a library that neither belongs to us nor to the language;
/// the loader works for such libraries.
void describe(const char* function) {
    std::size_t length = static_cast<std::size_t>(std::snprintf(control->where, sizeof control->where, "%s", function));
    void* frames[60];
    const int count = ::backtrace(frames, 60);
    control->foreign |= loading;
    for (int i = 1; i < count; ++i) {
        Dl_info info{};
        if (!::dladdr(frames[i], &info) || !info.dli_fname) continue;
        const char* const slash = std::strrchr(info.dli_fname, '/');
        const char* const file = slash ? slash + 1 : info.dli_fname;
        bool ours = false;
        for (const char* name : {"strahl", "libstrahl_", "libstdc++", "libc.", "libgcc_s", "ld-linux", "libasan",
                                 "libubsan", "libpthread", "libm."})
            ours |= std::strncmp(file, name, std::strlen(name)) == 0;
        control->foreign |= !ours;
        const auto* const base = static_cast<char*>(info.dli_fbase);
        if (length + 100 < sizeof control->where)
            length += static_cast<std::size_t>(std::snprintf(
                control->where + length, 100, " < %.20s+%zx %.60s", file,
                static_cast<std::size_t>(static_cast<char*>(frames[i]) - base), info.dli_sname ? info.dli_sname : ""));
    }
}

/// Notes by which path of calls this allocation came. A function that calls itself counts once, where it was called
/// last. While a library is loaded, what loads it does not count. A place in a library is the same wherever the loader
/// puts that.
void find_path(Watched kind, long number) {
    constexpr int most = 100;
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15;
    void *frames[most], *functions[most];
    const int count = ::backtrace(frames, most);
    std::uint64_t hash = static_cast<std::uint64_t>(kind) + 1;
    for (int i = 1; i < count; ++i) {
        functions[i] = ::_Unwind_FindEnclosingFunction(frames[i]);
        dl_find_object library{};
        if (::_dl_find_object(frames[i], &library) != 0) continue;
        const char* name = library.dlfo_link_map->l_name;
        if (kind == Watched::loading && !*name) break;  // the program itself
        if (std::find(functions + 1, functions + i, functions[i]) != functions + i) continue;
        for (; *name; ++name) hash = (hash ^ static_cast<unsigned char>(*name)) * factor;
        hash = (hash ^ static_cast<std::uint64_t>(static_cast<char*>(frames[i]) -
                                                  static_cast<char*>(library.dlfo_map_start))) *
               factor;
    }
    for (int tried = 0; tried < Control::most_paths; ++tried) {
        Path& path = control->paths[(hash + static_cast<unsigned>(tried)) % Control::most_paths];
        std::uint64_t found = 0;
        if (path.hash.compare_exchange_strong(found, hash)) return void((path.kind = kind, path.first = number));
        if (found == hash) return;
    }
}

}  // namespace

/// Is it this call's turn? Then what is done to it is noted.
bool struck(Watched kind, const char* function) {
    if (kind == Watched::allocations && loading) kind = Watched::loading;
    if (!begun || inside) return false;
    const long count = ++control->counts[static_cast<int>(kind)];
    if (control->finds_paths && (kind == Watched::allocations || kind == Watched::loading)) {
        inside = true;
        find_path(kind, count);
        inside = false;
    }
    if (control->watched != kind || count != control->at) return false;
    inside = true;
    describe(function);
    inside = false;
    control->done = 1;
    return true;
}

const Control* orders() { return control; }

}  // namespace strahl::attack

namespace {

using namespace strahl::attack;

/// The next library's function of this name. Looking it up may allocate.
template <class F>
F* next(const char* name) {
    return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

#ifndef STRAHL_SANITIZED
/// Serves the allocations that are made while the real functions are looked up.
alignas(64) char early[1 << 16];
std::size_t early_used = 0;
bool is_early(const void* p) { return p >= early && p < early + sizeof early; }
void* take_early(std::size_t size) {
    void* const p = early + early_used;
    early_used += (size + 63) / 64 * 64;
    return early_used <= sizeof early ? p : nullptr;
}

struct Allocators {
    void* (*malloc)(std::size_t);
    void* (*calloc)(std::size_t, std::size_t);
    void* (*realloc)(void*, std::size_t);
    void (*free)(void*);
    int (*posix_memalign)(void**, std::size_t, std::size_t);
};

const Allocators* real() {
    static Allocators found;
    static int state = 0;
    if (state == 1) return nullptr;  // called from below
    if (state == 0) {
        state = 1;
        found = {next<void*(std::size_t)>("malloc"), next<void*(std::size_t, std::size_t)>("calloc"),
                 next<void*(void*, std::size_t)>("realloc"), next<void(void*)>("free"),
                 next<int(void**, std::size_t, std::size_t)>("posix_memalign")};
        state = 2;
    }
    return &found;
}

#endif

void* none() { return errno = ENOMEM, nullptr; }
bool no_memory(const char* function) { return struck(Watched::allocations, function); }

/// C++ allocations are counted here and not once more in malloc: with the address sanitizer they do not end there.
template <class... A>
void* allocate(void* (*function)(A...), A... arguments) {
    if (no_memory("operator new")) throw std::bad_alloc();
    const bool outer = inside;
    inside = true;
    try {
        void* const p = function(arguments...);
        inside = outer;
        return p;
    } catch (...) {
        inside = outer;
        throw;
    }
}

using Main = int(int, char**, char**);
Main* real_main = nullptr;

int main_of_strahl(int count, char** words, char** environment) {
    begun = control != nullptr;
    return real_main(count, words, environment);
}

}  // namespace

extern "C" {

#ifndef STRAHL_SANITIZED  // the address sanitizer's own malloc must not be called before it is ready

void* malloc(std::size_t size) {
    if (!real()) return take_early(size);
    return no_memory("malloc") ? none() : real()->malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    if (!real()) return take_early(count * size);  // zeros, as nothing was there before
    return no_memory("calloc") ? none() : real()->calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
    if (is_early(old)) return std::memcpy(malloc(size), old, size);
    return no_memory("realloc") ? none() : real()->realloc(old, size);
}
void free(void* p) {
    if (p && !is_early(p)) real()->free(p);
}
int posix_memalign(void** p, std::size_t unit, std::size_t size) {
    return no_memory("posix_memalign") ? ENOMEM : real()->posix_memalign(p, unit, size);
}
#endif

void* aligned_alloc(std::size_t unit, std::size_t size) {
    static auto* const function = next<void*(std::size_t, std::size_t)>("aligned_alloc");
    return no_memory("aligned_alloc") ? none() : function(unit, size);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* argument) {
    if (struck(Watched::threads, "pthread_create")) return EAGAIN;
    static auto* const create = next<int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
    return create(thread, attributes, work, argument);
}

void* dlopen(const char* path, int flags) {
    static auto* const open = next<void*(const char*, int)>("dlopen");
    const bool outer = loading;
    loading = true;
    void* const handle = open(path, flags);
    loading = outer;
    return handle;
}

/// Runs before main(): attaches to the attacker, but in `strahl` alone and not in programs that it starts.
int __libc_start_main(Main* main, int count, char** words, void (*init)(), void (*fini)(), void (*rtld_fini)(),
                      void* end) {
    using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
    const char* const path = ::getenv(control_variable);
    const char* const slash = std::strrchr(words[0], '/');
    if (path && std::strcmp(slash ? slash + 1 : words[0], "strahl") == 0) {
        const int file = ::open(path, O_RDWR | O_CLOEXEC);
        void* const mapped = ::mmap(nullptr, sizeof(Control), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        if (mapped == MAP_FAILED) std::abort();
        ::close(file);
        control = static_cast<Control*>(mapped);
        control->attached = true;
        void* frame;
        ::backtrace(&frame, 1);  // loads what it needs
        prepare_files();
        real_main = main;
        main = &main_of_strahl;
    }
    return next<Start>("__libc_start_main")(main, count, words, init, fini, rtld_fini, end);
}

}  // extern "C"

using Size = std::size_t;
using Unit = std::align_val_t;

void* operator new(Size size) {
    static auto* const function = next<void*(Size)>("_Znwm");
    return allocate(function, size);
}
void* operator new[](Size size) {
    static auto* const function = next<void*(Size)>("_Znam");
    return allocate(function, size);
}
void* operator new(Size size, Unit unit) {
    static auto* const function = next<void*(Size, Unit)>("_ZnwmSt11align_val_t");
    return allocate(function, size, unit);
}
void* operator new[](Size size, Unit unit) {
    static auto* const function = next<void*(Size, Unit)>("_ZnamSt11align_val_t");
    return allocate(function, size, unit);
}
