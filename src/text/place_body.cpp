#include "text/place_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "files/words.h"
#include "num/decimal.h"
#include "num/vec_math.h"
#include "text/blocks/blocks.h"
#include "text/text_items.h"

namespace strahl {
namespace {

constexpr int angle_decimals = 2, factor_decimals = 4;

using Axes = std::array<DVec3, 3>;  // the columns of a rotation
Axes axes_of(const DVec3& degrees) {
    const Transformation steps[] = {Rotate{degrees}};
    const glm::dmat4 m = matrix(steps);
    return {DVec3(m[0]), DVec3(m[1]), DVec3(m[2])};
}
DVec3 turned(const Axes& axes, const DVec3& v) { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
DVec3 turned_back(const Axes& axes, const DVec3& v) {
    return {dot_product(axes[0], v), dot_product(axes[1], v), dot_product(axes[2], v)};
}

/// Returns the degrees about x, y and z of a rotation: of all that make it those nearest to `before`.
DVec3 degrees_of(const Axes& axes, const DVec3& before) {
    const double degree = 180 / std::numbers::pi, sine = -axes[0].z;
    DVec3 found;
    if (std::abs(sine) > 1 - 1e-12) {  // x and z turn about the same axis
        const double x = before.x / degree;
        const double both = std::atan2(std::copysign(1, sine) * axes[1].x, axes[1].y);
        found = degree * DVec3(x, std::copysign(std::numbers::pi / 2, sine), sine > 0 ? x - both : both - x);
    } else {
        found = degree * DVec3(std::atan2(axes[1].z, axes[2].z), std::asin(sine), std::atan2(axes[0].y, axes[0].x));
    }
    const auto nearest = [&](DVec3 v) {
        for (int i = 0; i < 3; ++i) v[i] += 360 * std::round((before[i] - v[i]) / 360);
        return v;
    };
    const auto way = [&](const DVec3& v) {
        return std::abs(v.x - before.x) + std::abs(v.y - before.y) + std::abs(v.z - before.z);
    };
    const DVec3 one = nearest(found), other = nearest({found.x + 180, 180 - found.y, found.z + 180});
    return way(other) < way(one) ? other : one;
}

/// Returns a text to be inserted before the closing brace at `end`: in the same line, or else in one of its own.
std::pair<std::size_t, std::string> before_end(const std::string& text, std::size_t end, const std::string& added) {
    std::size_t at = end;
    while (at > 0 && is_space(text[at - 1])) --at;
    const std::string space = text.substr(at, end - at);
    if (space.find('\n') == space.npos)
        return {at, (text[at - 1] == '{' ? " " : "  ") + added + (space.empty() ? " " : "")};
    const std::string brace = indentation(text, end), other = indentation(text, at);
    return {at, "\n" + (other.size() > brace.size() ? other : brace + "  ") + added};
}

/// Does the look of a surface of this material depend on where its points are?
bool patterned(const Material& material) {
    return material.rgb.pattern || material.bump.pattern || material.normal.pattern || !material.coats.empty();
}

}  // namespace

/// Turns by Rodrigues' formula.
DVec3 turned(const DVec3& v, const TurnBy& turn) {
    const double angle = turn.degrees * std::numbers::pi / 180, cosine = std::cos(angle);
    return cosine * v + std::sin(angle) * cross_product(turn.axis, v) +
           (1 - cosine) * dot_product(turn.axis, v) * turn.axis;
}

double rounded(double value, double before, int decimals) {
    const double scale = std::pow(10., std::abs(decimals));
    if (std::abs(value - before) < (decimals < 0 ? scale : 1 / scale) * 1e-4) return before;
    const double number = decimals < 0 ? std::round(value / scale) * scale : std::round(value * scale) / scale;
    return std::isfinite(number) ? number : before;
}
DVec3 rounded(const DVec3& value, const DVec3& before, int decimals) {
    DVec3 result;
    for (int i = 0; i < 3; ++i) result[i] = rounded(value[i], before[i], decimals);
    return result;
}

std::optional<PlacedBody> PlacedBody::find(std::string text, const Scene& scene, int body) {
    PlacedBody placed;
    placed.original = std::move(text);
    const std::string& all = placed.original;
    const TextItem item = items_of_body(all, body).body;
    if (item.word.empty() || item.end.empty()) return std::nullopt;
    placed.end = slice_of(all, item.end).begin;

    std::vector<const TextItem*> steps;
    for (const TextItem& inner : item.items)
        if (contains(transformation_words, inner.word) || inner.word == "motion") steps.push_back(&inner);
    const bool any = !steps.empty();
    const auto take = [&](LastStep& step) {
        if (steps.empty() || steps.back()->word != step.word || !steps.back()->tracks.empty()) return;
        const auto& written = steps.back()->numbers;
        if (written.size() != 3 && written.size() != 1) return;
        for (std::size_t i = 0; i < 3; ++i) read_number(written[std::min(i, written.size() - 1)], step.value[int(i)]);
        for (const std::string_view number : written) step.numbers.push_back(slice_of(all, number));
        step.at = slice_of(all, steps.back()->word).begin;
        steps.pop_back();
    };
    take(placed.last.translate), take(placed.last.rotate), take(placed.last.scale);

    const Primitive& primitive = scene.primitives[std::size_t(body)];
    if (any || !item.tracks.empty() || !is_body_word(item.word) ||
        patterned(scene.materials[std::size_t(primitive.material)]))
        return placed;
    std::size_t next = 0;
    const auto add = [&]<class Kind, class Value>(const Field<Kind, Value>& field) {
        constexpr bool vector = std::is_same_v<Value, DVec3>;
        if (next + (vector ? 3 : 1) > item.numbers.size()) return;
        placed.arguments.push_back({!vector                           ? PlacedArgument::size
                                    : field.range == Range::direction ? PlacedArgument::direction
                                                                      : PlacedArgument::point,
                                    next});
        next += vector ? 3 : 1;
    };
    std::visit(
        [&]<class Kind>(const Kind&) { std::apply([&](const auto&... field) { (add(field), ...); }, Kind::fields); },
        primitive.shape);
    placed.box = item.word == Cuboid::name;
    for (const std::string_view number : item.numbers) {
        placed.slices.push_back(slice_of(all, number));
        read_number(number, placed.numbers.emplace_back());
    }
    return placed;
}

Axes PlacedBody::axes() const { return axes_of(last.rotate.value); }

std::vector<TextChange> PlacedBody::changes(const Placing& placing, int decimals) const {
    std::vector<TextChange> changes;
    if (!place_arguments(placing, decimals, changes)) place_steps(placing, decimals, changes);
    return changes;
}

std::string PlacedBody::text(const Placing& placing, int decimals) const {
    return with_changes(original, changes(placing, decimals));
}

/// Gives the body other arguments. False if that would not do.
bool PlacedBody::place_arguments(const Placing& placing, int decimals, std::vector<TextChange>& changes) const {
    const auto* const move = std::get_if<MoveBy>(&placing);
    const auto* const scale = std::get_if<ScaleBy>(&placing);
    if (arguments.empty() || (!move && !scale)) return false;
    const bool even = scale && scale->factors.x == scale->factors.y && scale->factors.y == scale->factors.z;
    if (scale && ((!box && !even) || std::min({scale->factors.x, scale->factors.y, scale->factors.z}) <= 0))
        return false;
    const auto set = [&](std::size_t number, double value) {
        const double newer = rounded(value, numbers[number], decimals);
        if (newer != numbers[number]) changes.push_back({slices[number], strahl::text_of(newer)});
    };
    for (const auto& [meaning, first] : arguments) {
        if (meaning == PlacedArgument::size && scale) {
            const double least = numbers[first] > 0 ? std::pow(10., -decimals) : 0;
            set(first, std::max(numbers[first] * scale->factors.x, least));
        }
        for (int i = 0; i < 3 && meaning == PlacedArgument::point; ++i) {
            const double number = numbers[first + std::size_t(i)];
            set(first + std::size_t(i),
                move ? number + move->by[i] : scale->about[i] + scale->factors[i] * (number - scale->about[i]));
        }
    }
    return true;
}

/// Changes the last transformations, or adds them.
void PlacedBody::place_steps(const Placing& placing, int decimals, std::vector<TextChange>& changes) const {
    DVec3 factors = last.scale.value, degrees = last.rotate.value, by = last.translate.value;
    if (const auto* const move = std::get_if<MoveBy>(&placing)) by = rounded(by + move->by, by, decimals);
    if (const auto* const turn = std::get_if<TurnBy>(&placing)) {
        const Axes before = axes();
        Axes after = before;
        for (DVec3& axis : after) axis = turned(axis, *turn);
        degrees = rounded(degrees_of(after, degrees), degrees, angle_decimals);
        const DVec3 inside = turned_back(before, turn->about - by);
        by = rounded(turn->about - turned(axes_of(degrees), inside), by, decimals + 1);
    }
    if (const auto* const scale = std::get_if<ScaleBy>(&placing)) {
        factors = rounded(factors * scale->factors, factors, factor_decimals);
        DVec3 inside = turned_back(axes(), scale->about - by);
        for (int i = 0; i < 3; ++i) {
            if (factors[i] == 0) factors[i] = last.scale.value[i];
            inside[i] *= factors[i] / last.scale.value[i];
        }
        by = rounded(scale->about - turned(axes(), inside), by, decimals + 1);
    }
    std::string added;  // what comes before the next step that is written
    const std::pair<const LastStep&, DVec3> steps[] = {
        {last.scale, factors}, {last.rotate, degrees}, {last.translate, by}};
    for (const auto& [step, value] : steps) {
        const bool single = step.numbers.size() == 1 && value.x == value.y && value.y == value.z;
        if (step.numbers.empty()) {
            if (value == step.value) continue;
            const bool even = step.word == last.scale.word && value.x == value.y && value.y == value.z;
            added.append(added.empty() ? "" : " ").append(step.word).append(" ");
            added += even ? strahl::text_of(value.x) : strahl::text_of(value);
            continue;
        }
        if (!added.empty()) changes.push_back({{step.at, step.at}, std::exchange(added, "") + " "});
        if (step.numbers.size() == 1 && !single) {
            changes.push_back({step.numbers[0], strahl::text_of(value)});
            continue;
        }
        for (std::size_t i = 0; i < step.numbers.size(); ++i)
            if (value[int(i)] != step.value[int(i)])
                changes.push_back({step.numbers[i], strahl::text_of(value[int(i)])});
    }
    if (added.empty()) return;
    const auto [place, text] = before_end(original, end, added);
    changes.push_back({{place, place}, text});
}

namespace {

/// Says where a block begins and ends; both are 0 if there is none.
std::pair<std::size_t, std::size_t> place_of(const std::string& text, TopBlock what, int number) {
    const TextItem item = what == TopBlock::body ? items_of_body(text, number).body : item_of_light(text, number);
    if (item.end.empty()) return {};
    return {std::size_t(item.word.data() - text.data()), std::size_t(item.end.data() - text.data()) + 1};
}

}  // namespace

std::string with_copy(const std::string& text, TopBlock what, int number) {
    const auto [begin, end] = place_of(text, what, number);
    return end == 0 ? text : with_block(text, what, number, text.substr(begin, end - begin));
}

std::string with_block(const std::string& text, TopBlock what, int number, const std::string& block) {
    const auto [begin, end] = place_of(text, what, number);
    std::string longer = text;
    if (end == 0) return longer += (text.empty() || text.back() == '\n' ? "" : "\n") + block + "\n";
    const std::string indent = indentation(text, begin);
    const bool own_line = begin == indent.size() || text[begin - indent.size() - 1] == '\n';
    const std::size_t rest = rest_of_line(text, end);
    const bool ends_line = rest == text.size() || text[rest] == '\n';
    if (own_line && ends_line) return longer.insert(rest, "\n" + indent + block);
    return longer.insert(end, " " + block);
}

std::string without_block(const std::string& text, TopBlock what, int number) {
    auto [begin, end] = place_of(text, what, number);
    if (end == 0) return text;
    const std::size_t indent = indentation(text, begin).size();
    const std::size_t rest = rest_of_line(text, end);
    if (begin == indent || text[begin - indent - 1] == '\n') {
        if (rest == text.size() || text[rest] == '\n') begin -= indent, end = std::min(rest + 1, text.size());
    } else if (text[begin - 1] == ' ') {
        --begin;
    }
    std::string changed = text;
    return changed.erase(begin, end - begin);
}

}  // namespace strahl
