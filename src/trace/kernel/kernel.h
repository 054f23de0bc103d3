// The interface between the tracer, compiled once, and its kernels, compiled once per precision and SIMD level: queues
// of rays, batches of pixels, limits, and the function that traces a batch.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>

#include "trace/kernel/ray_counts.h"
#include "trace/world/eye.h"
#include "trace/world/world.h"

namespace strahl {

/// Most pixels in a batch, and most rays in each queue of a generation.
inline constexpr int batch_pixels = 256, batch_rays = 4096;

/// The last generation of rays; rays that go straight on count too, though POV-Ray does not count them.
inline constexpr int deepest_ray = 256;

/// How a ray's place and direction change from a sample to those beside it, right of it and below it: by a side of the
/// square that the sample stands for.
template <class S>
struct Differentials {
    Vec3<S> place[2], direction[2];  // at the ray's start; for hits at its end
    S loose;                         // how much they change in that square, from 0 to 1; below 0 if they are not known
};
/// Calls visit(numbers...) for each number of differentials, of several side by side.
template <class Visit, class... All>
void each_number(const Visit& visit, All&... all) {
    for (int i = 0; i < 2; ++i)
        for (int c = 0; c < 3; ++c) visit(all.place[i][c]...), visit(all.direction[i][c]...);
    visit(all.loose...);
}

/// How wide what a sample sees is at its ray's start or, of hits, its end, and how much wider it gets per distance.
template <class S>
struct RayCone {
    S width, spread;
};

/// A queue of rays, one array per value. Arrays that no ray of the queue needs are null.
template <class T>
struct RayQueue {
    Vec3<T*> origin, direction;
    T* source;  // surface on which the ray starts, -1 for none
    T* pixel;   // its number in the batch; with layers its fraction says how the ray came, see layers.h
    T* weight;  // share of this ray's light that reaches the pixel
    T* medium;  // number of its medium stack; only in nested worlds
    T* t;       // where it leaves its body; only of rays inside an enclosed one
    int count = 0;
    T* extra[4] = {};                   // values that the kernel's policy keeps, see plain.h
    Differentials<T*> differentials{};  // only where patterns are filtered
    RayCone<T*> cone{};                 // only where they are filtered roughly
    // Where rays carry more than weights (FinishTables::carries): the colour of their light beside `weight`, their
    // generation as POV-Ray counts, and 1 if they have been reflected on their way from the eye, else 0.
    T *tint[3] = {}, *level = nullptr, *mirrored = nullptr;
};

/// Says which rays have an array: all; those inside an enclosed body; those of a policy that keeps more; those with
/// differentials or cones; those that carry colours and counts.
enum class RayPart { all, inside, extra, beside, cone, carried };
inline constexpr int ray_arrays = 11;  // number of arrays in the first two parts

/// Calls visit(part, arrays...) for each array of a queue, or of several queues side by side.
template <class Visit, class... Queues>
void each_array(const Visit& visit, Queues&... queues) {
    for (int c = 0; c < 3; ++c) visit(RayPart::all, queues.origin[c]...), visit(RayPart::all, queues.direction[c]...);
    visit(RayPart::all, queues.source...), visit(RayPart::all, queues.pixel...);
    visit(RayPart::all, queues.weight...), visit(RayPart::all, queues.medium...);
    visit(RayPart::inside, queues.t...);
    for (int i = 0; i < 4; ++i) visit(RayPart::extra, queues.extra[i]...);
    each_number([&](auto&... arrays) { visit(RayPart::beside, arrays...); }, queues.differentials...);
    visit(RayPart::cone, queues.cone.width...), visit(RayPart::cone, queues.cone.spread...);
    for (int c = 0; c < 3; ++c) visit(RayPart::carried, queues.tint[c]...);
    visit(RayPart::carried, queues.level...), visit(RayPart::carried, queues.mirrored...);
}

/// The rays of a generation: open ones, whose hits are searched, and those inside an enclosed body (see World), which
/// can only meet that body again. The latter are sorted by the body's bin, [inside_begin, inside_end) each.
template <class T>
struct Generation {
    RayQueue<T> open, inside;
    std::int32_t *inside_begin, *inside_end;
    int rays() const { return open.count + inside.count; }
};

/// The hits of a generation's open rays.
template <class T>
struct HitList {
    T *t, *surface;       // by ray
    T* order;             // numbers of the rays, by the bin of their hit, see of(); misses have the bin World::bins
    std::int32_t* count;  // by bin
    T* of(int bin) const { return order + std::size_t(bin) * capacity; }
    static constexpr std::size_t capacity = batch_rays + 80;  // packs are stored whole; not a power of two, or bins
                                                              // would compete for the same lines of caches
};

/// Numbered stacks of the transparent bodies that rays have entered, as POV-Ray keeps them: each is a shorter stack and
/// one body on top. Stack 0 is empty. Not thread-safe.
class MediumStacks;
int push(MediumStacks& stacks, int stack, int body);    // returns the stack with the body on top
int remove(MediumStacks& stacks, int stack, int body);  // returns the stack without it, wherever it is
bool contains(const MediumStacks& stacks, int stack, int body);
int top(const MediumStacks& stacks, int stack);  // the body entered last, -1 for none
bool all_hollow(const MediumStacks& stacks, int stack, const std::uint8_t* hollow);  // by body

/// The memory of one thread, reused from tile to tile.
template <class T>
class Workspace;
/// Returns generation number `slot`, made at the first call; it keeps its address.
template <class T>
Generation<T>& generation(Workspace<T>& workspace, int slot);
/// Returns the queue that holds refracted rays until they join the reflected ones.
template <class T>
RayQueue<T>& refracted_queue(Workspace<T>& workspace);
template <class T>
HitList<T>& hits(Workspace<T>& workspace);
template <class T>
MediumStacks& mediums(Workspace<T>& workspace);

/// Describes what a sample saw besides its light. Samples of equal signature saw the same surfaces from the same sides,
/// lit by the same lights, directly and by the same reflections and refractions.
template <class T>
struct Sight {
    std::uint32_t signature = 0;
    T glint = 0;                                      // light that highlights of exponent 4 would bring
    T distance = std::numeric_limits<T>::infinity();  // of the camera ray's hit
    std::int32_t surface = -1;                        // surface of that hit
    std::uint32_t lit = 0;                            // bit i: light i reaches that hit, see most_lit
    T reflected[3] = {}, reflection = 0;              // direction and weight of the ray reflected there
    T further = 0;                                    // the longest distance of the rays that leave that hit
    bool uneven = false;                              // a pattern was seen that varies within its pieces
};

/// The last bit of Sight::lit, which stands for all lights from this number on.
inline constexpr int most_lit = 31;

/// Limits to how far rays are followed.
template <class T>
struct Limits {
    int depth = 20;                           // generations, of rays that count
    int generations = 20;                     // generations, uncounted rays included, see FinishTables::carries
    T error = 0;                              // most light that pruned rays may take from a pixel
    const T* brightest = nullptr;             // [n]: with n generations to come, the next one's rays are no brighter
    T noticed = 0;                            // hits of at most this weight do not count in signatures
    T brightest_limit = 0;                    // bound for any number of generations; may be infinite
    int queue = batch_rays;                   // most rays of a generation in a batch of several pixels, see Job
    const std::atomic<bool>* stop = nullptr;  // if it becomes true the picture is no longer wanted
    /// Returns the most light that rays of the generation after this one bring.
    T brightest_beyond(int depth) const { return brightest[generations - depth]; }
    bool stopped() const { return stop && stop->load(std::memory_order_relaxed); }
};

/// The light of a pixel, and an upper bound of what it lacks by pruned rays: four numbers, which are added to at once.
template <class T>
struct PixelSum {
    T rgb[3], pruned;
};

/// Sums up the patterns that a sample sees (note_colors); below 0 if it sees none, or only much enlarged ones.
template <class T>
struct SeenPatterns {
    T color[3] = {-1, -1, -1};  // each by the share of its light that reaches the sample
    T loose = -1;               // how loose the loosest filter is
    T doubt = -1;               // by how much the colours may be off
};

/// The squares of the view around samples, over which patterns are averaged.
template <class T>
struct Footprints {
    Vec3<T> forward, right, down;  // in the plane at distance 1: to its middle, and from one pixel to the next ones
    const T* sides;                // of the samples' squares, in pixels
    SeenPatterns<T>* seen;         // by each sample
    bool made = false;             // the queue of camera rays has their differentials
};

/// Holds a row of numbers for each pixel, the values of its layers (layers.h). A row begins with the share of the
/// background that shows through. If it is longer, the first hit follows: its distance, position and normal in the
/// world, its surface and its material, or infinity and -1. If it is longer still, it ends with colours: light that no
/// light gave to that hit, or the background; what is reflected there, and what comes through; what each light gives.
template <class T>
struct LayerRows {
    static constexpr int clear = 0, distance = 1, position = 2, normal = 5, surface = 8, material = 9;
    static constexpr int own = 10, reflected = 13, refracted = 16, lights = 19;
    T* values;
    int length;  // of a row
    T opacity;   // of the background
    T* lit;      // at a pack of hits: the sum of light before each light is added, 3 packs for each
    int lights_noted = 0;
};

/// The pixels that are traced at once.
template <class T>
struct PixelBatch {
    const T *x, *y;
    PixelSum<T>* sums;
    T* past;  // most light that each pixel lacks by generations past the last
    int count;
    Sight<T>* sights = nullptr;                    // of each pixel, if that is wanted
    const Footprints<T>* footprints = nullptr;     // of each pixel, if that is wanted
    const T *lens_x = nullptr, *lens_y = nullptr;  // places on the lens, see lens_place(); its middle without them
    LayerRows<T>* layers = nullptr;                // of each pixel, if that is wanted

    /// Forgets all that the pixels have brought back.
    void clear() const {
        for (int i = 0; i < count; ++i) {
            sums[i] = {}, past[i] = 0;
            if (sights) sights[i] = {};
            if (footprints) footprints->seen[i] = {};
        }
        if (layers) clear_layers();
    }
    void clear_layers() const {
        using Rows = LayerRows<T>;
        for (T* row = layers->values; row < layers->values + layers->length * count; row += layers->length) {
            std::fill_n(row, layers->length, T(0));
            if (layers->length <= Rows::distance) continue;
            row[Rows::distance] = std::numeric_limits<T>::infinity();
            row[Rows::surface] = row[Rows::material] = -1;
        }
    }
};

/// Traces a batch from the start, whatever its pixels have brought back before. Returns false if some generation has
/// more rays than fit: then the batch must be split. A batch of one pixel always succeeds. Stopped batches are
/// incomplete.
template <class T>
using TraceBatch = bool (*)(const World<T>&, const Eye<T>&, const Limits<T>&, const PixelBatch<T>&, Workspace<T>&,
                            Counts&);

/// Makes the camera rays of a batch (kernel/camera_rays.h).
template <class T>
void make_camera_rays(const CameraRays<T>& cameras, const PixelBatch<T>& batch, Workspace<T>& workspace,
                      RayQueue<T>& rays);

template <class T>
struct Kernel {
    TraceBatch<T> trace = nullptr;
    int lanes = 1;
};

/// Tag of the plain kernel, which traces pictures.
struct ForPictures;

// One inline namespace for each SIMD level; the kernel's own code lives in them, so that nothing merges when linked.
// There are kernels for float and double at each level but `long_double`, which has one lane as `scalar` has.
inline namespace long_double {
template <class T, class Purpose>
Kernel<T> kernel();
}  // namespace long_double
inline namespace scalar {
template <class T, class Purpose>
Kernel<T> kernel();
}  // namespace scalar
inline namespace v2 {
template <class T, class Purpose>
Kernel<T> kernel();
}  // namespace v2
inline namespace v3 {
template <class T, class Purpose>
Kernel<T> kernel();
}  // namespace v3
inline namespace v4 {
template <class T, class Purpose>
Kernel<T> kernel();
}  // namespace v4
inline namespace neon {
template <class T, class Purpose>
Kernel<T> kernel();
}  // namespace neon

}  // namespace strahl
