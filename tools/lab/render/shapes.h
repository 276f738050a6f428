#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace vcarve::render {

/// The appearance of a part.
struct Paint {
    Eigen::Array3f tint = Eigen::Array3f::Ones(); ///< 0 to 1
    double contrast = 1.0; ///< of the texture: 0 is a plain color, without features to match
    double stretch = 1.0;  ///< scale of the texture, for parts seen from larger distances
};

/// Closed parts that may touch and intersect. z is up and units are about a meter: the detail of
/// the texture suits views at some meters.
struct Parts {
    TriMesh mesh;
    std::vector<std::uint32_t> part_of_face;
    std::vector<Paint> paint_of_part;
};

/// Adds parts one by one, with faces counterclockwise from outside.
class PartBuilder {
  public:
    void begin_part(const Paint& paint);

    std::uint32_t next_vertex() const;
    std::uint32_t vertex(const Eigen::Vector3d& position);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void quad(const std::array<std::uint32_t, 4>& v);

    /// Moves the current part, as far as it is built.
    void move_part(const Eigen::Isometry3d& move);
    /// The corners of the current part's triangles, three per triangle.
    std::vector<Eigen::Vector3d> part_corners() const;

    Parts take() { return std::move(parts_); }

  private:
    Parts parts_;
    std::uint32_t first_vertex_ = 0; ///< of the current part
    std::size_t first_face_ = 0;
};

/// A box that stands on a position, rotated about the vertical.
struct StandingBox {
    Eigen::Vector3d place; ///< center of its bottom
    Eigen::Vector3d size;
    double turn_deg = 0.0;
};
void add_box(PartBuilder& builder, const StandingBox& box, const Paint& paint);

/// A square bar between two positions.
struct Bar {
    Eigen::Vector3d from;
    Eigen::Vector3d to;
    double thickness;
};
void add_bar(PartBuilder& builder, const Bar& bar, const Paint& paint);

void add_sphere(PartBuilder& builder, const Eigen::Vector3d& middle, double radius,
                const Paint& paint);

/// An upright ring with its axis along y; `radii` are those of the ring and of its tube.
void add_ring(PartBuilder& builder, const Eigen::Vector3d& middle, const Eigen::Vector2d& radii,
              const Paint& paint);

/// An upright cylinder, or a frustum if the radii of bottom and top differ.
struct Column {
    Eigen::Vector3d place; ///< center of its bottom
    double bottom_radius;
    double top_radius;
    double height;
};
void add_column(PartBuilder& builder, const Column& column, const Paint& paint);

/// A board in the plane y = 0 that faces -y, made of a grid of cells. Cell (i, k) spans x[i] to
/// x[i + 1] and z[k] to z[k + 1]. Its front is at y = recess(i, k), its back at `back`. If both are
/// equal, the cell is a hole.
struct Board {
    std::vector<double> x;
    std::vector<double> z;
    double back;
    std::function<double(std::size_t, std::size_t)> recess;
};
void add_board(PartBuilder& builder, const Board& board, const Paint& paint);

/// Adds a star-shaped surface: `reach` is its distance from the center in a unit direction.
void add_blob(PartBuilder& builder, const Eigen::Vector3d& middle,
              const std::function<double(const Eigen::Vector3d&)>& reach, const Paint& paint);

/// A tube around a closed curve with a parameter from 0 to 1. The radius depends on parameters
/// along and around the curve. The curve must never be parallel to z.
struct Tube {
    std::function<Eigen::Vector3d(double)> curve;
    std::function<double(double, double)> radius;
};
void add_tube(PartBuilder& builder, const Tube& tube, const Paint& paint);

} // namespace vcarve::render
