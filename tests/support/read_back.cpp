#include "support/read_back.h"

#include "support/subprocess.h"
#include "vcarve/io.h"

#include <cmath>
#include <stdexcept>

namespace vcarve {

TriMesh sample_sheet()
{
    constexpr std::uint32_t kColumns = 9;
    constexpr std::uint32_t kRows = 7;
    TriMesh mesh;
    for (std::uint32_t row = 0; row < kRows; ++row) {
        for (std::uint32_t column = 0; column < kColumns; ++column) {
            const Eigen::Vector3d place(column + 0.1 * std::sin(5.0 * row), row / 3.0,
                                        std::cos(2.0 * column + row));
            mesh.positions.push_back(place);
            mesh.normals.push_back(
                Eigen::Vector3d(std::sin(place.x()), 0.1 * row, 1.0).normalized().cast<float>());
            mesh.colors.push_back({static_cast<std::uint8_t>(28 * column + row),
                                   static_cast<std::uint8_t>(255 - 3 * row),
                                   static_cast<std::uint8_t>(4 * mesh.colors.size())});
        }
    }
    for (std::uint32_t row = 0; row + 1 < kRows; ++row) {
        for (std::uint32_t column = 0; column + 1 < kColumns; ++column) {
            const std::uint32_t a = row * kColumns + column;
            mesh.faces.push_back({a, a + 1, a + kColumns});
            mesh.faces.push_back({a + kColumns + 1, a + kColumns, a + 1});
        }
    }
    return mesh;
}

std::vector<Corner> corners_of(const TriMesh& mesh)
{
    std::vector<Corner> corners;
    for (const Face& face : mesh.faces) {
        for (const std::uint32_t vertex : face) {
            Corner& corner = corners.emplace_back();
            corner.position = mesh.positions[vertex] + mesh.offset;
            if (!mesh.normals.empty()) corner.normal = mesh.normals[vertex];
            if (!mesh.colors.empty()) corner.color = mesh.colors[vertex];
        }
    }
    return corners;
}

TriMesh read_by_assimp(const std::filesystem::path& path)
{
    const TemporaryFolder folder;
    const std::string copy = folder / "copy.ply";
    Subprocess assimp({VCARVE_ASSIMP, "export", path.string(), copy, "--pretransform-vertices"});
    const Outcome outcome = assimp.wait();
    if (outcome.exit_code != 0) throw std::runtime_error(outcome.out + outcome.err);
    return read_ply(copy);
}

} // namespace vcarve
