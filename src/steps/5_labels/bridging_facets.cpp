#include "steps/5_labels/bridging_facets.h"

#include "base/parallel.h"
#include "steps/4_visibility/face_evidence.h"
#include "steps/5_labels/freed_pieces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kBent = 0.8;   ///< cosine, about 37 degrees: a face so far off stands across
constexpr double kBefore = 0.2; ///< cosine, about 11 degrees above the surface: a cell is before it

/// Whether a face stands across the surface at the corners that know how it runs: at the middle of
/// three, the better of two; one alone tells nothing.
bool stands_across(std::size_t face, const SurfaceNormals& normals)
{
    constexpr double kNoObjection = 1.0;
    return normals.cosines(face, kNoObjection)[1] < kBent;
}

/// Whether a cell lies before the surface at one of its corners.
bool lies_before(const TetMesh& mesh, const Cell& cell, const SurfaceNormals& normals)
{
    Vector3d middle = Vector3d::Zero();
    for (const Index vertex : cell.vertices) {
        middle += 0.25 * mesh.positions[vertex];
    }
    return std::any_of(cell.vertices.begin(), cell.vertices.end(), [&](Index vertex) {
        const Vector3d direction = (middle - mesh.positions[vertex]).normalized();
        return direction.dot(normals.at(vertex)) >= kBefore;
    });
}

/// Looks for bridging facets: all over a boundary at first, then only where it was updated. They
/// are among the large faces that were seen, and a face becomes one of these only where faces at
/// its corners changed. Keeps references.
class BridgingFacets {
  public:
    BridgingFacets(const TetMesh& cells, const Scene& scene, const BridgingOptions& options)
        : cells_(cells), scene_(scene), size_(options.bridging_edge)
    {
    }

    void look_all_over(const Boundary& boundary)
    {
        large_ = seen_among(boundary, boundary.edges().large_faces(size_));
    }

    /// Looks again after the boundary was updated, since the last look, in these cells.
    void look_around(const Boundary& boundary, const std::vector<Index>& changed_cells);

    /// The cells behind the bridging facets that are there now.
    std::vector<Index> cells_behind(const Boundary& boundary) const;

  private:
    std::vector<std::uint32_t> seen_among(const Boundary& boundary,
                                          const std::vector<std::uint32_t>& faces) const;

    const TetMesh& cells_;
    const Scene& scene_;
    double size_;                      ///< of large faces, at least
    std::vector<std::uint32_t> large_; ///< and seen
};

std::vector<std::uint32_t> BridgingFacets::seen_among(const Boundary& boundary,
                                                      const std::vector<std::uint32_t>& faces) const
{
    const auto look = [&](std::size_t i, std::vector<std::uint32_t>& found) {
        const std::uint32_t face = faces[i];
        const bool is_large =
            boundary.is_there(face) && boundary.edges().relative_size(face) >= size_;
        if (is_large && is_seen(scene_, boundary.faces()[face], boundary.normals().of(face)))
            found.push_back(face);
    };
    return parallel_collect<std::uint32_t>(faces.size(), look, 64);
}

void BridgingFacets::look_around(const Boundary& boundary, const std::vector<Index>& changed_cells)
{
    std::vector<std::uint32_t> faces = std::move(large_);
    for (const Index cell : changed_cells) {
        for (const Index vertex : cells_.cells[cell].vertices) {
            if (vertex == kInfinite) continue;
            std::ranges::copy(boundary.edges().faces_at()[vertex], std::back_inserter(faces));
        }
    }
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    large_ = seen_among(boundary, faces);
}

std::vector<Index> BridgingFacets::cells_behind(const Boundary& boundary) const
{
    const auto doubt = [&](std::size_t i, std::vector<Index>& doubted) {
        const std::uint32_t face = large_[i];
        const Index behind = boundary.facets()[face].cell;
        if (stands_across(face, boundary.normals()) &&
            lies_before(cells_, cells_.cells[behind], boundary.normals()))
            doubted.push_back(behind);
    };
    return parallel_collect<Index>(large_.size(), doubt, 64);
}

} // namespace

std::vector<Index> cells_behind_bridging_facets(const TetMesh& cells, const Boundary& boundary,
                                                const Scene& scene, const BridgingOptions& options)
{
    if (options.bridging_edge == 0.0) return {};
    BridgingFacets facets(cells, scene, options);
    facets.look_all_over(boundary);
    return facets.cells_behind(boundary);
}

DoubtedLabels doubt_bridging_facets(const TetMesh& cells, const Scene& scene, MinimumCut& cut,
                                    const DoubtOptions& options, const Progress& progress)
{
    constexpr int kRounds = 3; // behind a bridging facet there may be another
    DoubtedLabels result{.labelling = {cells, cut.labels()}};
    if (options.bridging.bridging_edge == 0.0) return result;
    Labelling& labelling = result.labelling;
    BridgingFacets bridging(cells, scene, options.bridging);
    bridging.look_all_over(labelling.boundary());
    for (int round = 0; round < kRounds; ++round) {
        progress.tell(round, kRounds);
        const std::vector<Index> doubted = bridging.cells_behind(labelling.boundary());
        if (doubted.empty()) break;
        progress.tell(round + 0.3, kRounds);
        cut.add_source_capacity(doubted, options.one_sight);
        progress.tell(round + 0.6, kRounds);
        result.doubts += static_cast<std::int64_t>(doubted.size());
        const Labels freed = cut.labels();
        progress.tell(round + 0.7, kRounds);
        FreedPieces pieces(cells, scene, labelling.labels(), freed);
        if (pieces.empty())
            continue; // more source capacity only frees cells, so the labels are the same
        pieces.take_away(labelling.boundary());
        labelling.set(pieces.cells(), Label::outside);
        pieces.lay_open(labelling.boundary());
        progress.tell(round + 0.9, kRounds);
        const std::vector<Index> unpaid = pieces.unpaid();
        labelling.set(unpaid, Label::inside);
        result.taken_back += static_cast<std::int64_t>(unpaid.size());
        bridging.look_around(labelling.boundary(), pieces.cells());
    }
    return result;
}

} // namespace vcarve
