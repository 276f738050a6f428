#include "io/files/foreign_file.h"

#include "base/lower_case_end.h"
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
    {".las", "LAS is not read: convert it to PLY with CloudCompare or PDAL"},
    {".laz", "LAZ is not read: convert it to PLY with CloudCompare or PDAL"},
    {".e57", "E57 is not read: convert it to PLY with CloudCompare or PDAL"},
    {".pcd", "PCD is not read: convert it to PLY with pcl_pcd2ply"},
    {".nvm", "NVM is not read: convert it with colmap model_converter"},
    {".out", "Bundler's files are not read: convert them with colmap model_converter"},
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
    throw InputError(fmt::format("{}: {}", path.string(), foreign->sentence));
}

} // namespace vcarve
