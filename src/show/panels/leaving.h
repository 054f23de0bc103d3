// Asks before changes that are not written would be lost: write them, drop them, or stay.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "show/keys/key_map.h"

namespace strahl {

class Leaving {
  public:
    /// Shows the question, with the name of the scene and what is not written; `go` is what follows if it is dropped,
    /// or once it is written.
    void ask(std::string name, std::vector<std::string> unwritten, std::function<void()> go);
    bool asking() const { return go != nullptr; }
    /// To be called regularly: goes on if the answer was to write, and `unwritten` is false by now.
    void follow(bool unwritten);

    enum class Decision { none, write, save_as, drop, stay };
    /// Returns the answer that a key of GLFW gives.
    static Decision answer_of(int key);
    /// Takes an answer. Returns whether everything is to be written now.
    bool take(Decision answer);
    /// Draws the question, and returns what was clicked. To be called while ImGui makes a frame.
    Decision draw(const KeyMap& keys) const;

  private:
    std::string name;
    std::vector<std::string> list;  // names of what is not written
    std::function<void()> go;       // null if nothing is asked
    bool writes = false;            // the answer was to write, here or elsewhere
};

}  // namespace strahl
