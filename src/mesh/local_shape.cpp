#include "mesh/local_shape.h"

#include "base/statistics.h"
#include "geometry/triangle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace vcarve {

using Eigen::Vector3d;

LocalEdges::LocalEdges(std::span<const Vector3d> positions, const std::vector<Face>& faces,
                       const FaceFlags& measured)
    : positions_(positions),
      faces_(faces),
      faces_at_(faces, positions.size(), measured),
      medians_(positions.size(), -1.0)
{
}

void LocalEdges::collect_squared_lengths(std::uint32_t vertex,
                                         std::vector<double>& lengths_sq) const
{
    for (const std::uint32_t face : faces_at_[vertex]) {
        const auto& [a, b, c] = faces_[face];
        lengths_sq.insert(lengths_sq.end(),
                          {squared_length(a, b), squared_length(b, c), squared_length(c, a)});
    }
}

double LocalEdges::median(std::uint32_t vertex) const
{
    const std::atomic_ref<double> known(medians_[vertex]);
    const double found = known.load(std::memory_order_relaxed);
    if (found >= 0.0) return found;
    std::vector<double> lengths_sq;
    collect_squared_lengths(vertex, lengths_sq);
    const double median = std::sqrt(median_in_place(lengths_sq)); // the root is monotonic
    known.store(median, std::memory_order_relaxed); // other threads store the same value
    return median;
}

double LocalEdges::longest_edge(std::size_t face) const
{
    const auto& [a, b, c] = faces_[face];
    return std::sqrt(std::max({squared_length(a, b), squared_length(b, c), squared_length(c, a)}));
}

double LocalEdges::relative_size(std::size_t face) const
{
    const auto& [a, b, c] = faces_[face];
    std::array<double, 3> scales = {median(a), median(b), median(c)};
    std::sort(scales.begin(), scales.end());
    return longest_edge(face) / scales[1];
}

Vector3d SurfaceNormals::of(std::size_t face) const
{
    return face_normal(positions_, faces_[face]);
}

Vector3d SurfaceNormals::at(std::uint32_t vertex) const
{
    constexpr double kSmall = 2.0; // relative size
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t face : edges_.faces_at()[vertex]) {
        const Vector3d normal = of(face);
        if (edges_.relative_size(face) < kSmall && normal.allFinite()) sum += normal;
    }
    return sum.normalized(); // zero stays zero
}

std::array<double, 3> SurfaceNormals::cosines(std::size_t face, double unknown) const
{
    const Vector3d normal = of(face);
    std::array<double, 3> cosines{};
    std::ranges::transform(faces_[face], cosines.begin(), [&](std::uint32_t vertex) {
        const Vector3d around = at(vertex);
        return around.isZero() ? unknown : normal.dot(around);
    });
    std::ranges::sort(cosines);
    return cosines;
}

bool continues_surface(std::size_t face, const SurfaceNormals& normals)
{
    constexpr double kContinuing = 0.9; // cosine, about 26 degrees
    constexpr double kUnknown = -1.0;
    return normals.cosines(face, kUnknown)[2] >= kContinuing;
}

} // namespace vcarve
