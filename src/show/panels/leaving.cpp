#include "show/panels/leaving.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "show/panels/covered_area.h"

namespace strahl {

void Leaving::ask(std::string scene, std::vector<std::string> unwritten, std::function<void()> then) {
    name = std::move(scene), list = std::move(unwritten), go = std::move(then), writes = false;
}

void Leaving::follow(bool unwritten) {
    if (!go || !writes || unwritten) return;
    std::exchange(go, nullptr)();
}

Leaving::Decision Leaving::answer_of(int key) {
    return key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER ? Decision::write
           : key == GLFW_KEY_D                               ? Decision::drop
           : key == GLFW_KEY_ESCAPE                          ? Decision::stay
                                                             : Decision::none;
}

bool Leaving::take(Decision answer) {
    if (!go || answer == Decision::none) return false;
    writes = answer == Decision::write || answer == Decision::save_as;
    if (answer == Decision::stay) go = nullptr;
    if (answer == Decision::drop) std::exchange(go, nullptr)();
    return answer == Decision::write;
}

Leaving::Decision Leaving::draw(const KeyMap& keys) const {
    constexpr std::size_t most = 5;  // lines of what is not written
    Decision answer = Decision::none;
    begin_panel("leaving", .5f, .4f, {});
    ImGui::Text("%s is not written:", name.c_str());
    ImGui::PushTextWrapPos(30 * ImGui::GetFontSize());
    for (std::size_t i = 0; i < std::min(most, list.size()); ++i) ImGui::TextDisabled("%s", list[i].c_str());
    if (list.size() > most) ImGui::TextDisabled("and %d lines more", static_cast<int>(list.size() - most));
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    const auto button = [&](const std::string& label, Decision given) {
        if (ImGui::Button(label.c_str())) answer = given;
        ImGui::SameLine();
    };
    button("write it (Enter, " + keys.name(Action::write_path) + ")", Decision::write);
    button("elsewhere (" + keys.name(Action::save_as) + ")", Decision::save_as);
    button("drop it (D)", Decision::drop);
    button("stay (Esc)", Decision::stay);
    if (writes) ImGui::NewLine(), ImGui::TextUnformatted("It goes on once this is written.");
    end_panel();
    return answer;
}

}  // namespace strahl
