// Fields for numbers, which are dragged at once, or typed: what is typed applies at Enter, at Tab, which goes to the
// next field, and when the field is left. Escape gives the old number back.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>

#include "text/reading/parameter.h"

namespace strahl {

/// Reads what a user has typed for a number in a range: a comma is a decimal point. `why` becomes the reason if it is
/// none, such as "has to be from 0 to 1".
std::optional<double> typed_number(std::string text, const NumberRange& range, std::string& why);

class NumberFields {
  public:
    enum class FieldEdit { none, dragged, typed };
    /// To be called before the fields of a picture are drawn.
    void begin();
    /// Draws fields beside each other, together of this width in pixels; a single number between 0 and 1 as a slider.
    /// Returns how a number has changed. To be called while ImGui makes a frame.
    FieldEdit draw(const char* id, std::span<double> numbers, const NumberRange& range, float width,
                   const char* form = "%.4g");
    /// Why the number typed last was not taken; "" if it was, or if none was typed.
    const std::string& reason() const { return refused; }

  private:
    FieldEdit field(double& number, const NumberRange& range, float width, double largest, bool slider,
                    const char* form);

    int count = 0;            // of the fields drawn in this picture
    std::optional<int> next;  // the field that Tab has gone to
    std::array<char, 64> text{};
    std::string refused;
};

}  // namespace strahl
