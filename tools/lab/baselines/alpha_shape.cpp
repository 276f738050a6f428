#include "baselines/alpha_shape.h"

#include "base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vcarve {

namespace {

std::vector<double> radii_of(const TetMesh& cells)
{
    std::vector<double> radii(cells.cells.size());
    parallel_for(radii.size(), [&](std::size_t i) {
        radii[i] = circumsphere(cells, static_cast<Index>(i)).radius;
    });
    return radii;
}

/// An alpha shape that grows cell by cell and detects when it is whole.
class GrowingSolid {
  public:
    explicit GrowingSolid(const TetMesh& cells)
        : cells_(cells),
          parents_(cells.cells.size(), kOutside),
          is_covered_(cells.positions.size(), 0),
          uncovered_(cells.positions.size())
    {
    }

    void take(Index cell)
    {
        parents_[cell] = cell;
        ++pieces_;
        for (int slot = 0; slot < 4; ++slot) {
            cover(cells_.cells[cell].vertices[slot]);
            const Index neighbor = cells_.cells[cell].neighbors[slot];
            if (parents_[neighbor] != kOutside) join(cell, neighbor);
        }
    }

    bool is_whole() const { return uncovered_ == 0 && pieces_ == 1; }

  private:
    static constexpr Index kOutside = 0xffffffffU;

    void cover(Index vertex)
    {
        uncovered_ -= is_covered_[vertex] == 0 ? 1 : 0;
        is_covered_[vertex] = 1;
    }

    Index root(Index cell)
    {
        while (parents_[cell] != cell) {
            parents_[cell] = parents_[parents_[cell]];
            cell = parents_[cell];
        }
        return cell;
    }

    void join(Index a, Index b)
    {
        const Index root_a = root(a);
        const Index root_b = root(b);
        if (root_a == root_b) return;
        parents_[std::max(root_a, root_b)] = std::min(root_a, root_b);
        --pieces_;
    }

    const TetMesh& cells_;
    std::vector<Index> parents_; ///< union-find trees of components; a root is its own parent
    std::vector<char> is_covered_;
    std::size_t uncovered_;
    std::size_t pieces_ = 0;
};

} // namespace

Labels alpha_shape(const TetMesh& cells, double alpha)
{
    const std::vector<double> radii = radii_of(cells);
    Labels labels(radii.size(), Label::outside);
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (!cells.cells[i].is_infinite() && radii[i] <= alpha) labels[i] = Label::inside;
    }
    return labels;
}

double smallest_whole_alpha(const TetMesh& cells)
{
    const std::vector<double> radii = radii_of(cells);
    std::vector<Index> order(radii.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::sort(order, {}, [&](Index cell) { return std::pair(radii[cell], cell); });

    GrowingSolid solid(cells);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double radius = radii[order[i]];
        if (radius == std::numeric_limits<double>::infinity()) break;
        solid.take(order[i]);
        // Add all cells of one radius before the test.
        const bool last_of_radius = i + 1 == order.size() || radii[order[i + 1]] > radius;
        if (last_of_radius && solid.is_whole()) return radius;
    }
    return std::numeric_limits<double>::infinity();
}

Circumsphere circumsphere(const TetMesh& cells, Index cell)
{
    Circumsphere none{Eigen::Vector3d::Zero(), std::numeric_limits<double>::infinity()};
    if (cells.cells[cell].is_infinite()) return none;
    const std::array<Index, 4>& corners = cells.cells[cell].vertices;
    const Eigen::Vector3d& base = cells.positions[corners[0]];
    const Eigen::Vector3d a = cells.positions[corners[1]] - base;
    const Eigen::Vector3d b = cells.positions[corners[2]] - base;
    const Eigen::Vector3d c = cells.positions[corners[3]] - base;
    // The same distance from the base and the three others: x . a = a . a / 2, and so on.
    const Eigen::Vector3d numerator =
        a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
    const Eigen::Vector3d offset = numerator / (2.0 * a.dot(b.cross(c)));
    const double radius = offset.norm();
    if (!std::isfinite(radius)) return none;
    return {base + offset, radius};
}

} // namespace vcarve
