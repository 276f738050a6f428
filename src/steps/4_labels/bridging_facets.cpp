#include "steps/4_labels/bridging_facets.h"

#include "base/parallel.h"
#include "steps/3_visibility/face_evidence.h"
#include "steps/4_labels/freed_pieces.h"

#include <Eigen/Geometry>

#include <algorithm>
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

} // namespace

std::vector<Index> cells_behind_bridging_facets(const TetMesh& cells, const Boundary& boundary,
                                                const Scene& scene, const BridgingOptions& options)
{
    if (options.bridging_edge == 0.0) {
        return {};
    }
    // Few faces are large, so that everything but their size is cheap.
    const SurfaceNormals& normals = boundary.normals();
    const std::vector<std::uint32_t> large = boundary.edges().large_faces(options.bridging_edge);
    const auto doubt = [&](std::size_t i, std::vector<Index>& doubted) {
        const std::uint32_t face = large[i];
        const Index behind = boundary.facets()[face].cell;
        if (boundary.edges().relative_size(face) >= options.bridging_edge &&
            is_seen(scene, boundary.faces()[face], normals.of(face)) &&
            stands_across(face, normals) && lies_before(cells, cells.cells[behind], normals)) {
            doubted.push_back(behind);
        }
    };
    return parallel_collect<Index>(large.size(), doubt, 64);
}

DoubtedLabels doubt_bridging_facets(const TetMesh& cells, const Scene& scene, MinimumCut& cut,
                                    std::int32_t one_sight, const BridgingOptions& options,
                                    const Progress& progress)
{
    constexpr int kRounds = 3; // behind a bridging facet there may be another
    DoubtedLabels result{.labelling = {cells, cut.labels()}};
    Labelling& labelling = result.labelling;
    for (int round = 0; round < kRounds; ++round) {
        progress.tell(round, kRounds);
        const std::vector<Index> doubted =
            cells_behind_bridging_facets(cells, labelling.boundary(), scene, options);
        if (doubted.empty()) break;
        progress.tell(round + 0.3, kRounds);
        cut.add_source_capacity(doubted, one_sight);
        progress.tell(round + 0.6, kRounds);
        result.doubts += static_cast<std::int64_t>(doubted.size());
        Labelling next(cells, cut.labels());
        progress.tell(round + 0.7, kRounds);
        FreedPieces pieces(cells, scene, labelling.labels(), next.labels());
        if (pieces.empty())
            continue; // more source capacity only frees cells, so the labels are the same
        pieces.take_away(labelling.boundary());
        labelling.forget_boundary(); // one at a time is enough to hold
        pieces.lay_open(next.boundary());
        progress.tell(round + 0.9, kRounds);
        const std::vector<Index> unpaid = pieces.unpaid();
        next.set(unpaid, Label::inside);
        result.taken_back += static_cast<std::int64_t>(unpaid.size());
        labelling = std::move(next);
    }
    return result;
}

} // namespace vcarve
