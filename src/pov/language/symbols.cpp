#include "pov/language/symbols.h"

#include <algorithm>

namespace strahl::pov {

Symbols::~Symbols() {
    while (top() > 0) pop();
    for (Symbol* symbol : globals) release(symbol);
    for (Symbol* symbol : unused) delete symbol;
}

Symbol& Symbols::add(std::uint32_t name, bool global) {
    if (unused.empty()) unused.push_back(new Symbol);
    Symbol* symbol = unused.back();
    unused.pop_back();
    if (name >= youngest.size()) youngest.resize(name + 1);
    symbol->name = name;
    symbol->table = global ? 0 : top();
    symbol->outer = youngest[name];
    symbol->users = 1;
    youngest[name] = symbol;
    (symbol->table == 0 ? globals : locals).push_back(symbol);
    return *symbol;
}

void Symbols::remove(Symbol& symbol) {
    std::vector<Symbol*>& list = symbol.table == 0 ? globals : locals;
    const auto place = std::find(list.rbegin(), list.rend(), &symbol);
    if (symbol.table == 0) {
        *place = list.back();
        list.pop_back();
    } else {
        *place = nullptr;
    }
    youngest[symbol.name] = symbol.outer;
    release(&symbol);
}

void Symbols::pop() {
    for (std::size_t i = bases.back(); i < locals.size(); ++i)
        if (Symbol* symbol = locals[i]) {
            youngest[symbol->name] = symbol->outer;
            release(symbol);
        }
    locals.resize(bases.back());
    bases.pop_back();
}

void Symbols::refer(Symbol& parameter, Symbol* target) {
    if (target) ++target->users;
    if (parameter.target) release(parameter.target);
    parameter.target = target;
}

void Symbols::release(Symbol* symbol) {
    if (--symbol->users) return;
    refer(*symbol, nullptr);
    symbol->value = {};
    symbol->element = {};
    unused.push_back(symbol);
}

}  // namespace strahl::pov
