#pragma once

#include "io/ply/ply_data.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace vcarve {

/// What a Gaussian of 3D Gaussian splatting is beside a point.
struct Splat {
    float opacity_logit = 0.0F; ///< its opacity is the sigmoid of it
    float log_axis = 0.0F;      ///< natural logarithm of the largest half-axis
};

/// What is kept of a vertex; all but the position is zero where the file has none.
struct PlyVertex {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d scanner = Eigen::Vector3d::Zero(); ///< where it stood that measured the vertex
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Color color{};
    Splat splat{};
};

/// Where position, normal, colour, scanner and what makes a Gaussian stand among the properties of
/// the vertices, of which all others are skipped. The colour of Gaussians is the constant term of
/// their spherical harmonics, where they have no other.
class PlyVertexLayout {
  public:
    explicit PlyVertexLayout(const PlyElement& vertices);

    bool has_positions() const { return has_three_from(kPosition); }
    bool has_normals() const { return has_three_from(kNormal); }
    bool has_colors() const { return has_three_from(kColor); }
    bool are_splats() const { return are_splats_; }
    /// Whether each has a list of the images that saw it, as OpenMVS writes it.
    bool has_images() const;

    /// Reads the next vertex; adds the images of its list to `images` where that is not null.
    /// Throws BadPlyEntry.
    PlyVertex read(PlyData& data, std::vector<std::uint32_t>* images = nullptr) const;

  private:
    /// Where the values of the file go to: the first of three numbers each, and what is not kept.
    static constexpr std::size_t kPosition = 0;
    static constexpr std::size_t kNormal = 3;
    static constexpr std::size_t kColor = 6;
    static constexpr std::size_t kScanner = 9;
    static constexpr std::size_t kOpacity = 12;
    static constexpr std::size_t kAxes = 13;
    static constexpr std::size_t kNowhere = 16;
    struct Property {
        PlyProperty in_file;
        std::size_t slot;
    };

    bool has_three_from(std::size_t first) const;

    std::vector<Property> properties_;
    std::array<PlyType, 3> channel_types_{};
    bool are_splats_ = false;
    bool colors_are_harmonics_ = false;
};

/// What the three coordinates of a place are called.
using PlyNames = std::array<std::string_view, 3>;

/// The element that PCL writes behind the vertices, and where it says that the sensor stood.
inline constexpr std::string_view kPlyCamera = "camera";
inline constexpr PlyNames kPlyCameraPlace = {"view_px", "view_py", "view_pz"};

/// For which of its points a file says where their scanner stood.
enum class PlyScanners { none, one_for_all, each };

/// Whether the file says where the scanner stood of each vertex, else whether it has a camera that
/// stands for all. Also where it names a part of the coordinates only, which reading refuses.
PlyScanners scanners_in(const PlyHeader& header);

/// What the vertices call the place of their scanner: x_origin, y_origin and z_origin, or
/// scanner_x, scanner_y and scanner_z, of which the element has all or at least some; the first
/// where it has none.
const PlyNames& names_of_scanner(const PlyElement& vertices);

/// How many of the names are numbers of an element.
int count_names(const PlyElement& element, const PlyNames& names);

} // namespace vcarve
