#include "io/files/foreign_file.h"
#include "io/files/mapped_file.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <string>

namespace vcarve::foreign_file_test {
namespace {

std::string refusal_of(const std::string& content)
{
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("cameras.bin", content);
    try {
        const MappedFile file(path);
    } catch (const InputError& error) {
        const std::string sentence = error.what();
        return sentence.substr(sentence.find("cameras.bin"));
    }
    return "accepted";
}

std::string refusal_of_name(const std::string& name)
{
    try {
        refuse_foreign_name(name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(ForeignFile, IsRecognizedByItsFirstBytes)
{
    EXPECT_EQ(refusal_of("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n"),
              "cameras.bin is a Git LFS pointer, not the file: run git lfs pull");
    EXPECT_EQ(refusal_of("<!DOCTYPE HTML><html>"),
              "cameras.bin is a web page, not the file: download it again");
    EXPECT_EQ(refusal_of("<HTML lang=en>"),
              "cameras.bin is a web page, not the file: download it again");
    EXPECT_EQ(refusal_of("PK\x03\x04 and so on"), "cameras.bin is a zip archive: unpack it first");
    EXPECT_EQ(refusal_of("\x1f\x8b\x08"), "cameras.bin is a gzip archive: unpack it first");
}

TEST(ForeignFile, AcceptsFilesWithASimilarBeginning)
{
    for (const std::string content : {"", "version", "PK", "# Camera list", "ply\n"}) {
        EXPECT_EQ(refusal_of(content), "accepted") << content;
    }
}

TEST(ForeignFile, IsRecognizedByItsExtension)
{
    EXPECT_EQ(refusal_of_name("a/scan.LAS"),
              "a/scan.LAS: scans of this format are not supported; run: pdal translate a/scan.LAS "
              "a/scan.LAS.ply");
    EXPECT_EQ(
        refusal_of_name("s.mvs"),
        "s.mvs: scenes of OpenMVS are not supported; run: InterfaceCOLMAP -i s.mvs -o FOLDER, "
        "and give FOLDER");
    EXPECT_EQ(refusal_of_name("d.xyz"),
              "d.xyz: text clouds are not supported; run: pdal translate --reader readers.text "
              "--readers.text.header=\"X Y Z\" d.xyz d.xyz.ply (list all columns in the header)");
    EXPECT_EQ(refusal_of_name("e.nvm"),
              "e.nvm: models of VisualSFM are not supported; run: kapture_import_nvm.py -i e.nvm "
              "-im IMAGES -o KAPTURE --add-reconstruction, then: kapture_export_colmap.py -i "
              "KAPTURE -db KAPTURE/colmap.db -txt FOLDER, and give FOLDER");
    for (const char* const name : {"a.laz", "b.e57", "c.pcd", "bundle.out", "b/list.OUT"}) {
        EXPECT_NE(refusal_of_name(name), "accepted") << name;
    }
    EXPECT_EQ(refusal_of_name("mesh.obj"),
              "mesh.obj: is a mesh; expected a model or a point cloud");
    EXPECT_EQ(refusal_of_name("cloud.ply"), "accepted");
    EXPECT_EQ(refusal_of_name("cloud"), "accepted");
}

} // namespace
} // namespace vcarve::foreign_file_test
