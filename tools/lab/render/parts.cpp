#include "render/parts.h"

namespace vcarve::render {

void PartBuilder::begin_part(const Paint& paint)
{
    parts_.paint_of_part.push_back(paint);
    first_vertex_ = next_vertex();
    first_face_ = parts_.mesh.faces.size();
}

std::uint32_t PartBuilder::next_vertex() const
{
    return static_cast<std::uint32_t>(parts_.mesh.positions.size());
}

std::uint32_t PartBuilder::vertex(const Eigen::Vector3d& position)
{
    parts_.mesh.positions.push_back(position);
    return next_vertex() - 1;
}

void PartBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    parts_.mesh.faces.push_back({a, b, c});
    parts_.part_of_face.push_back(static_cast<std::uint32_t>(parts_.paint_of_part.size() - 1));
}

void PartBuilder::quad(const std::array<std::uint32_t, 4>& v)
{
    triangle(v[0], v[1], v[2]);
    triangle(v[0], v[2], v[3]);
}

void PartBuilder::move_part(const Eigen::Isometry3d& move)
{
    for (std::uint32_t i = first_vertex_; i < next_vertex(); ++i) {
        parts_.mesh.positions[i] = move * parts_.mesh.positions[i];
    }
}

std::vector<Eigen::Vector3d> PartBuilder::part_corners() const
{
    std::vector<Eigen::Vector3d> result;
    for (std::size_t i = first_face_; i < parts_.mesh.faces.size(); ++i) {
        for (const std::uint32_t corner : parts_.mesh.faces[i]) {
            result.push_back(parts_.mesh.positions[corner]);
        }
    }
    return result;
}

} // namespace vcarve::render
