#include "tiles/tiling.h"

#include "model/extent.h"
#include "model/scene_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>

namespace vcarve {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr std::uint32_t kTile = 0x80000000U;

/// The width of the margin of a tile. Each of these points represents `one_in` points of the tile.
double margin_of(const std::vector<Vector3d>& points, std::size_t one_in)
{
    constexpr double kTail = 0.02;
    Vector3d sides = middle_box(points, kTail).sizes();
    std::ranges::sort(sides);
    return kMarginSpacings *
           std::sqrt(sides[2] * sides[1] / static_cast<double>(one_in * points.size()));
}

class Divider {
  public:
    /// Each position represents `one_in` points.
    Divider(const std::vector<Vector3d>& positions, std::size_t most, std::size_t one_in)
        : positions_(positions), most_(std::max<std::size_t>(most / one_in, 1)), one_in_(one_in)
    {
    }

    Tiling divide()
    {
        std::vector<std::uint32_t> all(positions_.size());
        std::iota(all.begin(), all.end(), 0U);
        const Vector3d infinite = Vector3d::Constant(std::numeric_limits<double>::infinity());
        add(all, {-infinite, infinite});
        return std::move(tiling_);
    }

  private:
    /// Adds the tiles of some points, whose box is given. Returns the number of the node.
    std::uint32_t add(std::span<std::uint32_t> points, const AlignedBox3d& box)
    {
        std::vector<Vector3d> places;
        places.reserve(points.size());
        for (const std::uint32_t point : points) {
            places.push_back(positions_[point]);
        }
        const std::size_t node = tiling_.nodes.size();
        const std::size_t tiles = (places.size() + most_ - 1) / most_; // about as many points each
        const TilingNode made = node_of(places, tiles);
        const auto first = [&](std::uint32_t point) {
            return positions_[point][made.axis] < made.cut;
        };
        if (places.size() <= most_ || std::ranges::none_of(points, first)) {
            tiling_.low.push_back(box.min());
            tiling_.high.push_back(box.max());
            tiling_.margins.push_back(places.empty() ? 0.0 : margin_of(places, one_in_));
            return kTile | static_cast<std::uint32_t>(tiling_.size() - 1);
        }
        std::vector<Vector3d>().swap(places);
        tiling_.nodes.push_back(made);
        const auto middle = std::partition(points.begin(), points.end(), first);
        AlignedBox3d low = box;
        AlignedBox3d high = box;
        low.max()[made.axis] = made.cut;
        high.min()[made.axis] = made.cut;
        const std::uint32_t below = add({points.begin(), middle}, low);
        const std::uint32_t above = add({middle, points.end()}, high);
        tiling_.nodes[node].children = {below, above};
        return static_cast<std::uint32_t>(node);
    }

    /// A cut between the lower half of the tiles and the upper one.
    static TilingNode node_of(const std::vector<Vector3d>& places, std::size_t tiles)
    {
        constexpr double kTail = 0.02; // a few far points do not count
        TilingNode node;
        if (places.empty()) return node;
        int axis = 0;
        middle_box(places, kTail).sizes().maxCoeff(&axis);
        std::vector<double> along(places.size());
        std::ranges::transform(places, along.begin(), [&](const auto& p) { return p[axis]; });
        const std::size_t below = tiles < 2 ? 0 : along.size() * (tiles / 2) / tiles;
        const auto middle = along.begin() + static_cast<std::ptrdiff_t>(below);
        std::nth_element(along.begin(), middle, along.end());
        node.axis = static_cast<std::uint32_t>(axis);
        node.cut = *middle;
        return node;
    }

    const std::vector<Vector3d>& positions_;
    std::size_t most_;
    std::size_t one_in_;
    Tiling tiling_;
};

} // namespace

std::size_t Tiling::tile_of(const Vector3d& position) const
{
    std::uint32_t at = nodes.empty() ? kTile : 0;
    while ((at & kTile) == 0) {
        const TilingNode& node = nodes[at];
        at = node.children[position[node.axis] < node.cut ? 0 : 1];
    }
    return at & ~kTile;
}

AlignedBox3d Tiling::region(std::size_t tile) const
{
    return {low[tile].array() - margins[tile], high[tile].array() + margins[tile]};
}

bool Tiling::are_near(std::size_t tile, std::size_t other) const
{
    return region(tile).intersects(AlignedBox3d(low[other], high[other]));
}

Tiling divide(const std::vector<Vector3d>& positions, std::size_t most, std::size_t one_in)
{
    std::vector<Vector3d> valid;
    std::ranges::copy_if(positions, std::back_inserter(valid), is_valid_position);
    return Divider(valid, most, one_in).divide();
}

std::vector<std::vector<std::uint32_t>> points_by_tile(const Tiling& tiling,
                                                       const std::vector<Vector3d>& positions)
{
    std::vector<std::vector<std::uint32_t>> points(tiling.size());
    for (std::uint32_t point = 0; point < positions.size(); ++point) {
        if (is_valid_position(positions[point]))
            points[tiling.tile_of(positions[point])].push_back(point);
    }
    return points;
}

bool meets(const AlignedBox3d& box, const Vector3d& from, const Vector3d& to)
{
    double begin = 0.0;
    double end = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double way = to[axis] - from[axis];
        if (way == 0.0) {
            if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) return false;
            continue;
        }
        const auto [low, high] = std::minmax(
            {(box.min()[axis] - from[axis]) / way, (box.max()[axis] - from[axis]) / way});
        begin = std::max(begin, low);
        end = std::min(end, high);
    }
    return begin <= end;
}

} // namespace vcarve
