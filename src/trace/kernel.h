// What the plain part of the tracer and the kernels, compiled once per instruction set, know of each other.
#pragma once
#include <cstdint>

#include "trace/world.h"

namespace strahl {

/// Most pixels in a batch, and most rays in each queue of a generation.
inline constexpr int batch_pixels = 256, batch_rays = 4096;

/// A queue of rays, one array per value.
template <class T>
struct RayQueue {
    Vec3<T*> origin, direction;
    T* source;  // surface on which the ray starts, -1 for none
    T* pixel;   // of the tile
    T* weight;  // share of this ray's light that reaches the pixel
    T* medium;  // list of bodies entered; only in nested worlds
    T* t;       // where the ray meets its body again; only of rays inside
    int count = 0;
};
inline constexpr int ray_arrays = 11;

/// The rays of a generation: those that look for what they meet, and those inside an enclosed body (see World), which
/// meet nothing else: stretches by the body's key.
template <class T>
struct Generation {
    RayQueue<T> open, inside;
    std::int32_t *inside_begin, *inside_end;
    int rays() const { return open.count + inside.count; }
};

/// What a generation met.
template <class T>
struct HitList {
    T *t, *surface;  // by ray
    T* order;        // numbers of rays by the key of what they hit, see of(); of those that hit nothing World::keys
    std::int32_t* count;  // by key: how many
    T* of(int key) const { return order + std::size_t(key) * capacity; }
    static constexpr std::size_t capacity = batch_rays + 80;  // packs are stored whole; no power of two, or caches
                                                              // would fill one place only
};

/// Lists of transparent bodies entered, as POV-Ray keeps them: numbered, each a shorter list and one body more.
/// List 0 is empty. Not for two threads at once.
class MediumStacks;
int push(MediumStacks& lists, int list, int body);    // the list with the body appended
int remove(MediumStacks& lists, int list, int body);  // ... with it removed, wherever it is
bool contains(const MediumStacks& lists, int list, int body);
int top(const MediumStacks& lists, int list);  // the body entered last, -1 for none

/// Memory of one thread, reused from tile to tile.
template <class T>
class Workspace;
/// Generation number `slot`, made when first asked for; it keeps its address.
template <class T>
Generation<T>& generation(Workspace<T>& workspace, int slot);
/// A queue for refracted rays until they join the mirrored ones.
template <class T>
RayQueue<T>& refracted_queue(Workspace<T>& workspace);
template <class T>
HitList<T>& hits(Workspace<T>& workspace);
template <class T>
MediumStacks& mediums(Workspace<T>& workspace);

/// Where camera rays come from: pixel (x, y) looks along forward + u * right + v * down, with u, v in [-1, 1].
template <class T>
struct Eye {
    Vec3<T> position, forward, right, down;  // right and down scaled by the picture's half sizes at distance 1
    T scale_x, scale_y, bias_x, bias_y;      // u = x * scale_x + bias_x
    T medium = 0;                            // list of bodies that the eye is in
    int depth = 20;
    T error = 0;                   // light that a pixel may lack
    const T* brightest = nullptr;  // [n]: with n generations to come, the next one's rays are no brighter
    T brightest_limit = 0;         // nor with any number of generations; infinite if there is no bound
};

/// Pixels to trace, and where their light is summed: rgb[4 * i + c] for pixel i. In rgb[4 * i + 3] is what it lacks at
/// most by rays left out as too weak, in past[i] by generations past the last.
template <class T>
struct PixelBatch {
    const T *x, *y;
    T *rgb, *past;
    int count;
};

struct KernelCounts {
    std::uint64_t camera = 0, reflected = 0, refracted = 0, shadow = 0;
    int depth = 0;                 // of the deepest generation that had rays
    double dropped = 0, past = 0;  // most that any pixel lacks, see PixelBatch
};

/// Traces a batch. False if some generation has more rays than that: the batch must be split, its sums thrown
/// away. A batch of one pixel always succeeds.
template <class T>
using TraceBatch = bool (*)(const World<T>&, const Eye<T>&, const PixelBatch<T>&, Workspace<T>&, KernelCounts&);

template <class T>
struct Kernel {
    TraceBatch<T> trace = nullptr;
    int lanes = 1;
};

// One inline namespace for each instruction set; the kernel's own code lives in them, so that nothing merges when
// linked.
inline namespace scalar {
Kernel<float> kernel_float();
Kernel<double> kernel_double();
Kernel<long double> kernel_extended();
}  // namespace scalar
inline namespace v2 {
Kernel<float> kernel_float();
Kernel<double> kernel_double();
}  // namespace v2
inline namespace v3 {
Kernel<float> kernel_float();
Kernel<double> kernel_double();
}  // namespace v3
inline namespace v4 {
Kernel<float> kernel_float();
Kernel<double> kernel_double();
}  // namespace v4
inline namespace neon {
Kernel<float> kernel_float();
Kernel<double> kernel_double();
}  // namespace neon

}  // namespace strahl
