#include "texture/masked_faces.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "geometry/triangle.h"
#include "io/images/read_photograph.h"
#include "mesh/half_edge_mesh.h"
#include "steps/6_surface/cleanup.h"
#include "texture/occlusion.h"
#include "vcarve/error.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// How a view sees a face.
enum class Look : std::uint8_t { unseen, masked, clear };

Look look_at(const CalibratedPhoto& view, const Photograph& mask, const Occlusion& occlusion,
             std::uint32_t face)
{
    Look look = Look::unseen;
    const TriMesh& mesh = occlusion.mesh();
    for (const Vector3d& place : face_samples(corners_of(mesh.positions, mesh.faces[face]))) {
        const std::optional<Vector2d> pixel = pixel_of(view, place);
        if (!pixel) continue;
        const bool is_masked = is_excluded(mask, *pixel);
        if (is_masked && look == Look::masked) continue;
        if (!occlusion.sees(view.pose.center, place, face)) continue;
        if (!is_masked) return Look::clear;
        look = Look::masked;
    }
    return look;
}

/// The numbers of views that see a face in an unmasked pixel, and only in masked pixels.
struct Votes {
    std::uint32_t clear = 0;
    std::uint32_t masked = 0;
};

std::vector<Votes> votes_of(const TriMesh& mesh, const std::vector<CalibratedPhoto>& masks,
                            const Progress& progress)
{
    const Occlusion occlusion(mesh);
    std::vector<Votes> votes(mesh.faces.size());
    parallel_for(
        masks.size(), progress,
        [&](std::size_t view) {
            Photograph mask;
            try {
                mask = read_photograph(masks[view].file);
            } catch (const InputError&) {
                return;
            }
            for (std::uint32_t face = 0; face < votes.size(); ++face) {
                const Look look = look_at(masks[view], mask, occlusion, face);
                if (look == Look::unseen) continue;
                std::uint32_t& count = look == Look::clear ? votes[face].clear : votes[face].masked;
                std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
            }
        },
        1);
    return votes;
}

} // namespace

TriMesh without_masked_faces(const TriMesh& mesh, const std::vector<CalibratedPhoto>& masks,
                             const Progress& progress)
{
    const std::vector<Votes> votes = votes_of(mesh, masks, progress);
    TriMesh kept = mesh;
    kept.faces.clear();
    UnionFind components(mesh.positions.size());
    std::vector<std::uint8_t> is_clear(mesh.positions.size());
    for (std::size_t face = 0; face < votes.size(); ++face) {
        if (votes[face].masked > votes[face].clear) continue;
        const auto& [a, b, c] = kept.faces.emplace_back(mesh.faces[face]);
        components.join(a, b);
        components.join(a, c);
        if (votes[face].clear > 0) is_clear[a] = 1;
    }
    for (std::uint32_t vertex = 0; vertex < is_clear.size(); ++vertex) {
        if (is_clear[vertex] != 0) is_clear[components.root(vertex)] = 1;
    }
    std::erase_if(kept.faces,
                  [&](const Face& face) { return is_clear[components.root(face[0])] == 0; });
    return tri_mesh(*clean_surface(std::move(kept), {.max_hole = 0}).mesh);
}

} // namespace vcarve
