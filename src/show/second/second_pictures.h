// Makes second pictures in the background, at low priority, and keeps the last ones.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "show/second/second_picture.h"
#include "show/work/worker.h"

namespace strahl {

class SecondPictures {
  public:
    /// `notify` is called from another thread when there is something to take.
    SecondPictures(int threads, std::function<void()> notify) : threads(threads), worker(std::move(notify)) {}

    /// Asks for a picture, unless it is the one that was asked for last. Ends what is under way for another one:
    /// POV-Ray at once, Strahl after the tiles in work. Never waits for it.
    void want(SecondOrder order);
    /// Ends what is under way and asks for nothing.
    void drop() { want({}); }

    /// To be called regularly. Returns true when picture() or fault() has changed.
    bool take();
    /// The picture that was asked for last, as far as there is one, or null.
    const std::shared_ptr<const SecondPicture>& picture() const { return current; }
    /// Says why there is none, or "".
    const std::string& fault() const { return why_none; }
    /// Is the picture that was asked for last being made?
    bool under_way() const { return wanted.scene && why_none.empty() && !(current && current->finished); }

  private:
    struct Result {
        std::uint64_t number = 0;  // number of the order
        std::shared_ptr<const SecondPicture> picture{};
        std::string fault{};
    };
    std::optional<Result> make(const SecondOrder& order, std::uint64_t number, const std::atomic<bool>& stop);

    const int threads;
    SecondOrder wanted;
    std::uint64_t number = 0;  // of `wanted`, counted from 1
    std::shared_ptr<const SecondPicture> current;
    std::string why_none;
    /// Finished pictures, the latest first.
    std::deque<std::pair<SecondOrder, std::shared_ptr<const SecondPicture>>> kept;
    Worker<Result> worker;
};

}  // namespace strahl
