#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vcarve {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type)
{
    return type < PlyType::float32;
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;    ///< of the value, or of each value of the list
    std::optional<PlyType> length_type; ///< only a list has one
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< as the header says: not yet checked against the file
    std::vector<PlyProperty> properties;
};

/// What the first lines of a PLY file promise.
struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< of a comment "offset X Y Z"
    std::size_t size_bytes = 0;                       ///< where the data begins

    const PlyElement* find(std::string_view name) const;
};

/// Reads the header at the beginning of `bytes`; `path` is for the messages. Throws InputError.
PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& path);

} // namespace vcarve
