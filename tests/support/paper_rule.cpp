#include "support/paper_rule.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using SolidTriangle = std::array<Vector3d, 3>;

constexpr double kTolerance = 0.01;

/// A triangle and a point of its plane, projected along the axis nearest its normal.
struct Projected {
    std::array<Vector2d, 3> corners;
    Vector2d hit;
};

Projected projected(const SolidTriangle& triangle, const Vector3d& normal, const Vector3d& hit)
{
    int dropped = 0;
    normal.cwiseAbs().maxCoeff(&dropped);
    const int x = (dropped + 1) % 3;
    const int y = (dropped + 2) % 3;
    Projected result{{}, {hit[x], hit[y]}};
    for (int i = 0; i < 3; ++i) {
        result.corners[i] = {triangle[i][x], triangle[i][y]};
    }
    return result;
}

double angle_between(const Vector2d& a, const Vector2d& b)
{
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// Marks a point of a triangle's plane by the angles at it.
Mark mark_by_angles(const Projected& seen)
{
    double sum = 0.0;
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double angle =
            angle_between(seen.corners[i] - seen.hit, seen.corners[(i + 1) % 3] - seen.hit);
        sum += angle;
        largest = std::max(largest, angle);
    }
    // An edge subtends half a turn only at points on it.
    if (largest > std::numbers::pi - kTolerance) {
        return Mark::unclear;
    }
    return std::abs(sum - 2.0 * std::numbers::pi) < kTolerance ? Mark::redundant : Mark::none;
}

Mark mark(const SolidTriangle& triangle, const Vector3d& point, const Vector3d& center)
{
    const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const double share =
        normal.dot(triangle[0] - point) / normal.dot(center - point); // 0 at point, 1 at center
    constexpr double kClose = 1e-9;
    if (std::isnan(share)) {
        return Mark::unclear; // the ray lies in the plane
    }
    if (share < -kClose || share > 1.0 + kClose) {
        return Mark::none;
    }
    const Mark by_angles =
        mark_by_angles(projected(triangle, normal, point + share * (center - point)));
    const bool ends_in_plane = std::abs(share) < kClose || std::abs(share - 1.0) < kClose;
    return ends_in_plane && by_angles == Mark::redundant ? Mark::unclear : by_angles;
}

} // namespace

std::vector<std::array<Mark, 4>> marks_by_paper_rule(const TetMesh& mesh, const Scene& scene)
{
    std::vector<std::array<Mark, 4>> marks(mesh.cells.size(),
                                           {Mark::none, Mark::none, Mark::none, Mark::none});
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4 && !mesh.cells[cell].is_infinite(); ++slot) {
            std::array<Index, 3> corners{};
            SolidTriangle triangle;
            for (int i = 0; i < 3; ++i) {
                corners[i] = mesh.cells[cell].vertices[kFacetCorners[slot][i]];
                triangle[i] = mesh.positions[corners[i]];
            }
            for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
                if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) {
                    continue;
                }
                for (const std::uint32_t view : scene.tracks[vertex]) {
                    const Vector3d& center = scene.views[view].center;
                    const Mark found = mark(triangle, mesh.positions[vertex], center);
                    marks[cell][slot] = std::max(marks[cell][slot], found);
                }
            }
        }
    }
    return marks;
}

} // namespace vcarve
