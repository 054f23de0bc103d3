// Tells whether this is the sanitize build, where tests try less because everything takes ten times as long. Known only
// when the program is linked, since the tests' own code is the release's.
#pragma once

extern "C" {
[[gnu::weak]] void __asan_init();
[[gnu::weak]] void __tsan_init();
}

namespace strahl {

inline bool sanitized() { return &__asan_init || &__tsan_init; }

}  // namespace strahl
