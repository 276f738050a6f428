#include "geometry/point_order.h"

#include "base/parallel.h"

#include <CGAL/hilbert_sort.h>

#include <algorithm>
#include <tuple>

namespace vcarve {

namespace {

using Eigen::Vector3d;

struct Placed {
    Vector3d place;
    std::uint32_t point;
};

/// Compares points along an axis. Ties are broken by the other axes, so that the order does not
/// depend on the input order.
template <int kAxis>
struct LessAlong {
    bool operator()(const Placed& a, const Placed& b) const
    {
        const auto key = [](const Vector3d& p) {
            return std::tie(p[kAxis], p[(kAxis + 1) % 3], p[(kAxis + 2) % 3]);
        };
        return key(a.place) < key(b.place);
    }
};

/// The traits of CGAL's sort.
struct SortTraits {
    // NOLINTBEGIN(readability-identifier-naming): CGAL's names.
    using Point_3 = Placed;
    using Less_x_3 = LessAlong<0>;
    using Less_y_3 = LessAlong<1>;
    using Less_z_3 = LessAlong<2>;
    // NOLINTEND(readability-identifier-naming)
    Less_x_3 less_x_3_object() const { return {}; }
    Less_y_3 less_y_3_object() const { return {}; }
    Less_z_3 less_z_3_object() const { return {}; }
};

} // namespace

std::vector<std::uint32_t> hilbert_order(const std::vector<Vector3d>& positions)
{
    std::vector<Placed> points(positions.size());
    parallel_for(points.size(), [&](std::size_t i) {
        points[i] = {positions[i], static_cast<std::uint32_t>(i)};
    });
    CGAL::hilbert_sort<CGAL::Parallel_if_available_tag>(points.begin(), points.end(), SortTraits());
    std::vector<std::uint32_t> order(points.size());
    parallel_for(order.size(), [&](std::size_t i) { order[i] = points[i].point; });
    return order;
}

std::vector<std::uint32_t> lexicographic_sort(const std::vector<Eigen::Vector3d>& positions)
{
    // x is stored beside the index, so that most comparisons need no other memory.
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
