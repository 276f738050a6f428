#include "io/files/foreign_file.h"

#include "base/text.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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

constexpr Foreign kForeignNames[] = {
    {".las", "is a scan as LAS, which is not read: pdal translate {0} {0}.ply converts it"},
    {".laz", "is a scan as LAZ, which is not read: pdal translate {0} {0}.ply converts it"},
    {".e57", "is a scan as E57, which is not read: pdal translate {0} {0}.ply converts it"},
    {".pcd", "is a cloud of PCL, which is not read: pcl_pcd2ply {0} {0}.ply converts it"},
    {".xyz", "is a cloud as text, which is not read: pdal translate --reader readers.text "
             "--readers.text.header=\"X Y Z\" {0} {0}.ply converts it (the header names all of its "
             "columns)"},
    {".nvm", "is a model of VisualSFM, which is not read: kapture_import_nvm.py -i {0} -im IMAGES "
             "-o KAPTURE --add-reconstruction, then kapture_export_colmap.py -i KAPTURE -db "
             "KAPTURE/colmap.db -txt FOLDER make a folder that is"},
    {".out", "is a model of Bundler, which is not read: kapture_import_bundler.py -i {0} -l "
             "LIST.txt -im IMAGES -o KAPTURE --add-reconstruction, then kapture_export_colmap.py "
             "-i KAPTURE -db KAPTURE/colmap.db -txt FOLDER make a folder that is"},
    {".mvs", "is a scene of OpenMVS, which is not read: InterfaceCOLMAP -i {0} -o FOLDER brings it "
             "into a folder that is"},
    {".obj", "is a mesh, but a model or a cloud is wanted"},
    {".off", "is a mesh, but a model or a cloud is wanted"},
    {".stl", "is a mesh, but a model or a cloud is wanted"},
    {".glb", "is a mesh, but a model or a cloud is wanted"},
};

} // namespace

void refuse_foreign_file(const std::filesystem::path& path, std::span<const char> bytes)
{
    constexpr std::size_t kLongest = 32;
    std::string begin(bytes.data(), std::min(bytes.size(), kLongest));
    std::ranges::transform(begin, begin.begin(),
                           [](unsigned char letter) { return std::tolower(letter); });
    for (const Foreign& foreign : kForeign) {
        if (!begin.starts_with(foreign.begin)) continue;
        throw InputError(fmt::format("{} {}", path.string(), foreign.sentence));
    }
}

void refuse_foreign_name(const std::filesystem::path& path)
{
    const std::string end = lower_case_end(path);
    const auto* const foreign = std::ranges::find(kForeignNames, end, &Foreign::begin);
    if (foreign == std::ranges::end(kForeignNames)) return;
    throw InputError(path.string() + ": " +
                     fmt::format(fmt::runtime(foreign->sentence), path.string()));
}

bool has_image_name(const std::filesystem::path& path)
{
    constexpr std::string_view kEnds[] = {".jpg", ".jpeg", ".png", ".tif", ".tiff"};
    return std::ranges::count(kEnds, lower_case_end(path)) > 0;
}

} // namespace vcarve
