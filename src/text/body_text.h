// The values of a body as a scene's text gives them: its shape, its place and its material; and changes of them that
// leave the rest of the text as it is.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "text/reading/parameter.h"
#include "text/text_changes.h"
#include "text/text_items.h"

namespace strahl {

/// The source of values that no block gives.
inline constexpr std::string_view no_source = "default";

/// A value: one number, or a vector or a colour of three.
struct BodyValue {
    std::string name, help;
    NumberRange range = anything;
    bool color = false;
    std::vector<double> numbers{};
    std::vector<TextSlice> slices{};  // of the numbers in the text; none if they do not stand there
    std::vector<TextSlice> tracks{};  // of the words `track "NAME"` before those numbers that follow tracks
    bool follows = false;             // its numbers may follow tracks
    /// The block that gives them if it is not the body's own: "defaultmaterial, line 3", or `no_source`.
    std::string source{};
    std::string fixed{};  // why the value cannot be changed, or ""
    /// Says where a value of the body's own would be added, 0 for nowhere, and by which text around it.
    std::size_t own_at = 0;
    std::string before{}, after{};
};

/// Takes over which numbers of an item of the text follow tracks. Such a value is fixed.
void take_tracks(BodyValue& value, const std::string& text, const TextItem& item);

struct BodyText {
    std::string kind;    // "sphere", or "sphere in difference"
    std::size_t at = 0;  // where its first word stands in the text
    int line = 0;        // line of the body, counted from 1; 0 if it has no text
    std::vector<BodyValue> values;
    /// The material of its own in the text, or the empty slice where one would stand; none if other bodies share it.
    std::optional<TextSlice> material{};
    /// The block of the body of the top level, in the text; and the blocks `define` and `defaultmaterial` before it.
    std::size_t block_begin = 0, block_end = 0;
    std::string context{};
};
/// Returns what a text without errors says of a leaf of a body; `scene` is that of the text. If the text is empty, as
/// for scenes that come from elsewhere, values cannot be changed.
BodyText body_text(const std::string& text, const Scene& scene, int body, int leaf);

/// Returns the text with other numbers in place of those of a value whose `slices` it has. Numbers that are the same
/// stay as they are written.
std::string with_numbers(const std::string& text, const BodyValue& value, std::span<const double> numbers);
/// Returns the text in which the body has a value of its own. Adds no lines. `value` has a place `own_at`.
std::string with_own_value(const std::string& text, const BodyValue& value, std::span<const double> numbers);
/// Returns the text in which a component of the value, or with -1 each, follows a track; its number stays behind that.
std::string with_track(const std::string& text, const BodyValue& value, int component, const std::string& track);
/// Returns the text in which no component follows a track.
std::string without_tracks(const std::string& text, const BodyValue& value);

}  // namespace strahl
