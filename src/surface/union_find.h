#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace vcarve {

/// Disjoint sets of the numbers below `size`. The root of a set is its least member, whatever the
/// order of the joins, so that results do not depend on it.
class UnionFind {
  public:
    explicit UnionFind(std::size_t size) : parents_(size)
    {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    std::uint32_t root(std::uint32_t member)
    {
        while (parents_[member] != member) {
            parents_[member] = parents_[parents_[member]];
            member = parents_[member];
        }
        return member;
    }

    void join(std::uint32_t a, std::uint32_t b)
    {
        a = root(a);
        b = root(b);
        if (a > b) std::swap(a, b);
        parents_[b] = a;
    }

  private:
    std::vector<std::uint32_t> parents_;
};

} // namespace vcarve
