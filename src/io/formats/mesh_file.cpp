#include "io/formats/mesh_file.h"

#include "base/text.h"
#include "io/files/output_file.h"
#include "io/formats/textured_files.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace vcarve {
namespace {

namespace fs = std::filesystem;

/// A format and its file extension.
struct Kind {
    std::string_view end;
    void (*write)(std::ostream&, const TriMesh&, const MeshFormat&); ///< null for PLY
};

constexpr std::array<Kind, 5> kFormats = {{{".ply", nullptr},
                                           {".obj", write_obj},
                                           {".off", write_off},
                                           {".stl", write_stl},
                                           {".glb", write_glb}}};

/// Returns null if no format has the file extension.
const Kind* find_kind(const fs::path& path)
{
    const auto* const kind = std::ranges::find(kFormats, lower_case_end(path), &Kind::end);
    return kind == kFormats.end() ? nullptr : kind;
}

const Kind& kind_of(const fs::path& path)
{
    const Kind* const kind = find_kind(path);
    if (kind != nullptr) return *kind;
    throw UsageError(fmt::format("cannot write {}: the name of a mesh must end with .ply, "
                                 ".obj, .off, .stl or .glb",
                                 path.string()));
}

} // namespace

bool is_mesh_name(const fs::path& path)
{
    return find_kind(path) != nullptr;
}

void require_mesh_name(const fs::path& path)
{
    kind_of(path);
}

void require_ply(const fs::path& path, const char* option)
{
    if (kind_of(path).write == nullptr) return;
    throw UsageError(
        fmt::format("cannot write {} with {}, which is for PLY files only", path.string(), option));
}

double rounding_share(const fs::path& path, const TriMesh& mesh, const MeshFormat& format)
{
    if (kind_of(path).write != write_stl) return 0.0;
    const Eigen::Vector3d shift = mesh.offset - format.offset;
    Eigen::AlignedBox3d box;
    double most = 0.0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const Eigen::Vector3d exact = position + shift;
        most =
            std::max(most, (exact.cast<float>().cast<double>() - exact).lpNorm<Eigen::Infinity>());
        box.extend(position);
    }
    return most > 0.0 ? most / box.diagonal().norm() : 0.0;
}

void write_mesh(const fs::path& path, const TriMesh& mesh, const MeshFormat& format)
{
    const Kind& kind = kind_of(path);
    if (kind.write == nullptr) {
        return format.texture != nullptr ? write_textured_ply(path, mesh, format)
                                         : write_ply(path, mesh, format);
    }
    if (format.ascii) require_ply(path, "--ascii");
    if (format.provenance != nullptr) require_ply(path, "--attributes");
    if (format.texture != nullptr && kind.write == write_obj) {
        return write_textured_obj(path, mesh, format);
    }
    OutputFile file(path);
    try {
        kind.write(file.stream(), mesh, format);
    } catch (const UsageError& error) {
        throw UsageError(fmt::format("cannot write {}: {}", path.string(), error.what()));
    }
    file.commit();
}

} // namespace vcarve
