// Moves, turns and scales a body in a scene's text, copies and removes bodies and lights. The rest of the text stays as
// it is written.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "num/vec.h"
#include "scene/scene.h"
#include "text/text_changes.h"

namespace strahl {

struct MoveBy {
    DVec3 by{0};
};
struct TurnBy {
    DVec3 axis{0, 0, 1};  // of length 1
    double degrees = 0;   // counter-clockwise seen from the tip of the axis
    DVec3 about{0};       // a point that stays where it is
};
/// Returns the vector after a turn about an axis, not about a point of it.
DVec3 turned(const DVec3& v, const TurnBy& turn);
/// Factors along the body's own axes, see PlacedBody::axes().
struct ScaleBy {
    DVec3 factors{1};
    DVec3 about{0};
};
/// Moves, turns or scales a body in the space of the world.
using Placing = std::variant<MoveBy, TurnBy, ScaleBy>;

/// Rounds to this many decimals, or with negative ones to tens, hundreds and so on. Returns `before` for a number that
/// differs from it by rounding errors only.
double rounded(double value, double before, int decimals);
DVec3 rounded(const DVec3& value, const DVec3& before, int decimals);

/// A body of the top level as it stands in a text without errors, to be placed elsewhere, again and again.
class PlacedBody {
  public:
    /// Finds a body in a text, or returns nothing if it has no such body. `scene` is that of the text.
    static std::optional<PlacedBody> find(std::string text, const Scene& scene, int body);

    /// Returns the changes of the text by which the body is placed so. A body without transformations gets other points
    /// and lengths where these say the same, unless its material has a pattern, which must move with it. Else `scale`,
    /// `rotate` and `translate` at the end of its block change, or are added there. Numbers that change are rounded to
    /// this many decimals.
    std::vector<TextChange> changes(const Placing& placing, int decimals) const;
    /// Returns the text with these changes.
    std::string text(const Placing& placing, int decimals) const;
    /// Returns the body's own axes in the world, as the last `rotate` turned them.
    std::array<DVec3, 3> axes() const;

  private:
    /// An argument of the body: its first number, and what it is.
    struct PlacedArgument {
        enum Means { point, direction, size } meaning;
        std::size_t first;
    };
    /// One of the transformations at the end of a body's block.
    struct LastStep {
        const char* word;
        DVec3 value;
        std::size_t at = 0;                // position of the parameter's word, if it is written
        std::vector<TextSlice> numbers{};  // one or three; none if it is not written
    };
    /// The last transformations; what comes before them stays as it is.
    struct LastSteps {
        LastStep scale{"scale", DVec3(1)}, rotate{"rotate", DVec3(0)}, translate{"translate", DVec3(0)};
    };

    bool place_arguments(const Placing& placing, int decimals, std::vector<TextChange>& changes) const;
    void place_steps(const Placing& placing, int decimals, std::vector<TextChange>& changes) const;

    std::string original;
    bool box = false;
    std::vector<PlacedArgument> arguments;  // none if other numbers in their place would not do
    std::vector<TextSlice> slices;          // of the numbers of all arguments
    std::vector<double> numbers;
    LastSteps last;
    std::size_t end = 0;  // position of the block's closing brace
};

/// A block of the top level. There is one camera and one background; the others are copied and removed.
enum class TopBlock { body, light, camera, background };
/// Returns the text with a copy of this block behind it, which has the next number; or without this block, and without
/// its lines if nothing else but a comment behind it stands there. Both return the text as it is if there is no such
/// block.
std::string with_copy(const std::string& text, TopBlock what, int number);
std::string without_block(const std::string& text, TopBlock what, int number);
/// Returns the text with another block behind this one, or at the end if there is no such block.
std::string with_block(const std::string& text, TopBlock what, int number, const std::string& block);

}  // namespace strahl
