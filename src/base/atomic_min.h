#pragma once

#include <atomic>

namespace vcarve {

/// Lowers a number to another where that is smaller. Many threads may do so at a time: the smallest
/// of all is left, whoever came first.
template <typename Number>
void atomic_min(Number& least, Number value)
{
    const std::atomic_ref<Number> shared(least);
    Number seen = shared.load(std::memory_order_relaxed);
    while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

} // namespace vcarve
