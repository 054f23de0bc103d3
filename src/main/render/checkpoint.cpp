#include "main/render/checkpoint.h"

#include <cstdio>
#include <functional>
#include <set>
#include <span>
#include <utility>

#include "files/error.h"
#include "files/os/system.h"
#include "files/read_file.h"
#include "scene/leaves.h"

namespace strahl {
namespace {

/// The largest number of bytes that wait in memory.
constexpr std::size_t most_held = std::size_t(64) << 20;

std::string in_hexadecimal(std::size_t hash) {
    char text[20];
    std::snprintf(text, sizeof text, "%016zx", hash);
    return text;
}

template <class T>
std::size_t hash_of(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

std::string hash_of_program() { return in_hexadecimal(std::hash<std::string_view>()(read_text(os::program_file()))); }

std::string hash_of_meshes(const Scene& scene) {
    std::set<const MeshData*> seen;
    std::size_t hash = 0;
    for (const Primitive& primitive : scene.primitives)
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            const auto* const mesh = std::get_if<Mesh>(&leaf.shape);
            if (!mesh || mesh->file.empty() || !seen.insert(mesh->data.get()).second) return;
            const auto& [points, normals, triangles, corner_normals, places, corner_places] = *mesh->data;
            for (const std::size_t own : {hash_of(points), hash_of(normals), hash_of(triangles),
                                          hash_of(corner_normals), hash_of(places), hash_of(corner_places)})
                hash = 31 * hash + own;
        });
    return in_hexadecimal(hash);
}

void require_same(const BandFile& file, const BandHeader& header) {
    const std::string key = file.header().difference(header);
    if (key.empty()) return;
    const std::string what = key == "program"   ? "by another version of strahl"
                             : key == "scene"   ? "from another scene"
                             : key == "options" ? "with other options"
                             : key == "file"    ? "for another kind or size of file"
                                                : "for another part";
    throw UsageError("'" + file.path() + "' was begun " + what +
                     ", and cannot be continued; remove it, or leave out --resume");
}

std::string checkpoint_of(const std::string& picture) { return picture + ".checkpoint"; }

void remove_checkpoint(const std::string& picture) {
    const std::string path = checkpoint_of(picture);
    if (BandFile::is_at(path)) std::remove(path.c_str());
}

Checkpoint::Checkpoint(PictureWriter& own_writer, std::string path, std::function<BandHeader()> own_header,
                       double seconds)
    : writer(own_writer),
      own_path(std::move(path)),
      header(std::move(own_header)),
      interval(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

void Checkpoint::resume() {
    if (own_path.empty() || !BandFile::is_at(own_path)) return;
    file = std::make_shared<BandFile>(own_path);
    require_same(*file, header());
    file->open_to_append();
    writer.take(file);
}

bool Checkpoint::save() {
    if (own_path.empty()) return false;
    if (!file && writer.held() == 0) return false;
    append();
    return true;
}

void Checkpoint::save_if_due() {
    const std::unique_lock lock(mutex, std::try_to_lock);
    if (lock && writer.held() > 0 && (Clock::now() - last >= interval || writer.held() > most_held)) save();
}

void Checkpoint::become(const std::string& part) {
    append();
    file->rename(part);
}

void Checkpoint::append() {
    if (!file) file = std::make_shared<BandFile>(own_path, header());
    writer.save(file);
    last = Clock::now();
}

}  // namespace strahl
