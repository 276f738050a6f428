#pragma once

#include <algorithm>
#include <vector>

namespace vcarve {

/// Sorts a list and drops what is in it twice.
template <typename Item>
void sort_unique(std::vector<Item>& items)
{
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

} // namespace vcarve
