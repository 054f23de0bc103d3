#include "show/work/notes.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

#include "files/utf8.h"

namespace strahl {

void log_line(const std::string& text) { std::cout << "// " << printable(text) << std::endl; }

void Notes::log(const std::string& text) const {
    if (verbose) log_line(text);
}

void Notes::show(Note note, double seconds) {
    if (notes.size() >= 3) notes.pop_front();
    note.until = pace.now() + seconds;
    notes.push_back(std::move(note));
    pace.redraw();
}

void Notes::note(const std::string& text) {
    if (!text.empty()) log(text), show({text}, 3);
}

void Notes::announce(const std::string& text) { log_line(text), show({text}, 6); }

void Notes::fail(const std::string& text) { log_line(text), show({text, true}, 10); }

void Notes::tell(const Answer& answer) {
    note(answer.note);
    if (answer.text.empty()) return;
    glfwSetClipboardString(nullptr, answer.text.c_str());
    std::fputs(answer.text.c_str(), stdout), std::fflush(stdout);
}

bool Notes::expire() {
    return std::erase_if(notes, [now = pace.now()](const Note& n) { return n.until <= now; }) > 0 && notes.empty();
}

double Notes::next_change() const {
    double at = Pace::forever;
    for (const Note& n : notes) at = std::min(at, n.until);
    return at;
}

}  // namespace strahl
