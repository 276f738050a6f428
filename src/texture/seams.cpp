#include "texture/seams.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "mesh/vertices.h"
#include "model/colors.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <map>
#include <queue>
#include <set>
#include <tuple>

namespace vcarve {

namespace {

using Eigen::Array3f;

constexpr double kWidthPx = 16.0; ///< of the blend on each side of a seam, in texels

/// A vertex of faces of one photograph, and another photograph that is blended in there.
using Through = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>; ///< vertex, photo, other

/// The distance to the seam, and the offset of the other photograph's colors.
struct Near {
    double distance_px;
    Array3f level;
};

struct Waiting {
    double distance_px;
    Through through;
    Array3f level;

    /// Nearest first. `through` breaks ties, so that the result is deterministic.
    bool operator<(const Waiting& other) const
    {
        return std::tie(distance_px, through) > std::tie(other.distance_px, other.through);
    }
};

class SeamDistances {
  public:
    SeamDistances(const TriMesh& mesh, const std::vector<std::uint32_t>& photo_of_face,
                  const Atlas& atlas)
        : mesh_(mesh),
          photo_of_face_(photo_of_face),
          atlas_(atlas),
          faces_at_(mesh.faces, mesh.positions.size())
    {
    }

    /// Enqueues the vertices where two photographs meet, at distance 0, for both sides.
    void start(const CornerLevels& levels)
    {
        for (std::uint32_t vertex = 0; vertex < mesh_.positions.size(); ++vertex) {
            std::map<std::uint32_t, Array3f> level_of_photo;
            for (const std::uint32_t face : faces_at_[vertex]) {
                if (photo_of_face_[face] == kNoPhoto) continue;
                level_of_photo[photo_of_face_[face]] =
                    levels[face][corner_of(mesh_.faces[face], vertex)];
            }
            for (const auto& [photo, level] : level_of_photo) {
                for (const auto& [other, other_level] : level_of_photo) {
                    if (other != photo) queue_.push({0.0, {vertex, photo, other}, other_level});
                }
            }
        }
    }

    std::map<Through, Near> spread()
    {
        std::map<Through, Near> found;
        while (!queue_.empty()) {
            const Waiting next = queue_.top();
            queue_.pop();
            if (!found.try_emplace(next.through, Near{next.distance_px, next.level}).second)
                continue;
            const auto& [vertex, photo, other] = next.through;
            for (const std::uint32_t face : faces_at_[vertex]) {
                if (photo_of_face_[face] == photo) go_on(face, next);
            }
        }
        return found;
    }

    const VertexFaces& faces_at() const { return faces_at_; }

  private:
    void go_on(std::uint32_t face, const Waiting& from)
    {
        const auto& [vertex, photo, other] = from.through;
        const std::size_t corner = corner_of(mesh_.faces[face], vertex);
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == corner) continue;
            const double distance =
                from.distance_px + (atlas_.corners[face][i] - atlas_.corners[face][corner]).norm();
            if (distance < kWidthPx) {
                queue_.push({distance, {mesh_.faces[face][i], photo, other}, from.level});
            }
        }
    }

    const TriMesh& mesh_;
    const std::vector<std::uint32_t>& photo_of_face_;
    const Atlas& atlas_;
    VertexFaces faces_at_;
    std::priority_queue<Waiting> queue_;
};

/// Blends another photograph into a face that has at least one corner near their seam.
Blend blend_of(const TriMesh& mesh, const std::map<Through, Near>& near, const Atlas& atlas,
               std::uint32_t face, const Through& through)
{
    const auto& [vertex, photo, other] = through;
    Blend blend{face, other, {1.0F, 1.0F, 1.0F}, {}};
    std::array<const Near*, 3> found{};
    Array3f mean = Array3f::Zero();
    float count = 0.0F;
    for (int i = 0; i < 3; ++i) {
        const auto at = near.find({mesh.faces[face][i], photo, other});
        if (at == near.end()) continue;
        found[i] = &at->second;
        mean += at->second.level;
        count += 1.0F;
    }
    for (int i = 0; i < 3; ++i) {
        blend.levels[i] = found[i] != nullptr ? found[i]->level : Array3f(mean / count);
        if (found[i] != nullptr) {
            blend.far[i] = static_cast<float>(found[i]->distance_px / kWidthPx);
            continue;
        }
        // The corner is beyond the blend: measure the distance along the face's edges.
        double distance = 1e30;
        for (int k = 0; k < 3; ++k) {
            if (found[k] == nullptr) continue;
            distance =
                std::min(distance, found[k]->distance_px +
                                       (atlas.corners[face][i] - atlas.corners[face][k]).norm());
        }
        blend.far[i] = static_cast<float>(distance / kWidthPx);
    }
    return blend;
}

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

/// All nodes, sorted and unique, and the node of each corner.
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

/// The color of each node: the mean over its photograph's faces at the vertex.
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

/// The normal equations of the least squares problem.
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
    constexpr double kSmooth = 0.1; // weight of differences between vertices
    constexpr double kSmall = 1e-3; // weight of the offsets
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
        if (corners[0] == corners[1]) continue; // no photograph
        for (int i = 0; i < 3; ++i) {
            equations.add(corners[i], corners[(i + 1) % 3], 0.5 * kSmooth);
        }
    }
    return equations;
}

} // namespace

std::vector<std::vector<Blend>> find_blends(const TriMesh& mesh,
                                            const std::vector<PhotosOfFace>& photos_of_faces,
                                            const std::vector<std::uint32_t>& photo_of_face,
                                            const Atlas& atlas, const CornerLevels& levels)
{
    SeamDistances distances(mesh, photo_of_face, atlas);
    distances.start(levels);
    const std::map<Through, Near> near = distances.spread();
    std::set<std::pair<std::uint32_t, std::uint32_t>> done; // other photograph, face
    std::vector<std::vector<Blend>> blends;
    for (const auto& [through, unused] : near) {
        const auto& [vertex, photo, other] = through;
        for (const std::uint32_t face : distances.faces_at()[vertex]) {
            if (photo_of_face[face] != photo || place_of(photos_of_faces[face], other) < 0 ||
                !done.insert({other, face}).second) {
                continue;
            }
            blends.resize(std::max<std::size_t>(blends.size(), other + 1));
            blends[other].push_back(blend_of(mesh, near, atlas, face, through));
        }
    }
    return blends;
}

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
    if (factors.info() != Eigen::Success) return levels;
    const Eigen::MatrixX3d solution = factors.solve(equations.right);
    if (!solution.allFinite()) return levels;
    parallel_for(mesh.faces.size(), [&](std::size_t face) {
        if (photo_of_face[face] == kNoPhoto) return;
        for (int i = 0; i < 3; ++i) {
            levels[face][i] = solution.row(nodes.of_face[face][i]).transpose().cast<float>();
        }
    });
    return levels;
}

} // namespace vcarve
