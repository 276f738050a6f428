#include "compare/sample.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "geometry/triangle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

/// ends[i] is the area of the faces up to and including i. A face that is not finite has none.
std::vector<double> cumulated_areas(const TriMesh& mesh)
{
    std::vector<double> ends;
    ends.reserve(mesh.faces.size());
    double sum = 0.0;
    for (const Face& face : mesh.faces) {
        const double area = face_area(mesh.positions, face);
        sum += std::isfinite(area) ? area : 0.0;
        ends.push_back(sum);
    }
    return ends;
}

/// Uniform in the triangle (Osada et al. 2002).
Eigen::Vector3d point_in_face(const TriMesh& mesh, const Face& face, double u, double v)
{
    const double root = std::sqrt(u);
    return (1.0 - root) * mesh.positions[face[0]] + root * (1.0 - v) * mesh.positions[face[1]] +
           root * v * mesh.positions[face[2]];
}

} // namespace

SurfaceSamples sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed)
{
    const std::vector<double> ends = cumulated_areas(mesh);
    SurfaceSamples samples;
    if (ends.empty() || ends.back() <= 0.0) return samples;
    samples.positions.resize(count);
    samples.faces.resize(count);
    const double step = ends.back() / static_cast<double>(count);
    parallel_for(count, [&](std::size_t i) {
        // The face that holds this sample's part of the area.
        const double area = (static_cast<double>(i) + random_number(seed, 3 * i)) * step;
        auto end = std::upper_bound(ends.begin(), ends.end(), area);
        if (end == ends.end()) end = std::lower_bound(ends.begin(), ends.end(), ends.back());
        const auto face = static_cast<std::size_t>(end - ends.begin());
        // A random place on it.
        const double u = random_number(seed, 3 * i + 1);
        const double v = random_number(seed, 3 * i + 2);
        samples.positions[i] = point_in_face(mesh, mesh.faces[face], u, v);
        samples.faces[i] = static_cast<std::uint32_t>(face);
    });
    return samples;
}

} // namespace vcarve
