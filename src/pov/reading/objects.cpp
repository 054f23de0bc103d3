// Reads bodies: their kind, their parts, and what is said about them.
#include <algorithm>

#include "pov/reading/reader.h"
#include "pov/reading/values.h"

namespace strahl::pov {
namespace {

std::optional<ObjectKind> kind_of_parts(std::uint16_t code) {
    switch (code) {
        case word("union"):
            return ObjectKind::unite;
        case word("merge"):
            return ObjectKind::merge;
        case word("intersection"):
            return ObjectKind::intersect;
        case word("difference"):
            return ObjectKind::subtract;
        default:
            return std::nullopt;
    }
}

}  // namespace

/// Gives an object a texture; one that it has becomes the layer below.
void PovReader::add_texture(ObjectThing& object, std::shared_ptr<const TextureThing> more) {
    if (object.uv) more = by_uv(*more);
    if (object.texture) more = layered(*kept_texture(object), *more);
    object.texture = PlacedTexture{std::move(more), {}};
}

/// Returns a copy of an object's own texture, or of the default, in the object's present space.
std::shared_ptr<TextureThing> PovReader::kept_texture(const ObjectThing& object) {
    if (!object.texture) return std::make_shared<TextureThing>(*default_texture);
    return moved(*object.texture->texture, object.texture->steps);
}

/// Joins an object's texture and its interior_texture.
void PovReader::join_textures(ObjectThing& object) {
    if (!object.inner) return;
    // Both textures are in the space of the texture if they were moved alike, else in that of the object.
    const bool alike = object.texture && object.texture->steps == object.inner->steps;
    std::shared_ptr<const TextureThing> inside = moved(*object.inner->texture, alike ? Steps() : object.inner->steps);
    if (object.uv) inside = by_uv(*inside);
    auto both = alike ? std::make_shared<TextureThing>(*object.texture->texture) : kept_texture(object);
    both->inside = both->inside ? layered(*both->inside, *inside) : inside;
    object.texture = PlacedTexture{std::move(both), alike ? object.texture->steps : Steps()}, object.inner.reset();
}

/// Does a texture consist of a colour, a finish and no pattern?
static bool plain(const TextureThing& texture) {
    const auto untouched = [](const Blend& blend) {
        return !blend && !blend.uv && !blend.moved_by_uv && !blend.image && !blend.map && !blend.slopes &&
               !blend.function && !blend.pigment && !blend.values && blend.warps.empty() && blend.steps.empty() &&
               blend.ignored == end_code && !blend.wave && !blend.noise_generator;
    };
    if (texture.layers.size() != 1 || !texture.corners.empty() || texture.inside) return false;
    const LayerValues& own = texture.layers[0];
    return untouched(own.blend) && untouched(own.pigment.blend) && untouched(own.normal.blend) && !own.pigment.colors;
}

/// Do two plain textures look alike, and stand in one place of the text?
static bool alike(const TextureThing& a, const TextureThing& b) {
    const LayerValues &one = a.layers[0], &other = b.layers[0];
    const auto same_place = [](TextPlace p, TextPlace q) { return p.file == q.file && p.at == q.at; };
    const FinishValues &finish = one.finish, &other_finish = other.finish;
    return same_place(one.place, other.place) && same_place(one.finish.place, other.finish.place) &&
           one.pigment.color == other.pigment.color && one.pigment.most == other.pigment.most &&
           one.normal.amount == other.normal.amount && finish == other_finish;
}

/// Gives an object the texture of the one before if both are the same, as in a loop; else counts its memory.
void PovReader::share_texture(Interpreter& in, ObjectThing& object) {
    if (!object.texture || object.texture->texture.use_count() > 1) return;
    auto& own = object.texture->texture;
    const bool simple = plain(*own);
    if (simple && last_texture && alike(*own, *last_texture)) {
        own = last_texture;
        return;
    }
    in.count_bytes(sizeof(TextureThing) + own->layers.size() * sizeof(LayerValues), object.place);
    if (simple) last_texture = own;
}

void PovReader::transform_object(ObjectThing& object, std::span<const Step> steps) {
    append(object.steps, steps);
    if (object.texture) append(object.texture->steps, steps);
    if (object.inner) append(object.inner->steps, steps);
    for (auto& clip : object.clips) {
        auto moved = std::make_shared<ObjectThing>(*clip);
        transform_object(*moved, steps);
        clip = std::move(moved);
    }
}

/// Reads the objects in a block, from '{' to '}'.
std::vector<std::shared_ptr<const ObjectThing>> PovReader::read_object_block(Interpreter& in) {
    in.begin_block();
    std::vector<std::shared_ptr<const ObjectThing>> all;
    for (;;) {
        if (auto known = in.accept_thing<ObjectThing>(ValueKind::object))
            all.push_back(std::move(known));
        else if (auto read = read_object(in))
            all.push_back(std::move(read));
        else if (Steps steps; read_step(in, steps))
            for (auto& own : all) {  // moves all objects so far
                auto moved = std::make_shared<ObjectThing>(*own);
                transform_object(*moved, steps);
                own = std::move(moved);
            }
        else
            break;
    }
    return all;
}

static constexpr std::array object_values{
    value_word<ObjectThing, &ObjectThing::no_shadow>("no_shadow"),
    value_word<ObjectThing, &ObjectThing::no_image>("no_image"),
    value_word<ObjectThing, &ObjectThing::no_reflection>("no_reflection"),
    value_word<ObjectThing, &ObjectThing::hollow>("hollow"),
    value_word<ObjectThing, &ObjectThing::both_sides>("double_illuminate"),
};

/// Reads something about an object that is no transformation; reads nothing and returns false if none comes.
bool PovReader::read_object_modifier(Interpreter& in, ObjectThing& object) {
    if (Steps steps; read_step(in, steps)) return transform_object(object, steps), true;
    if (in.kind() == ValueKind::texture)
        return add_texture(object, in.accept_thing<TextureThing>(ValueKind::texture)), true;
    if (in.at_color()) {  // an old form without effect
        in.read_color(), in.warn("a colour outside of a pigment has no effect: pigment { color ... }");
        return true;
    }
    if (accept_value(in, object_values, object)) return true;
    const std::uint16_t code = in.code();
    const auto change = [&](const auto& read) {
        auto kept = kept_texture(object);
        read(kept->layers.back());
        if (object.uv) set_by_uv(kept->layers.back());
        object.texture = PlacedTexture{std::move(kept), {}};
        return true;
    };
    switch (code) {
        case word("texture"):
            in.take();
            return add_texture(object, read_texture(in)), true;
        case word("pigment"):
            in.take();
            return change([&](LayerValues& layer) {
                layer.place = in.last_place(), layer.blend.word = end_code;
                read_pigment(in, layer.pigment);
            });
        case word("normal"):
            in.take();
            return change([&](LayerValues& layer) { read_normal(in, layer.normal); });
        case word("finish"):
            in.take();
            return change([&](LayerValues& layer) { read_finish(in, layer.finish); });
        case word("material"): {
            in.take();
            const auto material = read_material(in);
            if (material->texture) add_texture(object, material->texture);
            if (material->interior) object.interior = material->interior;
            if (material->interior_texture) object.inner = PlacedTexture{material->interior_texture, {}};
            return true;
        }
        case word("interior"): {
            in.take();
            auto interior = std::make_shared<InteriorThing>(object.interior ? *object.interior : InteriorThing());
            read_interior(in, *interior);
            object.interior = std::move(interior);
            return true;
        }
        case word("interior_texture"):
            in.take();
            object.inner = PlacedTexture{read_texture(in), {}};
            return true;
        case word("inverse"):
            in.take();
            object.inverse = !object.inverse;
            return true;
        case word("no_radiosity"):
        case word("hierarchy"):
        case word("split_union"):
        case word("sturm"):
        case word("cutaway_textures"):
            in.take();
            in.read_flag();
            if (code == word("cutaway_textures"))
                object.approximated("cutaway_textures: cut faces have the default texture");
            return true;
        case word("open"):
            in.take();
            open_ends(object);
            return true;
        case word("uv_mapping"):
            in.take();
            return object.uv = true;
        case word("uv_vectors"):
            in.take();
            for (int i = 0; i < 4 && in.at_expression(); ++i) in.read_components(), in.skip_comma();
            return true;
        case word("photons"):
            in.take();
            in.begin_block();
            while (!in.at('}') && !in.at_end()) {
                object.photon_target |= in.at("target");
                in.take();
            }
            in.end_block();
            return true;
        case word("radiosity"):
            in.take();
            in.skip_block();
            return true;
        case word("bounded_by"):
        case word("clipped_by"): {
            in.take();
            std::vector<std::shared_ptr<const ObjectThing>> bounds = read_object_block(in);
            if (!in.accept("clipped_by") && in.accept("bounded_by")) bounds = object.bounds;
            in.end_block();
            if (code == word("bounded_by")) return object.bounds = std::move(bounds), true;
            for (auto& clip : bounds) object.clips.push_back(std::move(clip));
            return true;
        }
        default:
            return false;
    }
}

/// Reads the parts of a composite.
void PovReader::read_parts(Interpreter& in, ObjectThing& object) {
    for (;;) {
        if (auto known = in.accept_thing<ObjectThing>(ValueKind::object))
            object.parts.push_back(std::move(known));
        else if (auto read = in.at("light_group") ? read_light_group(in) : read_object(in))
            object.parts.push_back(std::move(read));
        else
            return;
    }
}

/// Reads a body or a light that begins with its word; returns null and reads nothing if none comes.
std::shared_ptr<const ObjectThing> PovReader::read_object(Interpreter& in) {
    const std::uint16_t code = in.code();
    if (code == word("light_source")) return read_light(in);
    const auto parts = kind_of_parts(code);
    if (!parts && code != word("object") && !is_shape(code)) return nullptr;
    in.take();
    auto object = std::make_shared<ObjectThing>();
    const TextPlace place = in.last_place();
    if (++bodies > most_bodies) in.fail(place, "the scene has more than " + std::to_string(most_bodies) + " bodies");
    in.count_bytes(2 * sizeof(ObjectThing), place);  // with its shape, and where it is placed
    object->place = place;
    in.begin_block();
    const auto known = in.accept_thing<ObjectThing>(ValueKind::object);
    if (known) {
        *object = *known;
    } else if (parts) {
        object->kind = *parts;
        read_parts(in, *object);
    } else if (code == word("object")) {
        const auto inner = read_object(in);
        if (!inner) in.expected("a body");
        *object = *inner;
    } else {
        read_shape(in, code, *object);
    }
    while (read_object_modifier(in, *object)) {
    }
    in.end_block();
    if (code == word("julia_fractal") && !known) object->inverse = false;  // POV-Ray forgets it here
    for (const auto* const inside : {&object->parts, &object->clips, &object->bounds})
        for (const auto& part : *inside) object->levels = std::max(object->levels, part->levels + 1);
    if (object->levels > most_levels)
        in.fail(place, "bodies are nested more than " + std::to_string(most_levels) + " levels deep");
    join_textures(*object);
    share_texture(in, *object);
    return object;
}

}  // namespace strahl::pov
