#include "povref/convert/layout.h"

#include <algorithm>

#include "files/utf8.h"

namespace strahl {
namespace {
constexpr std::size_t columns = 100;
}

std::string block(const std::string& head, std::vector<std::string> items, const std::string& indent) {
    std::erase(items, "");
    std::size_t length = indent.size() + head.size() + 2;
    for (const std::string& item : items) length += 1 + item.size();
    const bool broken = length > columns || head.find('\n') != head.npos;
    std::string text = head;
    for (const std::string& item : items) text += (broken ? "\n" + indent + "  " : " ") + item;
    return text + (broken ? "\n" + indent + "}\n" : " }\n");
}

std::string comment(const std::string& words, const std::string& mark) {
    const std::string text = show(words).text;  // a line break in it would end the comment
    std::string lines, line = mark;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find(' ', start), text.size());
        if (line.size() + 1 + end - start > columns) lines += line + "\n", line = mark;
        line.append(" ").append(text, start, end - start);
        start = end + 1;
    }
    return lines + line + "\n";
}

std::string heading(const std::string& text) { return "\n// ---- " + text + " ----\n"; }

}  // namespace strahl
