#include "io/formats/textured_files.h"

#include "base/text.h"
#include "io/files/block_writer.h"
#include "io/files/output_file.h"
#include "io/formats/mesh_file.h"
#include "io/images/encode_image.h"
#include "io/ply/ply_file.h"
#include "model/photograph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <tuple>

namespace vcarve {
namespace {

namespace fs = std::filesystem;

fs::path materials_path(const fs::path& surface)
{
    return fs::path(surface).replace_extension(".mtl");
}

/// Writes the pages to temporary files; commit() makes them appear.
void write_pages(const fs::path& path, const Texture& texture, std::deque<OutputFile>& files)
{
    for (std::size_t page = 0; page < texture.pages.size(); ++page) {
        const auto bytes = encode_jpeg(texture.pages[page], kTextureQuality);
        files.emplace_back(page_path(path, page))
            .stream()
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
}

/// Makes the files appear in order, so the mesh is last.
void commit(std::deque<OutputFile>& files)
{
    for (OutputFile& file : files) {
        file.commit();
    }
}

/// Writes a matt material per page.
void write_materials(std::ostream& out, const fs::path& path, const Texture& texture)
{
    for (std::size_t page = 0; page < texture.pages.size(); ++page) {
        out << "newmtl page_" << page << "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd "
            << page_path(path, page).filename().string() << '\n';
    }
}

/// Appends three texture coordinates per face, with v upward as OBJ defines it.
void put_places(BlockWriter& writer, const Texture& texture)
{
    for (const auto& corners : texture.places) {
        fmt::memory_buffer& block = writer.block();
        for (const Eigen::Vector2f& place : corners) {
            fmt::format_to(fmt::appender(block), "vt {} {}\n", place.x(), 1.0F - place.y());
        }
    }
}

void put_faces(BlockWriter& writer, const TriMesh& mesh, const Texture& texture)
{
    for (std::size_t page = 0; page < texture.pages.size(); ++page) {
        fmt::format_to(fmt::appender(writer.block()), "usemtl page_{}\n", page);
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            if (texture.page_of_face[face] != page) continue;
            fmt::memory_buffer& block = writer.block();
            block.push_back('f');
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint64_t vertex = std::uint64_t{mesh.faces[face][i]} + 1;
                fmt::format_to(fmt::appender(block), " {}/{}", vertex, 3 * face + i + 1);
                if (!mesh.normals.empty()) fmt::format_to(fmt::appender(block), "/{}", vertex);
            }
            block.push_back('\n');
        }
    }
}

} // namespace

UnwrappedMesh unwrap(const TriMesh& mesh, const Texture& texture)
{
    UnwrappedMesh unwrapped;
    unwrapped.mesh.offset = mesh.offset;
    for (std::uint32_t page = 0; page < texture.pages.size(); ++page) {
        std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> vertices;
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            if (texture.page_of_face[face] != page) continue;
            Face& added = unwrapped.mesh.faces.emplace_back();
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t vertex = mesh.faces[face][i];
                const Eigen::Vector2f& place = texture.places[face][i];
                const auto number = static_cast<std::uint32_t>(unwrapped.places.size());
                const auto [found, is_new] =
                    vertices.try_emplace({vertex, place.x(), place.y()}, number);
                added[i] = found->second;
                if (!is_new) continue;
                unwrapped.places.push_back(place);
                unwrapped.mesh.positions.push_back(mesh.positions[vertex]);
                if (!mesh.normals.empty()) unwrapped.mesh.normals.push_back(mesh.normals[vertex]);
            }
        }
        unwrapped.begins.push_back(unwrapped.mesh.faces.size());
    }
    return unwrapped;
}

fs::path page_path(const fs::path& surface, std::size_t page)
{
    fs::path path = surface;
    return path.replace_filename(fmt::format("{}_{}.jpg", surface.stem().string(), page));
}

std::vector<fs::path> files_beside(const fs::path& surface, std::size_t pages)
{
    const std::string end = lower_case_end(surface);
    std::vector<fs::path> files;
    if (end == ".obj") files.push_back(materials_path(surface));
    for (std::size_t page = 0; end != ".glb" && page < pages; ++page) {
        files.push_back(page_path(surface, page));
    }
    return files;
}

void write_textured_obj(const fs::path& path, const TriMesh& mesh, const MeshFormat& format)
{
    std::deque<OutputFile> files;
    write_pages(path, *format.texture, files);
    write_materials(files.emplace_back(materials_path(path)).stream(), path, *format.texture);
    std::ostream& out = files.emplace_back(path).stream();
    TriMesh uncolored = mesh;
    uncolored.colors.clear(); // some viewers multiply the texture by them
    uncolored.faces.clear();
    write_obj(out, uncolored, format);
    out << "mtllib " << materials_path(path).filename().string() << '\n';
    {
        BlockWriter writer(out);
        put_places(writer, *format.texture);
        put_faces(writer, mesh, *format.texture);
    }
    commit(files);
}

void write_textured_ply(const fs::path& path, const TriMesh& mesh, const MeshFormat& format)
{
    std::deque<OutputFile> files;
    write_pages(path, *format.texture, files);
    std::vector<std::string> names;
    for (std::size_t page = 0; page < format.texture->pages.size(); ++page) {
        names.push_back(page_path(path, page).filename().string());
    }
    write_ply(files.emplace_back(path).stream(), mesh, format, names);
    commit(files);
}

} // namespace vcarve
