#include "io/files/foreign_file.h"

#include "base/text.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace vcarve {

namespace {

/// The lower-case beginning or extensions of files to refuse, and the message after the path.
struct Foreign {
    std::string_view begin;
    const char* sentence;
};

constexpr Foreign kForeign[] = {
    {"version https://git-lfs", "is a Git LFS pointer, not the file: run git lfs pull"},
    {"<!doctype html", "is a web page, not the file: download it again"},
    {"<html", "is a web page, not the file: download it again"},
    {"pk\x03\x04", "is a zip archive: unpack it first"},
    {"\x1f\x8b", "is a gzip archive: unpack it first"},
};

/// File extensions, each between blanks. {0} is the path.
constexpr Foreign kForeignNames[] = {
    {" .las .laz .e57 ", "scans of this format are not supported; run: pdal translate {0} {0}.ply"},
    {" .pcd ", "clouds of PCL are not supported; run: pcl_pcd2ply {0} {0}.ply"},
    {" .xyz ", "text clouds are not supported; run: pdal translate --reader readers.text "
               "--readers.text.header=\"X Y Z\" {0} {0}.ply (list all columns in the header)"},
    {" .splat .spz ", "packed splats are not supported; run: splat-transform {0} {0}.ply, and give "
                      "the result as --points with a COLMAP model"},
    {" .nvm ",
     "models of VisualSFM are not supported; run: kapture_import_nvm.py -i {0} -im IMAGES "
     "-o KAPTURE --add-reconstruction, then: kapture_export_colmap.py -i KAPTURE -db "
     "KAPTURE/colmap.db -txt FOLDER, and give FOLDER"},
    {" .out ", "models of Bundler are not supported; run: kapture_import_bundler.py -i {0} -l "
               "LIST.txt -im IMAGES -o KAPTURE --add-reconstruction, then: "
               "kapture_export_colmap.py -i KAPTURE -db KAPTURE/colmap.db -txt FOLDER, and give "
               "FOLDER"},
    {" .mvs ", "scenes of OpenMVS are not supported; run: InterfaceCOLMAP -i {0} -o FOLDER, and "
               "give FOLDER"},
    {" .sfm ", "scenes of Meshroom are not supported; run: aliceVision_exportColmap -i {0} -o "
               "FOLDER, and give FOLDER"},
    {" .xml ", "models of this format are not supported; in Metashape, use Export Cameras with the "
               "format Colmap, and give the exported folder"},
    {" .obj .off .stl .glb ", "is a mesh; expected a model or a point cloud"},
};

} // namespace

void refuse_foreign_file(const std::filesystem::path& path, std::span<const char> bytes)
{
    constexpr std::size_t kLongest = 32;
    const std::string begin =
        lower_case(std::string(bytes.data(), std::min(bytes.size(), kLongest)));
    for (const Foreign& foreign : kForeign) {
        if (!begin.starts_with(foreign.begin)) continue;
        throw InputError(fmt::format("{} {}", path.string(), foreign.sentence));
    }
}

void refuse_foreign_name(const std::filesystem::path& path)
{
    const std::string end = fmt::format(" {} ", lower_case_end(path));
    for (const Foreign& foreign : kForeignNames) {
        if (foreign.begin.find(end) == std::string_view::npos) continue;
        throw InputError(path.string() + ": " +
                         fmt::format(fmt::runtime(foreign.sentence), path.string()));
    }
}

bool has_image_name(const std::filesystem::path& path)
{
    constexpr std::string_view kEnds[] = {".jpg",  ".jpeg", ".png", ".tif", ".tiff",
                                          ".webp", ".bmp",  ".tga", ".ppm", ".pgm"};
    return std::ranges::count(kEnds, lower_case_end(path)) > 0;
}

} // namespace vcarve
