// Makes second pictures in the background, at low priority, and keeps the last ones.
#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "show/second/second_picture.h"

namespace strahl {

class SecondPictures {
  public:
    /// `notify` is called from another thread when there is something to take.
    SecondPictures(int threads, std::function<void()> notify);
    ~SecondPictures();
    SecondPictures(const SecondPictures&) = delete;

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
    void loop(const std::stop_token& quit);
    void make(const SecondOrder& order, std::uint64_t number);
    void publish(std::uint64_t number, std::shared_ptr<const SecondPicture> picture, const std::string& fault);

    const int threads;
    const std::function<void()> notify;
    SecondOrder wanted;
    std::uint64_t number = 0;  // of `wanted`, counted from 1
    std::shared_ptr<const SecondPicture> current;
    std::string why_none;
    /// Finished pictures, the latest first.
    std::deque<std::pair<SecondOrder, std::shared_ptr<const SecondPicture>>> kept;

    // Shared between threads:
    std::mutex mutex;
    std::condition_variable_any wake;
    std::optional<std::pair<SecondOrder, std::uint64_t>> next;
    struct Result {
        std::uint64_t number = 0;
        std::shared_ptr<const SecondPicture> picture{};
        std::string fault{};
    };
    std::optional<Result> made;
    std::atomic<bool> stop = false;
    std::jthread thread;
};

}  // namespace strahl
