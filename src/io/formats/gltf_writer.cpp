// glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "io/files/block_writer.h"
#include "io/files/comment_lines.h"
#include "io/formats/mesh_file.h"
#include "io/formats/unwrap.h"
#include "io/images/encode_image.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::uint64_t kMostBytes = 0xffffffffU - 0x10000U; ///< the rest is left to the JSON text

/// What glTF calls an accessor: numbers of the file's buffer, and how they are to be read.
struct Layout {
    int component_type;
    int type;
    int target;
    bool normalized = false;
};
constexpr Layout kVectors = {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                             TINYGLTF_TARGET_ARRAY_BUFFER};
constexpr Layout kColors = {TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                            TINYGLTF_TARGET_ARRAY_BUFFER, true};
constexpr Layout kPlaces = {TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2,
                            TINYGLTF_TARGET_ARRAY_BUFFER};
constexpr Layout kIndices = {TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                             TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER};

std::uint64_t buffer_bytes(const TriMesh& mesh)
{
    std::uint64_t vertex_bytes = 3 * sizeof(float);
    if (!mesh.normals.empty()) vertex_bytes += 3 * sizeof(float);
    if (!mesh.colors.empty()) vertex_bytes += 4 * sizeof(std::uint16_t);
    return mesh.positions.size() * vertex_bytes + mesh.faces.size() * sizeof(Face);
}

/// A model of one buffer, to which accessors are added one after the other. All their numbers fill
/// multiples of four bytes, so each begins where glTF wants it to.
class ModelBuilder {
  public:
    ModelBuilder() { model_.buffers.resize(1); }

    /// An accessor to `count` elements that the caller adds next; returns its index.
    int begin(const Layout& layout, std::size_t count)
    {
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = layout.component_type;
        accessor.type = layout.type;
        accessor.normalized = layout.normalized;
        accessor.count = count;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = model_.buffers[0].data.size();
        view.byteLength =
            count * static_cast<std::size_t>(
                        tinygltf::GetComponentSizeInBytes(
                            static_cast<std::uint32_t>(layout.component_type)) *
                        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(layout.type)));
        view.target = layout.target;
        model_.buffers[0].data.reserve(view.byteOffset + view.byteLength);
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    template <typename Number>
    void put(Number number)
    {
        const auto bytes = little_endian(number);
        auto& data = model_.buffers[0].data;
        data.insert(data.end(), bytes.begin(), bytes.end());
    }

    /// A file within the file; returns the index of its view of the buffer.
    int add_bytes(const std::vector<std::uint8_t>& bytes)
    {
        tinygltf::BufferView view;
        view.buffer = 0;
        auto& data = model_.buffers[0].data;
        view.byteOffset = data.size();
        view.byteLength = bytes.size();
        data.insert(data.end(), bytes.begin(), bytes.end());
        data.resize((data.size() + 3) / 4 * 4);
        model_.bufferViews.push_back(std::move(view));
        return static_cast<int>(model_.bufferViews.size()) - 1;
    }

    tinygltf::Model& model() { return model_; }

  private:
    tinygltf::Model model_;
};

/// Colours of photographs are sRGB, those of vertices in glTF are linear. With 16 bits all 256
/// values of a channel stay apart.
std::array<std::uint16_t, 256> linear_values()
{
    std::array<std::uint16_t, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double share = static_cast<double>(i) / 255.0;
        const double linear =
            share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
        values[i] = static_cast<std::uint16_t>(std::lround(65535.0 * linear));
    }
    return values;
}

/// Positions relative to `center`, and their box, which glTF asks for.
int add_positions(ModelBuilder& builder, const TriMesh& mesh, const Vector3d& center)
{
    const int accessor = builder.begin(kVectors, mesh.positions.size());
    Eigen::AlignedBox3f box;
    for (const Vector3d& position : mesh.positions) {
        const Vector3f rounded = (position - center).cast<float>();
        box.extend(rounded);
        for (const float coordinate : rounded) {
            builder.put(coordinate);
        }
    }
    auto& added = builder.model().accessors.back();
    added.minValues.assign(box.min().begin(), box.min().end());
    added.maxValues.assign(box.max().begin(), box.max().end());
    return accessor;
}

/// Normals must have length 1; a vertex that has none gets some.
int add_normals(ModelBuilder& builder, const std::vector<Vector3f>& normals)
{
    const int accessor = builder.begin(kVectors, normals.size());
    for (const Vector3f& normal : normals) {
        for (const float coordinate : normal.isZero() ? Vector3f::UnitZ().eval() : normal) {
            builder.put(coordinate);
        }
    }
    return accessor;
}

int add_colors(ModelBuilder& builder, const std::vector<Color>& colors)
{
    const int accessor = builder.begin(kColors, colors.size());
    const auto linear = linear_values();
    for (const Color& color : colors) {
        for (const std::uint8_t channel : color) {
            builder.put(linear[channel]);
        }
        builder.put(std::uint16_t{0xffff}); // opaque
    }
    return accessor;
}

int add_places(ModelBuilder& builder, const std::vector<Eigen::Vector2f>& places)
{
    const int accessor = builder.begin(kPlaces, places.size());
    for (const Eigen::Vector2f& place : places) {
        for (const float coordinate : place) {
            builder.put(coordinate);
        }
    }
    return accessor;
}

int add_indices(ModelBuilder& builder, std::span<const Face> faces)
{
    const int accessor = builder.begin(kIndices, 3 * faces.size());
    for (const Face& face : faces) {
        for (const std::uint32_t vertex : face) {
            builder.put(vertex);
        }
    }
    return accessor;
}

/// Matt, and to be seen from both sides: the default would be metal that shows its front only.
tinygltf::Material matt()
{
    tinygltf::Material material;
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    material.doubleSided = true;
    return material;
}

/// What was subtracted, what now is y, and the comments, where there are any:
/// {"offset": [x, y, z], "up": [x, y, z], "comments": []}.
tinygltf::Value extras_json(const MeshFormat& format)
{
    tinygltf::Value::Object said;
    const auto say = [&](const char* word, const auto& items) {
        said[word] = tinygltf::Value(tinygltf::Value::Array(items.begin(), items.end()));
    };
    if (!format.offset.isZero(0.0)) say(kOffsetWord, format.offset);
    if (!format.up.isZero(0.0)) say("up", format.up);
    if (!format.comments.empty()) say("comments", format.comments);
    return tinygltf::Value(std::move(said));
}

/// A material that is matt and shows an image, which becomes a part of the file.
int add_page(ModelBuilder& builder, const Photograph& page)
{
    tinygltf::Model& model = builder.model();
    tinygltf::Image& image = model.images.emplace_back();
    image.bufferView = builder.add_bytes(encode_jpeg(page, kTextureQuality));
    image.mimeType = "image/jpeg";
    if (model.samplers.empty()) {
        tinygltf::Sampler& sampler = model.samplers.emplace_back();
        sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        sampler.wrapS = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    }
    tinygltf::Texture& texture = model.textures.emplace_back();
    texture.source = static_cast<int>(model.images.size()) - 1;
    texture.sampler = 0;
    model.materials.push_back(matt());
    model.materials.back().pbrMetallicRoughness.baseColorTexture.index =
        static_cast<int>(model.textures.size()) - 1;
    return static_cast<int>(model.materials.size()) - 1;
}

/// One mesh in one node, which moves the mesh back to where it belongs minus the offset, and turns
/// it upright. The faces of each page are drawn by themselves.
void add_mesh(ModelBuilder& builder, const TriMesh& mesh, const MeshFormat& format,
              const UnwrappedMesh* unwrapped)
{
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : mesh.positions) {
        box.extend(position);
    }
    const Vector3d center = box.center();
    tinygltf::Primitive triangles;
    triangles.mode = TINYGLTF_MODE_TRIANGLES;
    triangles.attributes["POSITION"] = add_positions(builder, mesh, center);
    if (!mesh.normals.empty()) {
        triangles.attributes["NORMAL"] = add_normals(builder, mesh.normals);
    }
    if (!mesh.colors.empty()) triangles.attributes["COLOR_0"] = add_colors(builder, mesh.colors);
    tinygltf::Model& model = builder.model();
    std::vector<tinygltf::Primitive> primitives;
    if (unwrapped == nullptr) {
        model.materials.push_back(matt());
        triangles.material = 0;
        triangles.indices = add_indices(builder, mesh.faces);
        primitives.push_back(std::move(triangles));
    } else {
        triangles.attributes["TEXCOORD_0"] = add_places(builder, unwrapped->places);
        for (std::size_t page = 0; page < format.texture->pages.size(); ++page) {
            const auto [first, last] =
                std::pair(unwrapped->begins[page], unwrapped->begins[page + 1]);
            triangles.indices =
                add_indices(builder, std::span(mesh.faces).subspan(first, last - first));
            triangles.material = add_page(builder, format.texture->pages[page]);
            primitives.push_back(triangles);
        }
    }
    model.meshes.emplace_back().primitives = std::move(primitives);
    tinygltf::Node& node = model.nodes.emplace_back();
    Vector3d translation = mesh.offset - format.offset + center;
    if (!format.up.isZero(0.0)) {
        const auto turn = Eigen::Quaterniond::FromTwoVectors(format.up, Vector3d::UnitY());
        node.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
        translation = turn * translation;
    }
    node.translation.assign(translation.begin(), translation.end());
    node.mesh = 0;
    model.scenes.emplace_back().nodes.push_back(0);
    model.defaultScene = 0;
}

} // namespace

void require_glb_room(std::uint64_t bytes)
{
    if (bytes <= kMostBytes) return;
    throw UsageError(fmt::format("the surface takes {} bytes, and binary glTF holds at most {}; "
                                 "PLY holds more",
                                 bytes, kMostBytes));
}

void write_glb(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    require_glb_room(buffer_bytes(mesh));
    ModelBuilder builder;
    tinygltf::Model& model = builder.model();
    model.asset.version = "2.0";
    if (!format.comments.empty()) model.asset.generator = format.comments.front();
    const tinygltf::Value said = extras_json(format);
    if (said.Size() > 0) model.asset.extras = said;
    if (mesh.faces.empty()) {
        model.buffers.clear(); // glTF knows no empty buffers, meshes or scenes
    } else {
        std::optional<UnwrappedMesh> unwrapped;
        if (format.texture != nullptr) unwrapped = unwrap(mesh, *format.texture);
        add_mesh(builder, unwrapped ? unwrapped->mesh : mesh, format,
                 unwrapped ? &*unwrapped : nullptr);
    }
    constexpr bool kIndented = false;
    constexpr bool kBinary = true;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, kIndented, kBinary);
}

} // namespace vcarve
