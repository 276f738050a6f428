#include "surface/support.h"

#include "surface/edge_table.h"
#include "surface/face_evidence.h"
#include "surface/union_find.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vcarve {

namespace {

/// Per face, the patch of unseen faces it belongs to, as the least of their numbers.
UnionFind unseen_patches(const TriMesh& mesh, const FaceFlags& seen)
{
    UnionFind patches(mesh.faces.size());
    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        std::uint32_t first = kNoPoint;
        for (const Side side : edges[edge]) {
            const std::uint32_t face = side / 3;
            if (seen[face] != 0) {
                continue;
            }
            if (first != kNoPoint) {
                patches.join(first, face);
            }
            first = face;
        }
    }
    return patches;
}

/// Which faces are large beside all that were seen: unseen ones among them are guesses of a size
/// nobody can overlook, however sparse the points around.
FaceFlags vast_faces(const TriMesh& mesh, const FaceFlags& seen)
{
    constexpr double kVast = 8.0; ///< x the median longest edge of seen faces
    const std::vector<double> longest = longest_edges(mesh);
    std::vector<double> of_seen;
    for (std::size_t face = 0; face < longest.size(); ++face) {
        if (seen[face] != 0) of_seen.push_back(longest[face]);
    }
    FaceFlags vast(longest.size(), 0);
    if (of_seen.empty()) return vast;
    const auto middle = of_seen.begin() + static_cast<std::ptrdiff_t>(of_seen.size() / 2);
    std::nth_element(of_seen.begin(), middle, of_seen.end());
    std::transform(longest.begin(), longest.end(), vast.begin(),
                   [&](double edge) { return edge > kVast * *middle ? 1 : 0; });
    return vast;
}

/// Which unseen faces lie in patches of a few small faces: gaps in a surface seen around them.
FaceFlags gap_faces(const TriMesh& mesh, const FaceFlags& seen, const std::vector<double>& sizes,
                    double max_edge)
{
    constexpr std::int64_t kMaxFaces = 20;
    const FaceFlags vast = vast_faces(mesh, seen);
    UnionFind patches = unseen_patches(mesh, seen);
    std::vector<std::int64_t> counts(mesh.faces.size(), 0);
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        counts[patches.root(face)] +=
            sizes[face] <= max_edge && vast[face] == 0 ? 1 : kMaxFaces + 1;
    }
    FaceFlags gaps(mesh.faces.size(), 0);
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        gaps[face] = seen[face] == 0 && counts[patches.root(face)] <= kMaxFaces ? 1 : 0;
    }
    return gaps;
}

} // namespace

TriMesh keep_supported(const TriMesh& mesh, const Scene& scene, const SupportOptions& options)
{
    const FaceFlags seen = seen_faces(mesh, scene);
    const std::vector<double> sizes = relative_sizes(mesh, seen);
    const FaceFlags gaps = gap_faces(mesh, seen, sizes, options.max_gap_edge);
    TriMesh result = mesh;
    result.faces.clear();
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const bool fits = options.max_edge == 0.0 || sizes[i] <= options.max_edge;
        if ((seen[i] != 0 && fits) || gaps[i] != 0) {
            result.faces.push_back(mesh.faces[i]);
        }
    }
    return result;
}

} // namespace vcarve
