#include "texture/seam_levels.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "model/colors.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace vcarve {

namespace {

using Eigen::Array3f;
using Triplet = Eigen::Triplet<double>;

/// A vertex in the photograph that covers faces at it.
struct Node {
    std::uint32_t vertex;
    std::uint32_t photo;

    bool operator==(const Node&) const = default;
    bool operator<(const Node& other) const
    {
        return std::tie(vertex, photo) < std::tie(other.vertex, other.photo);
    }
};

/// All of them, each once, in order; and which one each corner is.
struct Nodes {
    std::vector<Node> all;
    std::vector<std::array<std::uint32_t, 3>> of_face;
};

Nodes gather_nodes(const TriMesh& mesh, const std::vector<std::uint32_t>& photo_of_face)
{
    Nodes nodes;
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
        if (photo_of_face[face] == kNoPhoto) continue;
        for (const std::uint32_t vertex : mesh.faces[face]) {
            nodes.all.push_back({vertex, photo_of_face[face]});
        }
    }
    sort_unique(nodes.all);
    nodes.of_face.resize(mesh.faces.size());
    parallel_for(mesh.faces.size(), [&](std::size_t face) {
        if (photo_of_face[face] == kNoPhoto) return;
        for (int i = 0; i < 3; ++i) {
            const Node node = {mesh.faces[face][i], photo_of_face[face]};
            nodes.of_face[face][i] = static_cast<std::uint32_t>(
                std::lower_bound(nodes.all.begin(), nodes.all.end(), node) - nodes.all.begin());
        }
    });
    return nodes;
}

/// What the photographs show at their nodes, the mean over the faces there.
std::vector<Eigen::Array3d> colors_of(const Nodes& nodes,
                                      const std::vector<PhotosOfFace>& photos_of_faces,
                                      const FaceColors& colors, const Gains& gains,
                                      const std::vector<std::uint32_t>& photo_of_face)
{
    std::vector<Eigen::Array3d> sums(nodes.all.size(), Eigen::Array3d::Zero());
    std::vector<double> counts(nodes.all.size());
    for (std::size_t face = 0; face < photo_of_face.size(); ++face) {
        const std::uint32_t photo = photo_of_face[face];
        if (photo == kNoPhoto) continue;
        const int place = place_of(photos_of_faces[face], photo);
        for (int i = 0; i < 3; ++i) {
            const Color& color = colors[face][static_cast<std::size_t>(place)][i];
            const std::uint32_t node = nodes.of_face[face][i];
            sums[node] += channels_of(color).cast<double>() * gains[photo].cast<double>();
            counts[node] += 1.0;
        }
    }
    for (std::size_t node = 0; node < sums.size(); ++node) {
        sums[node] /= counts[node];
    }
    return sums;
}

/// The normal equations of the least squares.
struct Equations {
    std::vector<Triplet> entries;
    Eigen::MatrixX3d right;

    void add(std::uint32_t a, std::uint32_t b, double weight)
    {
        entries.emplace_back(a, a, weight);
        entries.emplace_back(b, b, weight);
        entries.emplace_back(a, b, -weight);
        entries.emplace_back(b, a, -weight);
    }
};

Equations equations_of(const Nodes& nodes, const std::vector<Eigen::Array3d>& shown)
{
    constexpr double kSmooth = 0.1; // of a change from vertex to vertex
    constexpr double kSmall = 1e-3; // of what is added
    Equations equations;
    const std::size_t count = nodes.all.size();
    equations.right = Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(count), 3);
    for (std::uint32_t first = 0; first < count; ++first) {
        equations.entries.emplace_back(first, first, kSmall);
        for (std::uint32_t next = first + 1;
             next < count && nodes.all[next].vertex == nodes.all[first].vertex; ++next) {
            equations.add(first, next, 1.0);
            const Eigen::Array3d difference = shown[next] - shown[first];
            equations.right.row(first) += difference.matrix().transpose();
            equations.right.row(next) -= difference.matrix().transpose();
        }
    }
    for (const auto& corners : nodes.of_face) {
        if (corners[0] == corners[1]) continue; // none
        for (int i = 0; i < 3; ++i) {
            equations.add(corners[i], corners[(i + 1) % 3], 0.5 * kSmooth);
        }
    }
    return equations;
}

} // namespace

int place_of(const PhotosOfFace& photos, std::uint32_t photo)
{
    const auto shown = photos.shown();
    const auto found = std::ranges::find(shown, photo, &PhotoOfFace::photo);
    return found == shown.end() ? -1 : static_cast<int>(found - shown.begin());
}

CornerLevels level_seams(const TriMesh& mesh, const std::vector<PhotosOfFace>& photos_of_faces,
                         const FaceColors& colors, const Gains& gains,
                         const std::vector<std::uint32_t>& photo_of_face)
{
    CornerLevels levels(mesh.faces.size(), {Array3f::Zero(), Array3f::Zero(), Array3f::Zero()});
    const Nodes nodes = gather_nodes(mesh, photo_of_face);
    if (nodes.all.empty()) return levels;
    const Equations equations =
        equations_of(nodes, colors_of(nodes, photos_of_faces, colors, gains, photo_of_face));
    const auto count = static_cast<Eigen::Index>(nodes.all.size());
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(equations.entries.begin(), equations.entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::MatrixX3d solution = factors.solve(equations.right);
    parallel_for(mesh.faces.size(), [&](std::size_t face) {
        if (photo_of_face[face] == kNoPhoto) return;
        for (int i = 0; i < 3; ++i) {
            levels[face][i] = solution.row(nodes.of_face[face][i]).transpose().cast<float>();
        }
    });
    return levels;
}

} // namespace vcarve
