#include "text/body_text.h"

#include <algorithm>
#include <utility>

#include "files/words.h"
#include "num/decimal.h"
#include "scene/leaves.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

/// A body or a part of one on the way from the top level to a leaf, and the name of the definition that it stands in.
struct Level {
    const TextItem* item;
    std::string_view define;
};

/// Collects the values of a leaf.
class ValueFinder {
  public:
    ValueFinder(const std::string& text, const BodyItems& found) : text(text), found(found) {}

    /// Finds the blocks that lead to the leaf. False if there is no such leaf.
    bool find(int leaf) { return !found.body.word.empty() && find(found.body, {}, leaf); }
    const std::vector<Level>& levels() const { return chain; }
    std::size_t at(std::string_view slice) const { return std::size_t(slice.data() - text.data()); }
    int line(std::string_view slice) const { return static_cast<int>(line_number(text, at(slice))); }

    void add_shape(const Shape& shape, std::vector<BodyValue>& values) const;
    void add_transformations(std::vector<BodyValue>& values) const;
    void add_material(std::vector<BodyValue>& values) const;
    std::optional<TextSlice> material_place() const;

  private:
    /// A block that may give a value, and how it is called; "" for the body's own.
    struct ValueSource {
        const TextItem* block;
        std::string name;
    };

    const TextItem* definition(std::string_view name) const {
        const auto named = found.definitions.find(name);
        return named == found.definitions.end() ? nullptr : &named->second;
    }
    /// The block of a kind of body that an item is or stands for, and the definition that this is in.
    Level resolved(Level level) const {
        while (const TextItem* const named = definition(level.item->word)) level = {&named->items[0], named->name};
        return level;
    }
    std::string label(std::string_view word, std::string_view slice) const {
        return std::string(word) + ", line " + std::to_string(line(slice));
    }
    std::string label_of_definition(std::string_view name) const {
        return name.empty() ? "" : label("define " + std::string(name), definition(name)->word);
    }
    bool find(const TextItem& item, std::string_view define, int& left);
    void add_body(std::vector<ValueSource>& sources, Level level, const std::string& name) const;
    void add_material(std::vector<ValueSource>& sources, const TextItem& item, const std::string& name) const;
    BodyValue value_of(const TextItem& item, const char* name, const char* help, NumberRange range) const;
    void set_own_place(BodyValue& value) const;

    const std::string& text;
    const BodyItems& found;
    std::vector<Level> chain;
};

bool ValueFinder::find(const TextItem& item, std::string_view define, int& left) {
    chain.push_back({&item, define});
    const auto [own, inside] = resolved(chain.back());
    if (own->word != Union::name && own->word != Intersection::name && own->word != Difference::name) {
        if (left-- == 0) return true;
    } else {
        for (const TextItem& part : own->items)
            if ((is_body_word(part.word) || definition(part.word)) && find(part, inside, left)) return true;
    }
    chain.pop_back();
    return false;
}

/// Reads numbers as far as they are written.
std::vector<double> numbers_of(std::span<const std::string_view> slices) {
    std::vector<double> numbers;
    for (const std::string_view slice : slices) {
        double number = 0;
        read_number(slice, number);
        numbers.push_back(number);
    }
    return numbers;
}

BodyValue ValueFinder::value_of(const TextItem& item, const char* name, const char* help, NumberRange range) const {
    BodyValue value{.name = name, .help = help, .range = range, .numbers = numbers_of(item.numbers)};
    for (const std::string_view slice : item.numbers) value.slices.push_back(slice_of(text, slice));
    take_tracks(value, text, item);
    return value;
}

void ValueFinder::add_shape(const Shape& shape, std::vector<BodyValue>& values) const {
    const auto [item, define] = resolved(chain.back());
    std::size_t next = 0;
    const auto add = [&, item = item, define = define]<class Kind>(const Kind& own, const auto& field) {
        constexpr std::size_t count = std::is_same_v<std::remove_cvref_t<decltype(own.*field.member)>, DVec3> ? 3 : 1;
        if (next + count > item->numbers.size()) return;
        TextItem part;
        part.numbers.assign(item->numbers.begin() + std::ptrdiff_t(next),
                            item->numbers.begin() + std::ptrdiff_t(next + count));
        next += count;
        values.push_back(value_of(part, field.name, field.help, argument_range(field.range)));
        values.back().source = label_of_definition(define);
    };
    std::visit(
        [&]<class Kind>(const Kind& own) {
            std::apply([&](const auto&... field) { (add(own, field), ...); }, Kind::fields);
        },
        shape);
}

void ValueFinder::add_transformations(std::vector<BodyValue>& values) const {
    bool moved = false;
    for (std::size_t i = chain.size(); i-- > 0;) {
        Level level = chain[i];
        std::vector<Level> blocks{level};  // nested blocks around the numbers, the body's own last
        while (const TextItem* const named = definition(level.item->word))
            blocks.insert(blocks.begin(), level = {&named->items[0], named->name});
        for (const auto& [item, define] : blocks)
            for (const TextItem& step : item->items) {
                if (!contains(transformation_words, step.word)) continue;
                const bool moves = step.word == "translate";
                const std::string name(step.word);
                values.push_back(value_of(step, name.c_str(),
                                          moves                   ? "by how much the body moves"
                                          : step.word == "rotate" ? "degrees about x, then y, then z"
                                                                  : "factors along x, y and z",
                                          moves ? coordinates : anything));
                if (i + 1 < chain.size() && define.empty()) values.back().name += " of " + std::string(item->word);
                values.back().source = label_of_definition(define), values.back().follows = true;
                moved |= moves && i == 0 && item == chain[0].item;
            }
    }
    if (moved) return;
    const std::size_t end = at(chain[0].item->end);
    values.push_back({.name = "translate",
                      .help = "by how much the body moves",
                      .range = coordinates,
                      .numbers = {0, 0, 0},
                      .follows = true,
                      .source = std::string(no_source),
                      .own_at = end,
                      .before = " translate ",
                      .after = " "});
}

/// Adds the block of a material, and those whose names it uses.
void ValueFinder::add_material(std::vector<ValueSource>& sources, const TextItem& item, const std::string& name) const {
    if (!item.end.empty()) sources.push_back({&item, name});
    if (const TextItem* const named = definition(item.name))
        add_material(sources, named->items[0], label_of_definition(item.name));
}

/// Adds what gives a body its material: its own block, and those of the definition that it uses.
void ValueFinder::add_body(std::vector<ValueSource>& sources, Level level, const std::string& name) const {
    if (const TextItem* const material = level.item->item("material")) add_material(sources, *material, name);
    if (const TextItem* const named = definition(level.item->word))
        add_body(sources, {&named->items[0], named->name}, label_of_definition(named->name));
}

/// Finds where a value of the leaf's own would stand: in its own material, or in a new one.
void ValueFinder::set_own_place(BodyValue& value) const {
    const auto [item, define] = chain.back();
    if (!define.empty()) return;  // every use of the definition would change
    value.before = " " + value.name + " ", value.after = " ";
    if (const TextItem* const material = item->item("material")) {
        if (!material->end.empty()) return void(value.own_at = at(material->end));
        value.own_at = at(material->name) + material->name.size();
        value.before = " {" + value.before, value.after += "}";
        return;
    }
    if (item->end.empty()) return;
    value.own_at = at(item->end);
    value.before = " material {" + value.before, value.after += "} ";
}

std::optional<TextSlice> ValueFinder::material_place() const {
    const auto [item, define] = chain.back();
    if (!define.empty()) return std::nullopt;  // every use of the definition would change
    if (const TextItem* const own = item->item("material"))
        return TextSlice{at(own->word), own->end.empty() ? at(own->name) + own->name.size() : at(own->end) + 1};
    if (item->end.empty()) return std::nullopt;
    return TextSlice{at(item->end), at(item->end)};
}

void ValueFinder::add_material(std::vector<BodyValue>& values) const {
    std::vector<ValueSource> sources;
    for (std::size_t i = chain.size(); i-- > 0;) {
        const auto [item, define] = chain[i];
        add_body(sources, chain[i],
                 !define.empty()         ? label_of_definition(define)
                 : i + 1 == chain.size() ? ""
                                         : label(item->word, item->word));
    }
    for (std::size_t i = found.defaults.size(); i-- > 0;)
        add_material(sources, found.defaults[i], label("defaultmaterial", found.defaults[i].word));

    const auto add = [&](const auto& field) {
        using Value = std::remove_cvref_t<decltype(Material{}.*field.member)>;
        constexpr bool color = std::is_same_v<Value, Pigment>;
        if constexpr (color || std::is_same_v<Value, double>) {
            BodyValue value{.name = field.name, .help = field.help, .range = range_of(field.range), .color = color};
            if constexpr (color) {
                const Color usual = (Material{}.*field.member).color;
                value.numbers = {usual.x, usual.y, usual.z};
            } else {
                value.numbers = {Material{}.*field.member};
            }
            value.source = no_source;
            for (const ValueSource& source : sources) {
                const TextItem* const given = source.block->item(field.name);
                if (!given) continue;
                const std::size_t count = value.numbers.size();
                value = value_of(*given, field.name, field.help, range_of(field.range));
                value.color = color, value.source = source.name;
                if (value.numbers.size() != count && value.fixed.empty()) value.fixed = "a pattern";
                break;
            }
            value.follows = true;
            if (!value.source.empty()) set_own_place(value);
            values.push_back(std::move(value));
        }
    };
    std::apply([&](const auto&... field) { (add(field), ...); }, Material::fields);
}

std::string_view kind_of(const Shape& shape) {
    return std::visit([]<class Kind>(const Kind&) -> std::string_view { return Kind::name; }, shape);
}

/// Finds a leaf, and says what it is: "sphere in difference".
const Primitive* find_leaf(const Primitive& body, int& left, std::string& kind) {
    const Primitive* found = nullptr;
    bool composite = false;
    const auto look = [&]<class Kind>(const Kind& own) {
        if constexpr (is_composite<Kind>) {
            composite = true;
            for (const Primitive& part : *own.parts)
                if (!found) found = find_leaf(part, left, kind);
        }
    };
    std::visit(look, body.shape);
    if (!composite && left-- == 0) found = &body;
    if (found) kind.append(kind.empty() ? "" : " in ").append(kind_of(body.shape));
    return found;
}

/// The material as values that cannot be changed.
void add_material(const Material& material, std::vector<BodyValue>& values) {
    const auto add = [&](const auto& field) {
        using Value = std::remove_cvref_t<decltype(Material{}.*field.member)>;
        BodyValue value{.name = field.name, .help = field.help, .fixed = "from the file"};
        if constexpr (std::is_same_v<Value, Pigment>) {
            const Pigment& pigment = material.*field.member;
            value.color = true, value.numbers = {pigment.color.x, pigment.color.y, pigment.color.z};
            if (pigment.pattern) value.fixed = "a pattern";
            values.push_back(value);
        } else if constexpr (std::is_same_v<Value, double>) {
            value.numbers = {material.*field.member};
            values.push_back(value);
        }
    };
    std::apply([&](const auto&... field) { (add(field), ...); }, Material::fields);
}

/// Returns the text of definitions and defaults, in the order of the text.
std::string context_of(const BodyItems& found) {
    std::vector<std::string_view> blocks;
    for (const auto& [name, item] : found.definitions) blocks.push_back(whole_block(item));
    for (const TextItem& item : found.defaults) blocks.push_back(whole_block(item));
    std::ranges::sort(blocks, {}, [](std::string_view block) { return block.data(); });
    std::string text;
    for (const std::string_view block : blocks) text.append(block).append("\n");
    return text;
}

/// The numbers as the value of a parameter.
std::string value_text(std::span<const double> numbers) {
    return numbers.size() == 3 ? text_of(DVec3(numbers[0], numbers[1], numbers[2])) : text_of(numbers[0]);
}

}  // namespace

BodyText body_text(const std::string& text, const Scene& scene, int body, int leaf) {
    BodyText result;
    int left = leaf;
    const Primitive* const own = find_leaf(scene.primitives[static_cast<std::size_t>(body)], left, result.kind);
    if (!own) return result;
    const BodyItems found = items_of_body(text, body);
    ValueFinder finder(text, found);
    if (!finder.find(leaf)) return add_material(scene.materials[std::size_t(own->material)], result.values), result;
    const std::string_view word = finder.levels().back().item->word;
    result.at = finder.at(word), result.line = finder.line(word);
    const std::string_view block = whole_block(found.body);
    result.block_begin = finder.at(block), result.block_end = result.block_begin + block.size();
    result.context = context_of(found);
    finder.add_shape(own->shape, result.values);
    finder.add_transformations(result.values);
    finder.add_material(result.values);
    result.material = finder.material_place();
    return result;
}

std::string with_numbers(const std::string& text, const BodyValue& value, std::span<const double> numbers) {
    std::vector<TextChange> changes;
    for (std::size_t i = 0; i < value.slices.size(); ++i)
        if (numbers[i] != value.numbers[i]) changes.push_back({value.slices[i], text_of(numbers[i])});
    return with_changes(text, std::move(changes));
}

std::string with_own_value(const std::string& text, const BodyValue& value, std::span<const double> numbers) {
    std::string changed = text;
    return changed.insert(value.own_at, value.before + value_text(numbers) + value.after);
}

void take_tracks(BodyValue& value, const std::string& text, const TextItem& item) {
    for (const std::string_view track : item.tracks) {
        value.tracks.push_back(slice_of(text, track));
        const std::string name(track.substr(track.find('"')));
        if (value.fixed.find(name) == std::string::npos)
            value.fixed += (value.fixed.empty() ? "follows " : ", ") + name;
    }
}

std::string with_track(const std::string& text, const BodyValue& value, int component, const std::string& track) {
    const std::string words = "track \"" + track + "\"";
    const auto followed = [&](std::size_t i) { return component < 0 || std::size_t(component) == i; };
    if (value.slices.empty()) {
        std::string numbers;
        for (std::size_t i = 0; i < value.numbers.size(); ++i)
            numbers += (i > 0 ? ", " : "") + (followed(i) ? words + " " : "") + text_of(value.numbers[i]);
        if (value.numbers.size() > 1) numbers = "<" + numbers + ">";
        return std::string(text).insert(value.own_at, value.before + numbers + value.after);
    }
    std::vector<TextChange> changes;
    for (std::size_t i = 0; i < value.slices.size(); ++i) {
        if (!followed(i)) continue;
        const std::size_t at = value.slices[i].begin;
        const auto before = std::ranges::find_if(value.tracks, [&](const TextSlice& slice) {
            return slice.end <= at && text.find_first_not_of(" \t\r\n", slice.end) == at;
        });
        if (before != value.tracks.end())
            changes.push_back({*before, words});
        else
            changes.push_back({{at, at}, words + " "});
    }
    return with_changes(text, std::move(changes));
}

std::string without_tracks(const std::string& text, const BodyValue& value) {
    std::vector<TextChange> changes;
    for (const TextSlice& track : value.tracks) {
        const std::size_t next = std::min(text.find_first_not_of(" \t\r\n", track.end), text.size());
        const bool number = std::ranges::find(value.slices, next, &TextSlice::begin) != value.slices.end();
        changes.push_back({{track.begin, number ? next : track.end}, number ? "" : "0"});
    }
    return with_changes(text, std::move(changes));
}

}  // namespace strahl
