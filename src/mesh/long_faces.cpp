#include "mesh/long_faces.h"

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/triangle.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vcarve {

namespace {

std::array<double, 3> edge_lengths(const TriMesh& mesh, const Face& face)
{
    const auto length = [&](int from, int to) {
        return (mesh.positions[face[to]] - mesh.positions[face[from]]).norm();
    };
    return {length(0, 1), length(1, 2), length(2, 0)};
}

double usual_edge(const TriMesh& mesh)
{
    constexpr std::size_t kFaces = 4096;
    const std::size_t count = std::min(mesh.faces.size(), kFaces);
    std::vector<double> lengths;
    lengths.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const Face& face = mesh.faces[i * mesh.faces.size() / count];
        std::ranges::copy(edge_lengths(mesh, face), std::back_inserter(lengths));
    }
    return median(std::move(lengths));
}

struct Areas {
    double all = 0.0;
    double of_long = 0.0;
};

} // namespace

double long_area(const TriMesh& mesh, double times)
{
    if (mesh.faces.empty()) return 0.0;
    const double most = times * usual_edge(mesh);
    const auto areas_of = [&](std::size_t i) {
        const Face& face = mesh.faces[i];
        const double area = face_area(mesh.positions, face);
        const bool is_long = longest_edge(mesh.positions, face) > most;
        return Areas{.all = area, .of_long = is_long ? area : 0.0};
    };
    const auto plus = [](const Areas& a, const Areas& b) {
        return Areas{.all = a.all + b.all, .of_long = a.of_long + b.of_long};
    };
    const Areas sum = parallel_sum(mesh.faces.size(), Areas(), areas_of, plus);
    return sum.all > 0.0 ? sum.of_long / sum.all : 0.0;
}

} // namespace vcarve
