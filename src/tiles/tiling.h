#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The width of a tile's margin in spacings of its points, as if these were on a square surface.
inline constexpr double kMarginSpacings = 40.0;

/// An inner node of the tree of a Tiling: positions below `cut` along `axis` are in the first
/// child. A child is another node, or a tile if its number has the highest bit.
struct TilingNode {
    double cut = 0.0;
    std::uint32_t axis = 0;
    std::array<std::uint32_t, 2> children{};
};

/// A division of space into boxes, the tiles, each with about as many points (a k-d tree).
struct Tiling {
    std::vector<TilingNode> nodes;    ///< the root first; none for a single tile
    std::vector<Eigen::Vector3d> low; ///< per tile, the corners of its box; may be infinite
    std::vector<Eigen::Vector3d> high;
    std::vector<double> margins; ///< width of the margin of a tile, in scene units

    std::size_t size() const { return low.size(); }
    /// The tile that contains a position. Cost: O(log tiles).
    std::size_t tile_of(const Eigen::Vector3d& position) const;
    /// The box of a tile with its margin. Points in it take part in the tile's triangulation.
    Eigen::AlignedBox3d region(std::size_t tile) const;
    /// Whether the region of a tile meets the box of another.
    bool are_near(std::size_t tile, std::size_t other) const;
};

/// Divides points into tiles of about as many points each, at most `most`, by cuts across the
/// longest side. Each position represents `one_in` points, so tiles of a sample can have slightly
/// more. More points can also be in a tile if their positions are equal. Ignores invalid positions.
/// Cost: O(positions).
Tiling divide(const std::vector<Eigen::Vector3d>& positions, std::size_t most,
              std::size_t one_in = 1);

/// The indices of the valid positions in each tile, ascending. Cost: O(positions log tiles).
std::vector<std::vector<std::uint32_t>>
points_by_tile(const Tiling& tiling, const std::vector<Eigen::Vector3d>& positions);

/// Whether a segment meets a box, up to rounding.
bool meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

} // namespace vcarve
