// The order of all changes that the user makes to a scene, whether to its text, its path or its tracks, so that undo
// takes back the last one of all.
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace strahl {

class EditOrder {
  public:
    /// Numbers a new change, after which nothing that was taken back before can be made again.
    std::size_t change() { return newest = ++count; }
    /// Numbers a step of undo or redo.
    std::size_t step() { return ++count; }
    /// Can a change be made again that was taken back by the step with this number?
    bool may_redo(std::size_t step) const { return step > newest; }

  private:
    std::size_t count = 0, newest = 0;
};

/// Describes a change before it is made.
struct Edit {
    EditOrder& order;
    std::string what;     // for the user: "radius of sphere 1"
    bool merged = false;  // undo takes back this change and the one before together, as for the steps of a drag
};

/// The changes of one thing that can be taken back, and those that were taken back; the last ones at the end.
template <class Change>
struct EditSteps {
    struct Step {
        Change change;
        std::string what;
        std::size_t order = 0;
    };
    std::vector<Step> past, future;

    void add(Change change, const Edit& edit) {
        constexpr std::size_t most = 500;
        past.push_back({std::move(change), edit.what, edit.order.change()});
        if (past.size() > most) past.erase(past.begin());
        future.clear();
    }
    /// Returns the number of the step that undo takes back next, or that redo makes again; 0 if there is none.
    std::size_t next(bool back, const EditOrder& order) const {
        const std::vector<Step>& from = back ? past : future;
        return from.empty() || (!back && !order.may_redo(from.back().order)) ? 0 : from.back().order;
    }
    /// Has `apply` take back or make again the next change, if there is one. Returns what that was.
    template <class Apply>
    std::optional<std::string> move(bool back, EditOrder& order, Apply apply) {
        if (next(back, order) == 0) return std::nullopt;
        std::vector<Step>&from = back ? past : future, &to = back ? future : past;
        apply(from.back().change);
        to.push_back(std::move(from.back()));
        from.pop_back();
        to.back().order = order.step();
        return to.back().what;
    }
};

}  // namespace strahl
