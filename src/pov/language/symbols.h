// Maps identifiers to their values. Scope is dynamic: tables form a stack, and the youngest entry of a name counts.
#pragma once
#include <cstdint>
#include <vector>

#include "pov/language/value.h"

namespace strahl::pov {

/// An entry of a table.
struct Symbol {
    NamedValue value;
    Symbol* outer = nullptr;   // the entry of the same name below it
    Symbol* target = nullptr;  // where a macro was called with an identifier for this parameter: that identifier
    NamedValue element;        // where it was called with an element of an array: the array, as `thing`,
    std::size_t index = 0;     // and the number of the element
    std::uint32_t name = 0;
    int table = 0;
    int users = 1;  // its table, and the parameters that refer to it
};

/// The stack of tables.
class Symbols {
  public:
    Symbols() = default;
    ~Symbols();
    Symbols(const Symbols&) = delete;

    /// Returns the youngest entry of a name, or null.
    Symbol* find(std::uint32_t name) const { return name < youngest.size() ? youngest[name] : nullptr; }
    /// Makes an entry in the table at the top, or for `global`, if there is none of this name, in the lowest.
    Symbol& add(std::uint32_t name, bool global);
    /// Removes an entry that is the youngest of its name.
    void remove(Symbol& symbol);
    void push() { bases.push_back(locals.size()); }
    void pop();
    int top() const { return static_cast<int>(bases.size()); }

    /// Makes a parameter refer to another entry, or drops that.
    void refer(Symbol& parameter, Symbol* target);

    /// Ends a use of an entry, which is freed after the last.
    void release(Symbol* symbol);

  private:
    std::vector<Symbol*> youngest;  // of each name
    std::vector<Symbol*> globals;
    std::vector<Symbol*> locals;     // of all other tables; null where an entry was removed
    std::vector<std::size_t> bases;  // the first in `locals` of each table
    std::vector<Symbol*> unused;
};

}  // namespace strahl::pov
