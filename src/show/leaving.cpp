#include "show/leaving.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "show/window/covered_area.h"

namespace strahl {

void Leaving::ask(std::string scene, std::vector<std::string> unwritten, std::function<void()> then) {
    name = std::move(scene), list = std::move(unwritten), go = std::move(then), writes = false;
}

void Leaving::follow(bool unwritten) {
    if (!go || !writes || unwritten) return;
    std::exchange(go, nullptr)();
}

Leaving::Answer Leaving::answer_of(int key) {
    return key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER ? Answer::write
           : key == GLFW_KEY_D                               ? Answer::drop
           : key == GLFW_KEY_ESCAPE                          ? Answer::stay
                                                             : Answer::none;
}

bool Leaving::take(Answer answer) {
    if (!go || answer == Answer::none) return false;
    writes = answer == Answer::write;
    if (answer == Answer::stay) go = nullptr;
    if (answer == Answer::drop) std::exchange(go, nullptr)();
    return writes;
}

Leaving::Answer Leaving::draw(const KeyMap& keys) const {
    constexpr std::size_t most = 5;  // lines of what is not written
    Answer answer = Answer::none;
    begin_panel("leaving", .5f, .4f, 0);
    ImGui::Text("%s is not written:", name.c_str());
    ImGui::PushTextWrapPos(30 * ImGui::GetFontSize());
    for (std::size_t i = 0; i < std::min(most, list.size()); ++i) ImGui::TextDisabled("%s", list[i].c_str());
    if (list.size() > most) ImGui::TextDisabled("and %d lines more", static_cast<int>(list.size() - most));
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    const auto button = [&](const std::string& label, Answer given) {
        if (ImGui::Button(label.c_str())) answer = given;
        ImGui::SameLine();
    };
    button("write it (Enter, " + keys.name(Action::write_path) + ")", Answer::write);
    button("drop it (D)", Answer::drop);
    button("stay (Esc)", Answer::stay);
    if (writes) ImGui::NewLine(), ImGui::TextUnformatted("It goes on once this is written.");
    end_panel();
    return answer;
}

}  // namespace strahl
