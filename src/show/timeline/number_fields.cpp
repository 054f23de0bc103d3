#include "show/timeline/number_fields.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "files/words.h"
#include "num/decimal.h"

namespace strahl {
namespace {

/// Makes a field of text take letters at once. ImGui up to 1.89 keeps such a request in a member of its own.
template <class Context>
void take_letters(Context& context, ImGuiID id) {
    if constexpr (requires { context.NavActivateInputId; })
        context.NavActivateInputId = id;
    else
        context.NavActivateId = id, context.NavActivateFlags = ImGuiActivateFlags_PreferInput;
}

/// Returns the words of a range without what stands in parentheses.
std::string short_words(const NumberRange& range) {
    std::string words = range.words;
    const std::size_t begin = words.find(" ("), end = words.find(')');
    if (begin != words.npos && end != words.npos) words.erase(begin, end + 1 - begin);
    return words;
}

/// The least number that a drag goes to: so far above 0 that it can be seen, where 0 itself is out of range.
double least_dragged(const NumberRange& range, double number) {
    return range.low > 0 && range.low < 1e-3 ? std::min(std::max(number, range.low), 1e-3) : range.low;
}

}  // namespace

std::optional<double> typed_number(std::string text, const NumberRange& range, std::string& why) {
    std::ranges::replace(text, ',', '.');
    text.erase(text.find_last_not_of(' ') + 1).erase(0, text.find_first_not_of(' '));
    double number = 0;
    if (!read_number(text, number) || !std::isfinite(number)) return why = "'" + text + "' is no number", std::nullopt;
    if (range.contains(number)) return number;
    why = "has to be " + short_words(range) + (range.whole ? ", and whole" : "");
    return std::nullopt;
}

void NumberFields::begin() {
    if (next && (*next < 0 || *next >= count)) next.reset();  // there is no such field
    count = 0, refused.clear();
}

NumberFields::FieldEdit NumberFields::draw(const char* id, std::span<double> numbers, const NumberRange& range,
                                           float width, const char* form) {
    const float space = ImGui::GetStyle().ItemInnerSpacing.x, fields = static_cast<float>(numbers.size());
    const float one = std::floor((width - (fields - 1) * space) / fields);
    double largest = 0;
    for (const double number : numbers) largest = std::max(largest, std::abs(number));
    const bool slider = numbers.size() == 1 && range.low == 0 && range.high == 1 && !range.whole;
    FieldEdit change = FieldEdit::none;
    ImGui::PushID(id);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (i > 0) ImGui::SameLine(0, space);
        ImGui::PushID(static_cast<int>(i));
        if (const FieldEdit done = field(numbers[i], range, one, largest, slider, form); done != FieldEdit::none)
            change = done;
        ImGui::PopID();
    }
    ImGui::PopID();
    return change;
}

NumberFields::FieldEdit NumberFields::field(double& number, const NumberRange& range, float width, double largest,
                                            bool slider, const char* form) {
    constexpr const char* label = "##number";
    const ImGuiID id = ImGui::GetID(label);
    const int own = count++;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImRect box(corner, {corner.x + width, corner.y + ImGui::GetFrameHeight()});
    bool typing = ImGui::TempInputIsActive(id), begins = next == own;
    FieldEdit change = FieldEdit::none;
    if (typing || begins) {
        ImGui::ItemSize(box);
        ImGui::ItemAdd(box, id, &box);
    } else {
        const double low = least_dragged(range, number), before = number;
        const bool limited = std::isfinite(range.high - range.low);
        const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput;
        const char* const digits = range.whole ? "%.0f" : form;
        const float speed = range.whole ? .1f : static_cast<float>(std::clamp(largest, .1, 1e6) / 200);
        ImGui::SetNextItemWidth(width);
        if (slider)
            ImGui::SliderScalar(label, ImGuiDataType_Double, &number, &range.low, &range.high, digits, flags);
        else
            ImGui::DragScalar(label, ImGuiDataType_Double, &number, speed, limited ? &low : nullptr,
                              limited ? &range.high : nullptr, digits, flags);
        if (number != before) change = FieldEdit::dragged;
        const bool double_click = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
        const bool with_control = ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
        if (!ImGui::IsItemHovered() || !(double_click || with_control)) return change;
        begins = true;
        if (with_control) number = before, change = FieldEdit::none;
    }
    if (begins) {
        next.reset();
        std::snprintf(text.data(), text.size(), "%s", text_of(number).c_str());
        take_letters(*ImGui::GetCurrentContext(), id);
    }
    const bool entered = ImGui::TempInputText(box, id, label, text.data(), static_cast<int>(text.size()),
                                              ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    typing = ImGui::TempInputIsActive(id);
    const bool tab = typing && !begins && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab), false);
    const bool escaped = !typing && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (tab) next = own + (ImGui::GetIO().KeyShift ? -1 : 1), ImGui::ClearActiveID();
    if (begins || escaped || (typing && !tab && !entered)) return change;
    const auto typed = typed_number(text.data(), range, refused);
    if (!typed || text_of(*typed) == text_of(number)) return FieldEdit::none;
    number = *typed;
    return FieldEdit::typed;
}

}  // namespace strahl
