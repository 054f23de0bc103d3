#include "import/models/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "files/error.h"
#include "files/os/memory_file.h"
#include "import/models/model.h"

namespace strahl {
namespace {

/// Reads a picture that is in memory.
FilePixels decoded(std::string_view bytes, const ReadPixels& read_pixels) {
    return read_pixels(os::MemoryFile(bytes).path());
}

double mean(const FilePixels& pixels, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < pixels.values.size(); i += 3) sum += double(pixels.values[i]);
    return pixels.values.empty() ? 1 : 3 * sum / double(pixels.values.size());
}

Color limited(const Color& color, double most) {
    return {std::clamp(color.x, 0., most), std::clamp(color.y, 0., most), std::clamp(color.z, 0., most)};
}

}  // namespace

Pattern GltfMaterials::PictureUse::pattern(const Color& factor, bool clear) const {
    Pattern own = picture_by_uv(picture.pixels, picture.name, place, factor, clear);
    std::get<ImagePattern>(own.kind).sharp = sharp;
    return own;
}

GltfMaterials::GltfPicture GltfMaterials::picture(const GltfValue& index) {
    if (!index) return {};
    const GltfValue own = file.entry("images", index);
    const auto [known, is_new] = pictures.try_emplace(index.index(file.root()["images"].size()));
    if (!is_new) return known->second;
    try {
        if (!read_pixels) throw FileError("pictures are not read here");
        FilePixels pixels;
        std::string name;
        if (const std::string uri = own["uri"].text(); uri.empty() || GltfFile::is_data(uri)) {
            const std::string data =
                uri.empty() ? std::string(file.view(own["bufferView"])) : GltfFile::decoded_data(uri, own["uri"]);
            try {
                pixels = decoded(data, read_pixels);
            } catch (const FileError& error) {
                const std::string why = error.what();  // names a file that the user does not know
                const std::size_t colon = why.find("': ");
                throw FileError("cannot be read: " + (colon == why.npos ? why : why.substr(colon + 3)));
            }
        } else {
            name = GltfFile::file_name(uri, own["uri"]);
            const std::string path = (std::filesystem::path(file.path).parent_path() / name).string();
            pixels = read_pixels(path);
            files.push_back(path);
        }
        known->second = {std::make_shared<const FilePixels>(std::move(pixels)), name};
    } catch (const FileError& error) {
        warn(own.place() + ": a picture is left out: " + error.what());
    }
    return known->second;
}

GltfMaterials::PictureUse GltfMaterials::use(const GltfValue& texture, GltfMaterial& result) {
    PictureUse use;
    if (!texture) return use;
    const GltfValue own = file.entry("textures", texture["index"]);
    GltfValue source = own["source"];
    if (!source) {
        warn(own.place() + ": a picture is left out: " +
             (own["extensions"]["KHR_texture_basisu"] ? "Basis Universal is not read" : "its format is not read"));
        return use;
    }
    const GltfValue moved = texture["extensions"]["KHR_texture_transform"];
    const int places = static_cast<int>(moved["texCoord"].count(texture["texCoord"].count(0, 100), 100));
    if (result.pictured && places != result.places) {
        warn(texture.place() + ": a picture is left out: it lies by other coordinates than another one");
        return use;
    }
    result.places = places, result.pictured = true;
    use.picture = picture(source);
    if (own["sampler"]) {
        constexpr std::uint64_t nearest = 9728, linear = 9729, clamp = 33071, mirror = 33648, repeat = 10497;
        const GltfValue sampler = file.entry("samplers", own["sampler"]);
        use.sharp = sampler["magFilter"].count(linear, 99999) == nearest;
        for (const auto& [axis, name] : {std::pair(0, "wrapS"), {1, "wrapT"}}) {
            const std::uint64_t code = sampler[name].count(repeat, 99999);
            use.place.wrap[std::size_t(axis)] = code == clamp    ? ImageWrap::clamp
                                                : code == mirror ? ImageWrap::mirror
                                                                 : ImageWrap::repeat;
        }
    }
    // Their v goes down.
    const DVec3 offset = moved["offset"].numbers<2>(DVec3(0)), scale = moved["scale"].numbers<2>(DVec3(1));
    const double angle = moved["rotation"].number(0);
    if (scale.x == 0 || scale.y == 0) moved.fail("scale should not be 0");
    use.place.scale = {scale.x, scale.y, 1}, use.place.degrees = angle * 180 / std::acos(-1.);
    use.place.offset = {offset.x + std::sin(angle) * scale.y, 1 - offset.y - std::cos(angle) * scale.y, 0};
    return use;
}

GltfMaterial GltfMaterials::read(const GltfValue& own) {
    GltfMaterial result;
    Material& material = result.material;
    const GltfValue model = own["pbrMetallicRoughness"], extensions = own["extensions"];
    const auto factors = model["baseColorFactor"].numbers<4>(glm::dvec4(1));
    const Color base = limited(Color(factors), 1);
    material = plain_material(base);

    const PictureUse color = use(model["baseColorTexture"], result);
    const bool colored = bool(color);
    const std::string alpha = own["alphaMode"].text("OPAQUE");
    const bool partly = (alpha == "MASK" || alpha == "BLEND") && color && !color.picture.pixels->opacity.empty();
    if (color) material.rgb = Pigment(color.pattern(base, partly));
    double metal = std::clamp(model["metallicFactor"].number(1), 0., 1.);
    double rough = std::clamp(model["roughnessFactor"].number(1), 0., 1.);
    if (const PictureUse both = use(model["metallicRoughnessTexture"], result)) {
        metal *= mean(*both.picture.pixels, 2), rough *= mean(*both.picture.pixels, 1);
        warn(own.place() + ": metal and roughness are the same everywhere, " + std::to_string(metal).substr(0, 4) +
             " and " + std::to_string(rough).substr(0, 4) + ": the means of their picture");
    }
    // The highlight of a microfacet surface as one by the angle: the exponent is 2 / a^2 - 2, a the squared roughness
    // (B. Walter and others, "Microfacet Models for Refraction through Rough Surfaces", 2007), its strength that of 4 %
    // reflectance, or of the metal.
    const double a = std::max(rough * rough, .02);
    material.pow = std::max(2 / (a * a) - 2, 1.);
    const double strength = std::clamp((material.pow + 2) / 8, 0., 10.);
    material.specular = std::clamp((.04 + .56 * metal) * strength, 0., .9) * (1 - rough);
    material.metallic = metal > .5 ? 1 : 0;
    // Mirrors are sharp here: the rougher a metal is, the more of its light is scattered instead.
    const double mirror = (1 - rough) * (1 - rough);
    material.diffuse = 1 - metal * mirror;
    material.reflection = .9 * metal * mirror, material.gilding = material.reflection > 0 && metal > .5 ? 1 : 0;
    if (metal > .5 && rough > .1 && mirror > .1)
        warn(own.place() + ": a metal of roughness " + std::to_string(rough).substr(0, 4) +
             " mirrors sharply, but less");

    if (const PictureUse normal = use(own["normalTexture"], result)) {
        material.normal.pattern = std::make_shared<const Pattern>(normal.pattern());
        material.normal.height = std::clamp(own["normalTexture"]["scale"].number(1), 0., 1e3);
    }
    const double opacity = std::clamp(factors[3], 0., 1.);
    if (partly) {
        Opacity own_opacity(*color.picture.pixels, false);
        own_opacity.factor = opacity;
        if (alpha == "MASK") own_opacity.limit = std::max(own["alphaCutoff"].number(.5), 1e-9);
        material.rgb = partly_clear(material.rgb, std::move(own_opacity), color.place);
    } else if (alpha == "BLEND") {
        if (!colored)
            material.rgb.transmit = 1 - opacity;
        else
            material.refraction = 1 - opacity, material.diffuse *= opacity, material.ambient *= opacity;
    }
    if (const double clear =
            std::clamp(extensions["KHR_materials_transmission"]["transmissionFactor"].number(0), 0., 1.) * (1 - metal);
        clear > 0) {
        const GltfValue volume = extensions["KHR_materials_volume"];
        const bool thick = volume["thicknessFactor"].number(0) > 0;
        material.refraction = clear, material.diffuse *= 1 - clear, material.ambient *= 1 - clear;
        // Thin walls do not bend light.
        const double ior = std::clamp(extensions["KHR_materials_ior"]["ior"].number(1.5), 1., 10.);
        material.ior = thick ? ior : 1;
        if (thick) reflect_as_glass(material);
        if (const double distance = volume["attenuationDistance"].number(0); thick && distance > 0) {
            // c^(way / distance) = exp(-(1 - f) way / d) with d = k distance and f = 1 + k ln c.
            const Color c = volume["attenuationColor"].numbers<3>(Color(1));
            Color log;
            for (int i = 0; i < 3; ++i) log[i] = std::log(std::clamp(c[i], 1e-6, 1.));
            const double most = std::max({-log.x, -log.y, -log.z}), k = most > 1 ? 1 / most : 1;
            material.fade_distance = k * distance, material.fade_power = 1000;
            for (int i = 0; i < 3; ++i) material.fade_color[i] = std::clamp(1 + k * log[i], 0., 1.);
        }
    }
    if (extensions["KHR_materials_unlit"])
        material.ambient = 1, material.diffuse = material.specular = material.reflection = 0;
    const double glow = extensions["KHR_materials_emissive_strength"]["emissiveStrength"].number(1);
    const Color emission = limited(glow * own["emissiveFactor"].numbers<3>(Color(0)), 1e6);
    const PictureUse glowing = use(own["emissiveTexture"], result);
    if (emission != Color(0)) {
        // A coat that is hardly there adds the light: layers with a share do not hide what is below them.
        Material coat;
        coat.reflection = coat.specular = coat.diffuse = 0, coat.ambient = 1;
        coat.rgb = glowing ? Pigment(glowing.pattern(emission)) : Pigment(emission);
        coat.share = Pigment(Color(1 - 1e-12));
        material.coats.push_back(std::move(coat));
    }
    return result;
}

}  // namespace strahl
