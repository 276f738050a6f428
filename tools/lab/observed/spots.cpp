#include "observed/spots.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve::observed {

using Eigen::Vector3d;

Spots::Spots(const render::Parts& parts, Spread spread) : parts_(parts)
{
    double sum = 0.0;
    for (std::size_t face = 0; face < parts.mesh.faces.size(); ++face) {
        const double contrast = spread == Spread::area ? 1.0 : paint_of(face).contrast;
        sum += normal_of(face).norm() * contrast;
        sums_.push_back(sum);
    }
}

Spot Spots::draw(bench::Random& random) const
{
    const double sum = random.uniform(0.0, sums_.back());
    const auto found = std::ranges::upper_bound(sums_, sum);
    const auto face = static_cast<std::size_t>(found - sums_.begin());
    double to_second = random.uniform();
    double to_third = random.uniform();
    if (to_second + to_third > 1.0) {
        to_second = 1.0 - to_second;
        to_third = 1.0 - to_third;
    }
    const auto& [a, b, c] = corners_of(face);
    return {a + to_second * (b - a) + to_third * (c - a), normal_of(face).normalized(),
            paint_of(face)};
}

std::array<Vector3d, 3> Spots::corners_of(std::size_t face) const
{
    const auto& [a, b, c] = parts_.mesh.faces[face];
    const auto& positions = parts_.mesh.positions;
    return {positions[a], positions[b], positions[c]};
}

Vector3d Spots::normal_of(std::size_t face) const
{
    const auto [a, b, c] = corners_of(face);
    return (b - a).cross(c - a);
}

const render::Paint& Spots::paint_of(std::size_t face) const
{
    return parts_.paint_of_part[parts_.part_of_face[face]];
}

} // namespace vcarve::observed
