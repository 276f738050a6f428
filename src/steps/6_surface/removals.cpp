#include "steps/6_surface/removals.h"

#include "mesh/used_vertices.h"
#include "model/scene_points.h"

namespace vcarve {

void Removals::note(const FaceFlags& keep, Removal reason)
{
    if (wanted_ == nullptr) return;
    why_.resize(keep.size(), kKept);
    for (std::size_t face = 0; face < keep.size(); ++face) {
        if (keep[face] != 0) why_[face] = kKept;
        if (keep[face] == 0 && why_[face] == kKept) why_[face] = static_cast<std::uint8_t>(reason);
    }
}

void Removals::add_noted(const TriMesh& boundary)
{
    if (wanted_ == nullptr) return;
    std::vector<Face> faces;
    for (std::size_t face = 0; face < why_.size(); ++face) {
        if (why_[face] == kKept) continue;
        faces.push_back(boundary.faces[face]);
        wanted_->reasons.push_back(static_cast<Removal>(why_[face]));
    }
    const std::vector<std::uint32_t> vertices = used_vertices(faces, boundary.positions.size());
    renumber(faces, vertices, boundary.positions.size());
    wanted_->mesh.offset = boundary.offset;
    wanted_->mesh.positions = values_at(vertices, boundary.positions);
    wanted_->mesh.faces = std::move(faces);
}

void Removals::add_deleted(const HalfEdgeMesh& mesh, std::size_t end)
{
    if (wanted_ == nullptr) return;
    for (std::size_t i = 0; i < end; ++i) {
        const auto face = handle_at<OpenMesh::FaceHandle>(i);
        if (!mesh.is_deleted(face)) continue;
        const auto first = static_cast<std::uint32_t>(wanted_->mesh.positions.size());
        for (const Eigen::Vector3d& corner : mesh.triangle(face)) {
            wanted_->mesh.positions.push_back(corner);
        }
        wanted_->mesh.faces.push_back({first, first + 1, first + 2});
        wanted_->reasons.push_back(Removal::small_piece);
    }
}

} // namespace vcarve
