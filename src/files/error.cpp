#include "files/error.h"

#include <utility>

#include "files/utf8.h"

namespace strahl {
namespace {

std::string all_of(const std::vector<Message>& messages) {
    std::string all;
    for (const Message& message : messages) all.append(all.empty() ? "" : "\n").append(message.told());
    return all;
}

}  // namespace

std::string Message::told() const {
    std::string place = show(file).text;
    if (line > 0) place += ":" + std::to_string(line);
    if (column > 0) place += ":" + std::to_string(column);
    return place + (file.empty() ? "" : ": ") + text + excerpt + calls;
}

FileError::FileError(std::vector<Message> own)
    : std::runtime_error(all_of(own)), messages(std::make_shared<const std::vector<Message>>(std::move(own))) {}

}  // namespace strahl
