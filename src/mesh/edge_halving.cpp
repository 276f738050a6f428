#include "mesh/edge_halving.h"

#include "mesh/vertices.h"

#include <Eigen/Core>

#include <utility>

namespace vcarve {

std::array<std::uint32_t, 2> longest_edge_of(std::span<const Eigen::Vector3d> positions,
                                             const Face& face)
{
    constexpr double kEqual = 1.0 - 1e-9; // lengths that differ only by rounding are equal
    const auto squared_length = [&](std::size_t i) {
        return (positions[face[i]] - positions[face[(i + 1) % 3]]).squaredNorm();
    };
    const double longest = std::max({squared_length(0), squared_length(1), squared_length(2)});
    std::array<std::uint32_t, 2> found = {face[0], face[0]};
    bool is_found = false;
    for (std::size_t i = 0; i < 3; ++i) {
        if (squared_length(i) < kEqual * longest) continue;
        const auto [a, b] = std::minmax(face[i], face[(i + 1) % 3]);
        const std::array edge = {a, b};
        if (!is_found || edge < found) found = edge;
        is_found = true;
    }
    return found;
}

EdgeHalving::EdgeHalving(TriMesh& mesh, const FaceFlags& flags)
    : mesh_(mesh),
      num_vertices_(mesh.positions.size()),
      faces_at_first_(mesh.faces, mesh.positions.size(), flags)
{
}

std::vector<std::uint32_t>& EdgeHalving::faces_at(std::uint32_t vertex)
{
    const auto [row, is_new] = faces_at_.try_emplace(vertex);
    if (is_new && vertex < num_vertices_) {
        const auto first = faces_at_first_[vertex];
        row->second.assign(first.begin(), first.end());
    }
    return row->second;
}

std::vector<EdgeHalving::HalvedFace> EdgeHalving::halve(std::uint32_t a, std::uint32_t b)
{
    Halving halving = {{a, b}, add_midpoint(mesh_, a, b), {}, {}};
    std::vector<std::uint32_t>& at_middle = faces_at(halving.middle);
    std::vector<std::uint32_t>& at_b = faces_at(b);
    for (const std::uint32_t face : faces_at(a)) {
        const Face whole = mesh_.faces[face];
        if (std::ranges::count(whole, b) == 0) continue;
        const auto other_half = static_cast<std::uint32_t>(mesh_.faces.size());
        mesh_.faces[face] = with(whole, b, halving.middle);
        mesh_.faces.push_back(with(whole, a, halving.middle));
        at_middle.insert(at_middle.end(), {face, other_half});
        std::ranges::replace(at_b, face, other_half);
        const Face from_a = turned_to(whole, a);
        const std::uint32_t across = from_a[1] == b ? from_a[2] : from_a[1];
        faces_at(across).push_back(other_half);
        halving.halved.push_back({face, other_half});
        halving.whole.push_back(whole);
    }
    done_.push_back(std::move(halving));
    return done_.back().halved;
}

/// Whether the halves of a bisection are unchanged.
bool EdgeHalving::is_as_left(const Halving& halving) const
{
    const auto [a, b] = halving.edge;
    for (std::size_t i = 0; i < halving.halved.size(); ++i) {
        const Face& whole = halving.whole[i];
        if (mesh_.faces[halving.halved[i].face] != with(whole, b, halving.middle) ||
            mesh_.faces[halving.halved[i].other_half] != with(whole, a, halving.middle)) {
            return false;
        }
    }
    return true;
}

} // namespace vcarve
