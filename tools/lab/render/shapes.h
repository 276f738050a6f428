#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <functional>
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

/// A box of the given size that stands on its place, turned about the vertical.
struct StandingBox {
    Eigen::Vector3d place; ///< middle of its bottom
    Eigen::Vector3d size;
    double turn_deg = 0.0;
};
void add_box(PartBuilder& builder, const StandingBox& box, const Paint& paint);

/// A square bar between two places.
struct Bar {
    Eigen::Vector3d from;
    Eigen::Vector3d to;
    double thickness;
};
void add_bar(PartBuilder& builder, const Bar& bar, const Paint& paint);

void add_sphere(PartBuilder& builder, const Eigen::Vector3d& middle, double radius,
                const Paint& paint);

/// A ring that stands upright, its hole seen along y; radii of the ring and of its tube.
void add_ring(PartBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector2d& radii,
              const Paint& paint);

/// An upright cylinder, or a cone's frustum where the radii of its bottom and top differ.
struct Column {
    Eigen::Vector3d place; ///< middle of its bottom
    double bottom_radius;
    double top_radius;
    double height;
};
void add_column(PartBuilder& builder, const Column& column, const Paint& paint);

/// A board in the plane y = 0 with its front towards -y, from a grid of cells: cell (i, k) spans
/// x[i] to x[i + 1] and z[k] to z[k + 1], its front lies at y = recess(i, k), its back at `back`.
/// A cell recessed as deep as the back is a hole through the board.
struct Board {
    std::vector<double> x;
    std::vector<double> z;
    double back;
    std::function<double(std::size_t, std::size_t)> recess;
};
void add_board(PartBuilder& builder, const Board& board, const Paint& paint);

/// Seen from the middle, the surface lies at the distance that `reach` says for a unit direction.
void add_blob(PartBuilder& builder, const Eigen::Vector3d& middle,
              const std::function<double(const Eigen::Vector3d&)>& reach, const Paint& paint);

/// A tube around a closed curve, given for turns from 0 to 1; radius likewise, for places along and
/// around it. The curve must never run along z.
struct Tube {
    std::function<Eigen::Vector3d(double)> curve;
    std::function<double(double, double)> radius;
};
void add_tube(PartBuilder& builder, const Tube& tube, const Paint& paint);

} // namespace vcarve::render
