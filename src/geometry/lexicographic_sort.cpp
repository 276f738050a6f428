#include "geometry/lexicographic_sort.h"

#include "base/parallel_sort.h"

#include <algorithm>
#include <tuple>

namespace vcarve {

std::vector<std::uint32_t> lexicographic_sort(const std::vector<Eigen::Vector3d>& positions)
{
    // The first coordinate sits beside the index, so that sorting seldom looks elsewhere.
    struct Entry {
        double x;
        std::uint32_t index;
    };
    std::vector<Entry> entries;
    entries.reserve(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        if (positions[i].allFinite()) {
            entries.push_back({positions[i].x(), i});
        }
    }
    parallel_sort(entries, [&](const Entry& a, const Entry& b) {
        if (a.x != b.x) {
            return a.x < b.x;
        }
        const Eigen::Vector3d& p = positions[a.index];
        const Eigen::Vector3d& q = positions[b.index];
        return std::tie(p.y(), p.z(), a.index) < std::tie(q.y(), q.z(), b.index);
    });
    std::vector<std::uint32_t> order(entries.size());
    std::transform(entries.begin(), entries.end(), order.begin(),
                   [](const Entry& entry) { return entry.index; });
    return order;
}

} // namespace vcarve
