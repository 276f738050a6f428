#include "io/files/foreign_file.h"

#include "base/text.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace vcarve {

namespace {

/// What begins a file that is not what it should be, lower case, and what to say of it.
struct Foreign {
    std::string_view begin;
    const char* sentence;
};

constexpr Foreign kForeign[] = {
    {"version https://git-lfs", "is a Git LFS pointer, not the file: run git lfs pull"},
    {"<!doctype html", "is a web page, not the file: the download failed"},
    {"<html", "is a web page, not the file: the download failed"},
    {"pk\x03\x04", "is a zip archive: unpack it first"},
    {"\x1f\x8b", "is a gzip archive: unpack it first"},
};

/// The same by the ends of names, each between blanks.
constexpr Foreign kForeignNames[] = {
    {" .las .laz .e57 ", "is a scan, which is not read: pdal translate {0} {0}.ply converts it"},
    {" .pcd ", "is a cloud of PCL, which is not read: pcl_pcd2ply {0} {0}.ply converts it"},
    {" .xyz ", "is a cloud as text, which is not read: pdal translate --reader readers.text "
               "--readers.text.header=\"X Y Z\" {0} {0}.ply converts it (the header names all of "
               "its columns)"},
    {" .splat .spz ", "is a packed splat, which is not read: splat-transform {0} {0}.ply converts "
                      "it to a cloud for --points, beside a COLMAP model"},
    {" .nvm ",
     "is a model of VisualSFM, which is not read: kapture_import_nvm.py -i {0} -im IMAGES "
     "-o KAPTURE --add-reconstruction, then kapture_export_colmap.py -i KAPTURE -db "
     "KAPTURE/colmap.db -txt FOLDER make a folder that is"},
    {" .out ", "is a model of Bundler, which is not read: kapture_import_bundler.py -i {0} -l "
               "LIST.txt -im IMAGES -o KAPTURE --add-reconstruction, then kapture_export_colmap.py "
               "-i KAPTURE -db KAPTURE/colmap.db -txt FOLDER make a folder that is"},
    {" .mvs ", "is a scene of OpenMVS, which is not read: InterfaceCOLMAP -i {0} -o FOLDER brings "
               "it into a folder that is"},
    {" .sfm ", "is a scene of Meshroom, which is not read: aliceVision_exportColmap -i {0} -o "
               "FOLDER makes a folder that is"},
    {" .xml ", "is no model that is read; if it is of Metashape, its Export Cameras makes a folder "
               "that is, with the format Colmap"},
    {" .obj .off .stl .glb ", "is a mesh, but a model or a cloud is wanted"},
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
