#include "show/welcome/welcome.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace strahl {

void Welcome::appear() {
    if (!reader) reader.emplace(threads, notify);
    reader->list();
}

void Welcome::disappear() {
    if (reader) reader->want({}, 1, 1);
}

bool Welcome::key(int key) {
    if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_SPACE) return taken = true;
    constexpr int all = 1 << 20;
    const int items =
        (key == GLFW_KEY_RIGHT) - (key == GLFW_KEY_LEFT) + all * ((key == GLFW_KEY_END) - (key == GLFW_KEY_HOME));
    const int rows = (key == GLFW_KEY_DOWN) - (key == GLFW_KEY_UP) +
                     rows_seen * ((key == GLFW_KEY_PAGE_DOWN) - (key == GLFW_KEY_PAGE_UP));
    if (items == 0 && rows == 0) return false;
    if (sections) chosen = moved(*sections, chosen, items, rows, columns);
    return scrolls = true;
}

void Welcome::take(const Screen& screen) {
    if (!reader) return;
    if (complete && !told) notes.log("the gallery shows all its pictures");
    told = complete;
    while (auto found = reader->take()) {
        pace.redraw();
        if (!found->listed) {
            const auto& [image, fault, files] = found->picture;
            pictures[found->path] = {image.width > 0 ? screen.make_texture(image) : 0, fault};
            continue;
        }
        sections = std::move(found->listed), chosen = {};
        std::size_t count = 0;
        for (const GallerySection& section : *sections) count += section.items.size();
        if (missing = missing_scenes(); !missing.empty()) notes.log(missing);
        notes.log("gallery of " + std::to_string(count) + " scenes after " + seconds_text(pace.now()));
    }
}

/// Draws a scene's picture and name. Returns whether it was clicked.
bool Welcome::draw_item(const GalleryItem& item, bool marked) {
    const float font = ImGui::GetFontSize(), edge = std::round(font * .3f), high = std::round(width * .75f);
    const ImVec2 from = ImGui::GetCursorScreenPos(), inner{from.x + edge, from.y + edge};
    const bool clicked = ImGui::InvisibleButton(item.path.c_str(), {width, high + 1.4f * font});
    if (!ImGui::IsItemVisible()) return clicked;
    visible.push_back(item.path);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end = ImGui::GetItemRectMax(), picture{from.x + width - edge, from.y + high - edge};
    if (marked || ImGui::IsItemHovered())
        list.AddRectFilled(from, end, marked ? IM_COL32(92, 173, 237, 150) : IM_COL32(255, 255, 255, 40), edge);
    const auto found = pictures.find(item.path);
    const GalleryTile tile = found == pictures.end() ? GalleryTile{} : found->second;
    if (tile.texture != 0)
        list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(tile.texture)), inner, picture);
    else
        list.AddRectFilled(inner, picture, IM_COL32(255, 255, 255, 20));
    list.PushClipRect(from, end, true);
    if (!tile.fault.empty())
        list.AddText(ImGui::GetFont(), font, {inner.x + edge, inner.y + edge}, IM_COL32(255, 150, 130, 255),
                     tile.fault.c_str(), nullptr, width - 4 * edge);
    list.AddText({inner.x, picture.y + edge / 2}, ImGui::GetColorU32(ImGuiCol_Text), item.name.c_str());
    list.PopClipRect();
    if (ImGui::IsItemHovered() && !item.begins) ImGui::SetTooltip("%s", item.path.c_str());
    return clicked;
}

std::optional<GalleryItem> Welcome::draw(const KeyMap& keys, bool back) {
    std::optional<GalleryItem> result;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(all);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, {.07f, .08f, .10f, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::Begin("gallery", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::TextDisabled("Click, or arrows and Enter: open   %s, or drop a file here: another   %s: help   %s: %s",
                        keys.name(Action::open_file).c_str(), keys.name(Action::help).c_str(),
                        keys.name(Action::back).c_str(), back ? "back" : "quit");
    ImGui::BeginChild("items");
    const float font = ImGui::GetFontSize(), room = ImGui::GetContentRegionAvail().x, gap = font * .5f;
    columns = std::max(1, static_cast<int>(room / (14 * font)));
    width = std::max(std::floor((room - static_cast<float>(columns - 1) * gap) / static_cast<float>(columns)), 4.f);
    rows_seen = std::max(1, static_cast<int>(ImGui::GetContentRegionAvail().y / (.75f * width + 2 * font)));
    visible.clear();
    if (!missing.empty()) ImGui::TextWrapped("%s", missing.c_str());
    for (std::size_t s = 0; sections && s < sections->size(); ++s) {
        const GallerySection& section = (*sections)[s];
        if (s > 0) ImGui::Spacing();
        ImGui::TextUnformatted(section.title.c_str());
        ImGui::PushID(static_cast<int>(s));
        for (std::size_t i = 0; i < section.items.size(); ++i) {
            if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0, gap);
            const bool marked = chosen == GalleryPlace{s, i};
            if (draw_item(section.items[i], marked)) result = section.items[i], chosen = {s, i};
            if (marked && std::exchange(scrolls, false)) ImGui::SetScrollHereY(.5f);
            if (marked && std::exchange(taken, false)) result = section.items[i];
        }
        ImGui::PopID();
    }
    taken = false;
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    if (!reader) return result;
    reader->want(visible, static_cast<int>(width), static_cast<int>(width * .75f));
    complete = !visible.empty() &&
               std::ranges::all_of(visible, [this](const std::string& path) { return pictures.contains(path); });
    return result;
}

}  // namespace strahl
