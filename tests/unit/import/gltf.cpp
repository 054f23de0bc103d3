// glTF: numbers in buffers, materials, nodes, cameras, lights and motion, and files that are wrong.
#include <cmath>

#include "num/vec_math.h"
#include "tests/unit/import/gltf_text.h"
#include "tests/unit/import/models.h"

using namespace strahl;
using namespace strahl::importing;

namespace {

Model model_of(const std::string& text) { return Models().put("a.gltf", text).read("a.gltf"); }
std::string gltf_fault(const std::string& text) { return Models().put("a.gltf", text).fault("a.gltf"); }
std::string with(std::string text, const std::string& old, const std::string& newer) {
    const std::size_t at = text.find(old);
    REQUIRE(at != text.npos);
    return text.replace(at, old.size(), newer);
}
Material gltf_material(const std::string& values, const std::string& more = "") {
    Models models;
    models.put("p.png", "").put("clear.png", "");
    models.put("a.gltf", triangle(R"({"mesh": 0})", R"("materials": [{)" + values + "}]" + more,
                                  R"("attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0)"));
    return models.read("a.gltf").materials.at(0);
}
const std::string pictures = R"(, "textures": [{"source": 0}, {"source": 1}],
"images": [{"uri": "p%2Epng"}, {"uri": "clear.png"}])";

}  // namespace

TEST_CASE("glTF: a triangle, as text, with a file beside, and as one file") {
    Models models;
    const std::string beside = with(triangle(), uri_of(data), "the%20data.bin"),
                      inside = with(triangle(), R"(, "uri": ")" + uri_of(data) + "\"", "");
    models.put("a.gltf", triangle())
        .put("b.gltf", beside)
        .put("the data.bin", data + "more")
        .put("c.glb", glb(inside, data));
    for (const char* name : {"a.gltf", "b.gltf", "c.glb"}) {
        CAPTURE(name);
        const Model model = models.read(name);
        REQUIRE(model.parts.size() == 1);
        CHECK(model.parts[0].name == "tri");
        const MeshData& mesh = *model.parts[0].mesh;
        CHECK(mesh.points == std::vector<DVec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(mesh.triangles == std::vector<MeshData::Corners>{{2, 1, 0}});
        CHECK(model.warnings.empty());
    }
    CHECK(models.read("b.gltf").files ==
          std::vector<std::string>{models.folder / "b.gltf", models.folder / "the data.bin"});
}

TEST_CASE("glTF: strips, fans, and sparse accessors") {
    const auto triangles = [](int mode) {
        std::string text =
            triangle(R"({"mesh": 0})", "",
                     R"("mode": )" + std::to_string(mode) + R"(, "attributes": {"POSITION": 0}, "indices": 3)");
        text = with(text, "\"type\": \"SCALAR\"}]",
                    R"("type": "SCALAR"}, {"componentType": 5121, "count": 4, "type": "SCALAR", "sparse": {"count": 3,
 "indices": {"bufferView": 0, "byteOffset": 52, "componentType": 5121},
 "values": {"bufferView": 0, "byteOffset": 55}}}])");
        text = with(text, "\"byteLength\": 44", "\"byteLength\": 58"),
        text = with(text, "\"byteLength\": 52", "\"byteLength\": 58");
        text = with(text, uri_of(data), uri_of(data + bytes_of<std::uint8_t>({1, 2, 3, 1, 2, 0})));
        return model_of(text).parts[0].mesh->triangles;
    };
    // The corners are 0, 1, 2, 0: the second triangle of both has all three points.
    CHECK(triangles(5) == std::vector<MeshData::Corners>{{0, 1, 2}, {2, 1, 0}});
    CHECK(triangles(6) == std::vector<MeshData::Corners>{{0, 1, 2}});
}

TEST_CASE("glTF: materials") {
    const Material dull =
        gltf_material(R"("pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1], "metallicFactor": 0})");
    CHECK(dull.rgb == Pigment(1, .5, 0));
    CHECK(dull.reflection == 0);
    CHECK(dull.diffuse == 1);
    const Material gold =
        gltf_material(R"("pbrMetallicRoughness": {"baseColorFactor": [1, 0.8, 0.3, 1], "roughnessFactor": 0})");
    CHECK(gold.reflection == doctest::Approx(.9));
    CHECK(gold.gilding == 1);
    CHECK(gold.diffuse == 0);
    const Material rough = gltf_material(R"("pbrMetallicRoughness": {"roughnessFactor": 1})");
    CHECK(rough.reflection == 0);
    CHECK(rough.diffuse == 1);
    const Material glass = gltf_material(
        R"("pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_transmission":
 {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.4}, "KHR_materials_volume": {"thicknessFactor": 1,
 "attenuationDistance": 2, "attenuationColor": [0.5, 1, 1]}})");
    CHECK(glass.refraction == 1);
    CHECK(glass.ior == 1.4);
    CHECK(glass.fresnel == 1);
    // After a way of 2 half of the red is left.
    CHECK(std::exp((glass.fade_color.x - 1) * 2 / glass.fade_distance) == doctest::Approx(.5));
    CHECK(glass.fade_color.y == 1);
    const Material lamp = gltf_material(
        R"("emissiveFactor": [1, 1, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}})");
    REQUIRE(lamp.coats.size() == 1);
    CHECK(lamp.coats[0].rgb == Pigment(2, 2, 0));
    CHECK(lamp.coats[0].shares());
    CHECK(gltf_material(R"("extensions": {"KHR_materials_unlit": {}})").diffuse == 0);
    const Material film =
        gltf_material(R"("alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]})");
    CHECK(film.rgb.transmit == .75);
    CHECK(gltf_material(R"("pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]})").rgb.transmit == 0);
}

TEST_CASE("glTF: pictures, their places, and masks") {
    const Material own = gltf_material(
        R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
 {"offset": [0.25, 0.5], "rotation": 1.5707963267948966, "scale": [2, 3]}}}})",
        pictures);
    const Pattern& pattern = *own.rgb.pattern;
    CHECK(std::get<ImagePattern>(pattern.kind).file == "p.png");
    // By the extension's matrices (0, 0) is at the offset, and (1, 0) at the offset + (0, -2). Their v goes down.
    const auto place = [&](double u, double v) {
        return DVec3(glm::inverse(matrix(pattern.transformations)) * glm::dvec4(u, 1 - v, 0, 1));
    };
    CHECK(length(place(0, 0) - DVec3(.25, .5, 0)) < 1e-12);
    CHECK(length(place(1, 0) - DVec3(.25, 1 - (.5 - 2), 0)) < 1e-12);
    const Material mask = gltf_material(
        R"("alphaMode": "MASK", "alphaCutoff": 0.4, "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}})",
        pictures);
    const auto& values = *std::get<SolidPattern>(mask.rgb.pattern->kind).function;
    CHECK(values.value_at({.49, .5, 0}) == 1);
    CHECK(values.value_at({.51, .5, 0}) == 1);  // half and a little less opaque: above .4
    CHECK(values.value_at({.57, .5, 0}) == 0);
    const Material opaque = gltf_material(R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 1}})", pictures);
    CHECK(!opaque.rgb.clear());
    CHECK(gltf_material(R"("normalTexture": {"index": 0, "scale": 0.5})", pictures).normal.height == .5);
}

TEST_CASE("glTF: what is beyond the edges of pictures") {
    const auto textured = [](int index) {
        return gltf_material(
            R"("pbrMetallicRoughness": {"baseColorTexture": {"index": )" + std::to_string(index) + "}}",
            R"(, "textures": [{"source": 0}, {"source": 0, "sampler": 0}, {"source": 1, "sampler": 1}],
 "images": [{"uri": "p.png"}, {"uri": "clear.png"}],
 "samplers": [{"wrapS": 33071, "wrapT": 33648}, {"wrapS": 10497, "wrapT": 33071}])");
    };
    const auto wrap = [&](int index) { return std::get<ImagePattern>(textured(index).rgb.pattern->kind).wrap; };
    using enum ImageWrap;
    CHECK(wrap(0) == std::array{repeat, repeat});
    CHECK(wrap(1) == std::array{clamp, mirror});
    CHECK(wrap(2) == std::array{repeat, clamp});
}

TEST_CASE("glTF: nodes in nodes") {
    const Model model = model_of(triangle(
        R"({"name": "outer", "children": [1, 2], "translation": [1, 2, 3]},
 {"name": "turned", "mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 2, 2]},
 {"mesh": 0, "matrix": [0, 3, 0, 0, -1, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1]})"));
    REQUIRE(model.parts.size() == 2);
    CHECK(model.parts[0].name == "turned");
    CHECK(model.parts[1].name == "tri");
    const auto at = [&](std::size_t part, const DVec3& p) {
        return transform_point(matrix(model.parts[part].transformations), p);
    };
    CHECK(length(at(0, {1, 0, 0}) - DVec3(1, 4, 3)) < 1e-12);
    CHECK(length(at(1, {1, 0, 0}) - DVec3(6, 11, 10)) < 1e-12);
    CHECK(length(at(1, {0, 1, 1}) - DVec3(5, 8, 12)) < 1e-12);
    CHECK(model.parts[0].mesh == model.parts[1].mesh);
    const Model mirrored =
        model_of(triangle(R"({"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})"));
    CHECK(length(transform_point(matrix(mirrored.parts[0].transformations), {1, 2, 3}) - DVec3(-1, 2, 3)) < 1e-12);
}

TEST_CASE("glTF: cameras and lights take the place of the stage's") {
    const Model model = model_of(triangle(
        R"({"mesh": 0}, {"camera": 0, "translation": [0, 0, 9]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}},
 {"translation": [0.5, 0.5, 4], "extensions": {"KHR_lights_punctual": {"light": 1}}})",
        R"("cameras": [{"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 2, "znear": 1}}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 10, "color": [1, 0, 0]},
 {"type": "point", "intensity": 160}]}})"));
    REQUIRE(model.camera);
    CHECK(model.camera->position == DVec3(0, 0, 9));
    CHECK(length(normalize(model.camera->look_at - model.camera->position) - DVec3(0, 0, -1)) < 1e-12);
    CHECK(std::tan(model.camera->fov * std::acos(-1.) / 180) == doctest::Approx(2 * std::tan(.5)));
    REQUIRE(model.lights.size() == 2);
    CHECK(length(*model.lights[0].direction - DVec3(0, 0, -1)) < 1e-12);
    // 160 / 4^2 at the model is as much as 10: both are made 1.
    CHECK(model.lights[0].color.x == doctest::Approx(1).epsilon(1e-3));
    const Light& point = model.lights[1];
    CHECK(point.color.x * 2 / (1 + 16 / (point.fade_distance * point.fade_distance)) ==
          doctest::Approx(1).epsilon(1e-3));
    const Scene scene = staged(model, 1);
    CHECK(scene.camera == *model.camera);
    CHECK(scene.lights == model.lights);
    CHECK(scene.primitives.size() == 1);
}

TEST_CASE("glTF: nodes that move") {
    std::string text =
        triangle(R"({"mesh": 0})", R"("animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path":
 "translation"}}], "samplers": [{"input": 3, "output": 0}]}])");
    text = with(text, "\"type\": \"SCALAR\"}]", R"("type": "SCALAR"}, {"bufferView": 1, "byteOffset": 8,
 "componentType": 5126, "count": 3, "type": "SCALAR"}])");
    text = with(text, "\"byteLength\": 8", "\"byteLength\": 20"),
    text = with(text, "\"byteLength\": 52", "\"byteLength\": 64");
    const auto model_with = [&](std::initializer_list<float> times) {
        return model_of(with(text, uri_of(data), uri_of(data + bytes_of<float>(times))));
    };
    const Model model = model_with({0, 1, 2});
    CHECK(model.seconds == 2);
    const auto place = [](const Model& of, double time) {
        for (const MotionKey& key : std::get<Motion>(of.parts[0].transformations.at(0)).keys)
            if (std::abs(key.time - time) < 1e-9) return key.translate;
        return DVec3(1e9);
    };
    const auto at_time = [&](double time) { return place(model, time); };
    CHECK(at_time(0) == DVec3(0));
    CHECK(at_time(1) == DVec3(1, 0, 0));
    CHECK(at_time(2) == DVec3(0, 1, 0));
    CHECK(length(at_time(.5) - DVec3(.5, 0, 0)) < 1e-9);
    CHECK(staged(model, 1).flythrough->duration == 2);
    // What is before 0 is not seen.
    const Model early = model_with({-1, 1, 2});
    CHECK(early.seconds == 2);
    CHECK(place(early, 0) == DVec3(.5, 0, 0));
    CHECK(std::get<Motion>(early.parts[0].transformations.at(0)).keys[0].time == 0);
}

TEST_CASE("glTF: skins and morph targets as they rest") {
    std::string text =
        triangle(R"({"mesh": 0, "skin": 0, "translation": [9, 9, 9], "weights": [0.5]}, {"translation": [0, 0, 5]})",
                 R"("skins": [{"joints": [1]}])",
                 R"("attributes": {"POSITION": 0, "JOINTS_0": 3, "WEIGHTS_0": 4}, "targets": [{"POSITION": 0}])");
    text = with(text, "\"type\": \"SCALAR\"}]", R"("type": "SCALAR"},
 {"componentType": 5121, "count": 3, "type": "VEC4"}, {"bufferView": 1, "byteOffset": 8, "componentType": 5121,
 "normalized": true, "count": 3, "type": "VEC4"}])");
    text = with(text, "\"byteLength\": 8", "\"byteLength\": 20"),
    text = with(text, "\"byteLength\": 52", "\"byteLength\": 64");
    text = with(text, uri_of(data), uri_of(data + bytes_of<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0})));
    const Model model = model_of(text);
    // 1.5 times the points, where the joint is; where the node is does not matter.
    CHECK(model.parts[0].mesh->points == std::vector<DVec3>{{0, 0, 5}, {1.5, 0, 5}, {0, 1.5, 5}});
    CHECK(model.parts[0].transformations.empty());
}

TEST_CASE("glTF: skins and morph targets move with the animation") {
    // The joint goes from z 5 to 7 and the weight from 0 to 1 within two seconds; the node of the mesh is elsewhere.
    std::string text =
        triangle(R"({"mesh": 0, "skin": 0, "translation": [9, 9, 9]}, {"translation": [0, 0, 5]})",
                 R"("skins": [{"joints": [1]}], "animations": [{"channels": [
 {"sampler": 0, "target": {"node": 1, "path": "translation"}},
 {"sampler": 1, "target": {"node": 0, "path": "weights"}}],
 "samplers": [{"input": 5, "output": 6}, {"input": 5, "output": 7}]}])",
                 R"("attributes": {"POSITION": 0, "JOINTS_0": 3, "WEIGHTS_0": 4}, "targets": [{"POSITION": 0}])");
    text = with(text, "\"type\": \"SCALAR\"}]", R"("type": "SCALAR"},
 {"componentType": 5121, "count": 3, "type": "VEC4"}, {"bufferView": 1, "byteOffset": 8, "componentType": 5121,
 "normalized": true, "count": 3, "type": "VEC4"},
 {"bufferView": 1, "byteOffset": 20, "componentType": 5126, "count": 2, "type": "SCALAR"},
 {"bufferView": 1, "byteOffset": 28, "componentType": 5126, "count": 2, "type": "VEC3"},
 {"bufferView": 1, "byteOffset": 52, "componentType": 5126, "count": 2, "type": "SCALAR"}])");
    text = with(text, "\"byteLength\": 8", "\"byteLength\": 60"),
    text = with(text, "\"byteLength\": 52", "\"byteLength\": 104");
    const std::string more = bytes_of<std::uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}) +
                             bytes_of<float>({0, 2, 0, 0, 5, 0, 0, 7, 0, 1});
    text = with(text, uri_of(data), uri_of(data + more));
    Models models;
    models.put("a.gltf", text);
    for (const double time : {0., 1., 2., 9.}) {
        CAPTURE(time);
        const Model model = models.read("a.gltf", time);
        const double share = std::min(time / 2, 1.), large = 1 + share, z = 5 + 2 * share;
        CHECK(model.changes);
        CHECK(model.seconds == 2);
        CHECK(model.warnings.empty());
        CHECK(model.parts[0].mesh->points == std::vector<DVec3>{{0, 0, z}, {large, 0, z}, {0, large, z}});
        // The stage is that of the beginning.
        CHECK(model.parts[0].at_first()->points == std::vector<DVec3>{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}});
        CHECK(staged(model, 1).camera == staged(models.read("a.gltf"), 1).camera);
    }
    CHECK(!model_of(triangle()).changes);
}

TEST_CASE("glTF: what is wrong is told with its place") {
    const std::string good = triangle();
    CHECK(gltf_fault("{\n\"asset\": }").starts_with("a.gltf:2: syntax error"));
    CHECK(gltf_fault("{}") == "a.gltf: this is no glTF 2: asset.version is ''");
    CHECK(gltf_fault(with(good, "\"2.0\"", "\"1.0\"")) == "a.gltf: this is no glTF 2: asset.version is '1.0'");
    CHECK(gltf_fault(with(good, "\"count\": 3", "\"count\": 4")) ==
          "a.gltf: accessors[0]: 4 elements reach beyond their view of 44 bytes");
    CHECK(gltf_fault(with(good, "\"count\": 3", "\"count\": -3")) ==
          "a.gltf: accessors[0].count: should be a whole number from 0 to 60000000");
    CHECK(gltf_fault(with(good, "5126", "5127")) == "a.gltf: accessors[0].componentType: is not a type of numbers");
    CHECK(gltf_fault(with(good, "VEC3", "VEC2")) ==
          "a.gltf: accessors[0]: has elements of 2 numbers; here are needed 3");
    CHECK(gltf_fault(with(good, "\"byteLength\": 44", "\"byteLength\": 53")) ==
          "a.gltf: bufferViews[0]: reaches beyond its buffer of 52 bytes");
    CHECK(gltf_fault(with(good, "\"byteLength\": 52", "\"byteLength\": 99")) ==
          "a.gltf: buffers[0]: should have 99 bytes and has 52");
    CHECK(gltf_fault(with(good, "base64,", "base64,!")).starts_with("a.gltf: buffers[0].uri: its data are not base64"));
    CHECK(gltf_fault(with(good, "\"mesh\": 0", "\"mesh\": 7")) == "a.gltf: nodes[0].mesh: is 7, but there are only 1");
    CHECK(gltf_fault(with(good, "\"mesh\": 0", "\"mesh\": {}")) == "a.gltf: nodes[0].mesh: should be a number");
    CHECK(gltf_fault(triangle(R"({"children": [1]}, {"children": [0]})", R"("scenes": [{"nodes": [0]}])")) ==
          "a.gltf: nodes[0]: is in two places of the tree of nodes, or in itself");
    CHECK(gltf_fault(triangle(R"({"translation": [1, 2, 3]})")) == "a.gltf: there are no triangles in this model");
    CHECK(gltf_fault(triangle(R"({"mesh": 0})", R"("extensionsRequired": ["KHR_draco_mesh_compression"])")) ==
          "a.gltf: extensionsRequired[0]: Draco compression is not read; save it without");
    for (const char* name : {"EXT_meshopt_compression", "KHR_texture_basisu", "A_new_one"})
        CHECK(gltf_fault(triangle(R"({"mesh": 0})", std::string(R"("extensionsRequired": [")") + name + "\"]"))
                  .starts_with("a.gltf: extensionsRequired[0]: "));
    CHECK(gltf_fault(with(good, uri_of(data), "none.bin")) == "cannot read 'none.bin': there is no such file");
    CHECK(gltf_fault(with(good, uri_of(data), "http://a.b/c")) ==
          "a.gltf: buffers[0].uri: only files are read, no addresses");
    Models models;
    const std::string whole = glb(good, data);
    CHECK(models.put("a.glb", whole.substr(0, 100)).fault("a.glb").ends_with("it was cut off, so get a new copy"));
    CHECK(models.put("a.glb", glb(good, data, 1)).fault("a.glb") == "a.glb: this is version 1 of glTF; only 2 is read");
    CHECK(models.put("a.glb", "glTF").fault("a.glb") ==
          "a.glb: the file ends in the head of a part; it was cut off, so get a new copy");
}
