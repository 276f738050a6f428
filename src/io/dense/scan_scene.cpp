#include "io/dense/scan_scene.h"

#include "base/numbers.h"
#include "io/dense/cloud_points.h"
#include "io/dense/scanner_views.h"
#include "io/ply/ply_cloud.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <utility>

namespace vcarve {

Scene read_scan_scene(const ScanFile& file, const Progress& progress)
{
    PointCloud cloud = read_ply_cloud(file.cloud, progress.part(0.0, 0.8),
                                      file.scanner ? ReadScanners::no : ReadScanners::yes);
    if (file.scanner) cloud.scanners = {*file.scanner + read_ply_header(file.cloud).offset};
    if (cloud.scanners.empty() && !cloud.positions.empty()) {
        throw InputError(fmt::format("{}: the file does not tell where the scanner of its points "
                                     "stood",
                                     file.cloud.string()));
    }
    Scene scene;
    scene.positions = std::move(cloud.positions);
    add_scanner_views(cloud.scanners, scene);
    progress.tell(0.95);
    take_attributes(std::move(cloud), 0, scene);
    return scene;
}

std::optional<SceneSize> scan_size_before_reading(const ScanFile& file)
{
    const PlyHeader header = read_ply_header(file.cloud);
    const PlyElement* const vertices = header.find("vertex");
    if (vertices == nullptr || vertices->count > kMostIndices) return std::nullopt;
    return SceneSize{.points = vertices->count,
                     .sights = vertices->count,
                     .views = 1,
                     .has_normals = PlyVertexLayout(*vertices).has_normals(),
                     .is_dense = true};
}

} // namespace vcarve
