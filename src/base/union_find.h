#pragma once

#include <atomic>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace vcarve {

/// Disjoint sets of the numbers below `size`. The root of a set is its least member, so results do
/// not depend on the order of the joins. Thread-safe (Jayanti and Tarjan, "A randomized concurrent
/// algorithm for disjoint set union", PODC 2016, but without random order).
class UnionFind {
  public:
    explicit UnionFind(std::size_t size) : parents_(size)
    {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    std::uint32_t root(std::uint32_t member)
    {
        for (;;) {
            const std::uint32_t parent = load(member);
            if (parent == member) return member;
            // A late store is harmless, because an ancestor remains an ancestor.
            const std::uint32_t grandparent = load(parent);
            if (grandparent != parent) {
                std::atomic_ref(parents_[member]).store(grandparent, std::memory_order_relaxed);
            }
            member = grandparent;
        }
    }

    void join(std::uint32_t a, std::uint32_t b)
    {
        for (;;) {
            a = root(a);
            b = root(b);
            if (a == b) return;
            if (a > b) std::swap(a, b);
            std::uint32_t expected = b; // fails if b got a parent meanwhile
            if (std::atomic_ref(parents_[b])
                    .compare_exchange_strong(expected, a, std::memory_order_relaxed)) {
                return;
            }
        }
    }

  private:
    std::uint32_t load(std::uint32_t member)
    {
        return std::atomic_ref(parents_[member]).load(std::memory_order_relaxed);
    }

    std::vector<std::uint32_t> parents_;
};

} // namespace vcarve
