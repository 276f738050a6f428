#include "texture/masked_faces.h"

#include "base/parallel.h"
#include "base/union_find.h"
#include "geometry/triangle.h"
#include "io/images/read_photograph.h"
#include "mesh/half_edge_mesh.h"
#include "steps/6_surface/cleanup.h"
#include "texture/occlusion.h"
#include "vcarve/error.h"

#include <algorithm>
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

/// `mask` is null if the view has none.
Look look_at(const CalibratedPhoto& view, const Photograph* mask, const Occlusion& occlusion,
             std::uint32_t face)
{
    Look look = Look::unseen;
    const TriMesh& mesh = occlusion.mesh();
    for (const Vector3d& place : face_samples(corners_of(mesh.positions, mesh.faces[face]))) {
        const std::optional<Vector2d> pixel = pixel_of(view, place);
        if (!pixel) continue;
        const bool is_masked = mask != nullptr && is_excluded(*mask, *pixel);
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

/// Adds the votes of the views with a readable mask. Returns the others.
std::vector<std::uint32_t> add_masked_views(const Occlusion& occlusion,
                                            const std::vector<CalibratedPhoto>& views,
                                            std::vector<Votes>& votes, const Progress& progress)
{
    std::vector<std::uint8_t> has_mask(views.size(), 0);
    parallel_for(
        views.size(), progress,
        [&](std::size_t view) {
            if (views[view].file.empty()) return;
            Photograph mask;
            try {
                mask = read_photograph(views[view].file);
            } catch (const InputError&) {
                return;
            }
            has_mask[view] = 1;
            for (std::uint32_t face = 0; face < votes.size(); ++face) {
                const Look look = look_at(views[view], &mask, occlusion, face);
                if (look == Look::unseen) continue;
                std::uint32_t& count = look == Look::clear ? votes[face].clear : votes[face].masked;
                std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
            }
        },
        1);
    std::vector<std::uint32_t> others;
    for (std::uint32_t view = 0; view < views.size(); ++view) {
        if (has_mask[view] == 0) others.push_back(view);
    }
    return others;
}

/// Counts the views until the faces' fate is certain: fewer clear votes may be counted than cast.
std::vector<Votes> votes_of(const TriMesh& mesh, const std::vector<CalibratedPhoto>& views,
                            const Progress& progress)
{
    const Occlusion occlusion(mesh);
    std::vector<Votes> votes(mesh.faces.size());
    const std::vector<std::uint32_t> without_mask =
        add_masked_views(occlusion, views, votes, progress.part(0.0, 0.5));
    parallel_for(
        votes.size(), progress.part(0.5, 1.0),
        [&](std::size_t face) {
            auto& [clear, masked] = votes[face];
            for (const std::uint32_t view : without_mask) {
                if (clear >= std::max(masked, 1U)) return;
                const auto number = static_cast<std::uint32_t>(face);
                if (look_at(views[view], nullptr, occlusion, number) == Look::clear) ++clear;
            }
        },
        256);
    return votes;
}

} // namespace

std::vector<CalibratedPhoto> views_with_masks(const Scene& scene, const Photographs& masks,
                                              const Eigen::Vector3d& mesh_offset)
{
    Photographs all = masks;
    for (std::size_t view = 0; view < scene.views.size(); ++view) {
        if (!all.of_view[view].empty()) continue;
        const Camera& camera = scene.cameras[scene.views[view].camera];
        all.of_view[view] = "none"; // only to be listed
        all.sizes[view] = {static_cast<int>(camera.width_px), static_cast<int>(camera.height_px)};
    }
    std::vector<CalibratedPhoto> views = calibrated_photos(scene, all, mesh_offset);
    for (CalibratedPhoto& view : views) {
        view.file = masks.of_view[view.view];
    }
    return views;
}

TriMesh without_masked_faces(const TriMesh& mesh, const std::vector<CalibratedPhoto>& views,
                             int min_component, const Progress& progress)
{
    const std::vector<Votes> votes = votes_of(mesh, views, progress);
    TriMesh kept = mesh;
    kept.faces.clear();
    UnionFind components(mesh.positions.size());
    std::vector<std::uint8_t> is_clear(mesh.positions.size());
    std::vector<std::uint8_t> is_cut(mesh.positions.size()); // was on a removed face
    for (std::size_t face = 0; face < votes.size(); ++face) {
        const auto& [a, b, c] = mesh.faces[face];
        if (votes[face].masked > votes[face].clear) {
            is_cut[a] = is_cut[b] = is_cut[c] = 1;
            continue;
        }
        kept.faces.push_back(mesh.faces[face]);
        components.join(a, b);
        components.join(a, c);
        if (votes[face].clear > 0) is_clear[a] = 1;
    }
    for (std::uint32_t vertex = 0; vertex < is_clear.size(); ++vertex) {
        if (is_clear[vertex] != 0) is_clear[components.root(vertex)] = 1;
        if (is_cut[vertex] != 0) is_cut[components.root(vertex)] = 1;
    }
    std::erase_if(kept.faces, [&](const Face& face) {
        const std::uint32_t root = components.root(face[0]);
        return is_cut[root] != 0 && is_clear[root] == 0;
    });
    return tri_mesh(
        *clean_surface(std::move(kept), {.min_component = min_component, .max_hole = 0}).mesh);
}

} // namespace vcarve
