#pragma once

#include "io/ply/ply_header.h"

#include <array>
#include <string_view>

namespace vcarve {

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
