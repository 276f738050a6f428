#include "steps/6_surface/support.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "mesh/edge_table.h"
#include "mesh/local_edges.h"
#include "steps/4_visibility/face_evidence.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

namespace {

using FaceNumbers = std::vector<std::uint32_t>; ///< ascending

/// Of some faces, those in patches of a few. Faces that share an edge are in one patch, and a face
/// that is not small makes its patch too large.
template <typename IsSmall>
FaceNumbers small_patches(const TriMesh& mesh, const FaceNumbers& some, const IsSmall& is_small)
{
    constexpr std::uint32_t kMaxFaces = 20;
    std::vector<Face> faces(some.size());
    std::ranges::transform(some, faces.begin(),
                           [&](std::uint32_t face) { return mesh.faces[face]; });
    const EdgeTable edges = gather_edges(faces, mesh.positions.size());
    UnionFind patches(faces.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        for (const HalfEdge half_edge : edges[edge]) {
            patches.join(edges[edge][0] / 3, half_edge / 3);
        }
    }

    std::vector<std::uint32_t> counts(faces.size(), 0);
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        ++counts[patches.root(i)];
    }
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        std::uint32_t& count = counts[patches.root(i)];
        if (count <= kMaxFaces && !is_small(some[i])) count = kMaxFaces + 1;
    }
    FaceNumbers found;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        if (counts[patches.root(i)] <= kMaxFaces) found.push_back(some[i]);
    }
    return found;
}

/// From which edge on a face is large beside all that were seen: unseen ones among them are guesses
/// of a size nobody can overlook, however sparse the points around. No more than `most` is told
/// exactly.
double vast_edge(const LocalEdges& edges, const FaceFlags& seen, double most)
{
    constexpr double kVast = 8.0; ///< x the median longest edge of seen faces
    const auto num_seen = static_cast<std::size_t>(std::ranges::count(seen, 1));
    auto shorter = parallel_collect<double>(seen.size(), [&](std::size_t face, auto& lengths) {
        if (seen[face] == 0) return;
        const double length = edges.longest_edge(face);
        if (kVast * length < most) lengths.push_back(length);
    });
    const std::size_t middle = num_seen / 2;
    if (middle >= shorter.size()) return most;
    std::ranges::nth_element(shorter, shorter.begin() + static_cast<std::ptrdiff_t>(middle));
    return kVast * shorter[middle];
}

/// Whether no edge of a face is over `most` times the median edge at those of its corners where a
/// face was seen: the larger of two, the middle of three. Amid unseen faces a corner knows nothing.
bool is_local_size(const TriMesh& mesh, const LocalEdges& edges, std::uint32_t face, double most)
{
    std::array<double, 3> medians{};
    std::ranges::transform(mesh.faces[face], medians.begin(),
                           [&](std::uint32_t vertex) { return edges.median(vertex); });
    std::ranges::sort(medians);
    const double known = medians[1] > 0.0 ? medians[1] : medians[2];
    return known == 0.0 || edges.longest_edge(face) <= most * known;
}

/// Which unseen faces lie in patches of a few small faces, none of them `bare`: gaps in a surface
/// seen around them.
template <typename IsBare>
FaceNumbers gap_faces(const TriMesh& mesh, const FaceFlags& seen, const LocalEdges& edges,
                      const IsBare& is_bare, double max_edge)
{
    const auto unseen =
        parallel_collect<std::uint32_t>(seen.size(), [&](std::size_t face, auto& faces) {
            if (seen[face] == 0) faces.push_back(static_cast<std::uint32_t>(face));
        });
    FaceNumbers gaps = small_patches(mesh, unseen, [&](std::uint32_t face) {
        return is_local_size(mesh, edges, face, max_edge) && !is_bare(face);
    });
    const auto length = [&](std::uint32_t face) { return edges.longest_edge(face); };
    if (gaps.empty()) return gaps;
    const double longest = length(std::ranges::max(gaps, {}, length));
    const double vast = vast_edge(edges, seen, longest);
    if (vast == longest) return gaps;
    return small_patches(mesh, gaps, [&](std::uint32_t face) { return length(face) <= vast; });
}

/// At how many of its edges a face has one of some others beside it, which are given at their
/// vertices.
std::ptrdiff_t num_beside(const std::vector<Face>& faces, std::uint32_t face,
                          const VertexFaces& others_at)
{
    return std::ranges::count_if(kCorners, [&](int corner) {
        bool is_beside = false;
        visit_beside(faces, face, corner, others_at, [&](std::uint32_t) { is_beside = true; });
        return is_beside;
    });
}

/// The faces in slits between seen ones: no larger than usual, beside seen ones at two edges or
/// more, and seen themselves by views that stand lower before them than is asked of others. So are
/// faces along a crest that all views look at from its foot.
FaceNumbers slit_faces(const TriMesh& mesh, const std::vector<CellFacet>& facets,
                       const FaceVisibility& visibility, const FaceFlags& seen,
                       const LocalEdges& edges)
{
    constexpr double kUsual = 3.0; ///< x the median edge around
    constexpr double kLow = 0.02;  ///< cosine, about 1 degree above the face
    const VertexFaces seen_at(mesh.faces, mesh.positions.size(), seen);
    const auto look = [&](std::size_t i, FaceNumbers& slits) {
        const auto face = static_cast<std::uint32_t>(i);
        if (seen[i] != 0 || !(edges.relative_size(i) <= kUsual)) return;
        if (num_beside(mesh.faces, face, seen_at) >= 2 && visibility.is_seen(facets[i], kLow))
            slits.push_back(face);
    };
    return parallel_collect<std::uint32_t>(seen.size(), look, 64);
}

} // namespace

FaceFlags supported_faces(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                          const FaceVisibility& visibility, const Scene& scene,
                          const SupportOptions& options)
{
    FaceFlags keep = seen_faces(boundary, scene);
    parallel_for(
        keep.size(),
        [&](std::size_t face) {
            if (keep[face] == 0 && visibility.is_seen(facets[face])) keep[face] = 1;
        },
        64);
    const LocalEdges edges(boundary.positions, boundary.faces, keep);
    for (const std::uint32_t face : slit_faces(boundary, facets, visibility, keep, edges)) {
        keep[face] = 1;
    }
    const auto is_bare = [&](std::uint32_t face) { return visibility.is_on_hull(facets[face]); };
    for (const std::uint32_t face :
         gap_faces(boundary, keep, edges, is_bare, options.max_gap_edge)) {
        keep[face] = 1;
    }
    return keep;
}

TriMesh with_faces(TriMesh mesh, const FaceFlags& keep)
{
    mesh.faces = parallel_collect<Face>(keep.size(), [&](std::size_t face, auto& faces) {
        if (keep[face] != 0) faces.push_back(mesh.faces[face]);
    });
    return mesh;
}

} // namespace vcarve
