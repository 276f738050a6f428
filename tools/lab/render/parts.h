#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve::render {

/// How a part looks.
struct Paint {
    Eigen::Array3f tint = Eigen::Array3f::Ones(); ///< 0 to 1
    double contrast = 1.0; ///< of its texture: 0 is an even colour, without features to match
    double stretch = 1.0;  ///< of its texture, for what is seen from farther off than the rest
};

/// Things made of closed parts that may touch and run into each other. z is up, units are about a
/// metre: the texture's detail is made for views from some metres away.
struct Parts {
    TriMesh mesh;
    std::vector<std::uint32_t> part_of_face;
    std::vector<Paint> paint_of_part;
};

/// Adds one part after the other, each with faces counter-clockwise seen from outside.
class PartBuilder {
  public:
    void begin_part(const Paint& paint);

    std::uint32_t next_vertex() const;
    std::uint32_t vertex(const Eigen::Vector3d& position);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void quad(const std::array<std::uint32_t, 4>& v);

    /// Moves the part begun last, as far as it is built.
    void move_part(const Eigen::Isometry3d& move);
    /// Corners of the part's triangles, three a triangle.
    std::vector<Eigen::Vector3d> part_corners() const;

    Parts take() { return std::move(parts_); }

  private:
    Parts parts_;
    std::uint32_t first_vertex_ = 0; ///< of the part begun last
    std::size_t first_face_ = 0;
};

} // namespace vcarve::render
