#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace vcarve {

/// Makes values when they are needed. Keeps the last `most` used ones, and all that are in use.
/// Thread-safe.
template <typename Value>
class RecentlyUsed {
  public:
    using Make = std::function<Value(std::size_t)>;

    RecentlyUsed(std::size_t count, std::size_t most, Make make)
        : make_(std::move(make)), most_(most), slots_(count)
    {
    }

    std::shared_ptr<const Value> get(std::size_t index) const
    {
        Slot& slot = slots_[index];
        std::shared_ptr<const Value> value;
        {
            const std::lock_guard lock(slot.mutex);
            if (!slot.value) slot.value = std::make_shared<const Value>(make_(index));
            value = slot.value;
        }
        slot.used = ++clock_;
        forget();
        return value;
    }

  private:
    struct Slot {
        std::mutex mutex; ///< guards value
        std::shared_ptr<const Value> value;
        std::atomic<std::uint64_t> used = 0;
    };

    /// Forgets the values that were not among the last uses.
    void forget() const
    {
        for (Slot& slot : slots_) {
            if (slot.used == 0 || slot.used + most_ >= clock_) continue;
            const std::unique_lock lock(slot.mutex, std::try_to_lock);
            if (!lock.owns_lock()) continue;
            slot.value.reset();
            slot.used = 0;
        }
    }

    Make make_;
    std::size_t most_;
    mutable std::vector<Slot> slots_;
    mutable std::atomic<std::uint64_t> clock_ = 0;
};

} // namespace vcarve
