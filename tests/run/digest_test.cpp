#include "run/digest.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>

namespace vcarve::digest_test {
namespace {

/// Longer than two blocks.
std::string long_text()
{
    std::string text((2U << 20) + 5, ' ');
    for (std::size_t i = 0; i < text.size(); ++i) {
        text[i] = static_cast<char>(i * 7 + (i >> 8));
    }
    return text;
}

} // namespace

// The expected digests are from Python's hashlib. They must not change, as work folders persist.
TEST(Digest, ChainsTheMd5OfWholeMebibytes)
{
    EXPECT_EQ(digest_text(digest_of(std::string())), "4ae71336e44b39bfb9d2752e234818a5");
    EXPECT_EQ(digest_text(digest_of(std::string("abc"))), "522ec739ca633ec5b08208ce08ad65e2");
    EXPECT_EQ(digest_text(digest_of(long_text())), "b9e93c4968153d3f8956e75c0c78da4d");
}

TEST(Digest, DoesNotDependOnTheSizesOfPieces)
{
    const std::string text = long_text();
    for (const std::size_t most : {1000UL, (1UL << 20) - 1, 1UL << 20, 3UL << 19}) {
        RunningDigest digest;
        for (std::size_t at = 0; at < text.size(); at += most) {
            digest.add(std::span(text).subspan(at, std::min(most, text.size() - at)));
        }
        EXPECT_EQ(digest.value(), digest_of(text)) << most;
    }
}

TEST(Digest, DiffersIfAnyByteDiffers)
{
    const std::string text = long_text();
    const Digest whole = digest_of(text);
    for (const std::size_t at : {0UL, 1UL << 20, (2UL << 20) - 1, text.size() - 1}) {
        std::string other = text;
        other[at] = static_cast<char>(other[at] ^ 1);
        EXPECT_NE(digest_of(other), whole) << at;
    }
    EXPECT_NE(digest_of(text.substr(0, text.size() - 1)), whole);
}

TEST(Digest, IsTheSameForAFileAndItsBytes)
{
    const TemporaryFolder folder;
    const std::string text = long_text();
    EXPECT_EQ(digest_of_file(folder.write("a", text)), digest_of(text));
    EXPECT_EQ(digest_of_file(folder.write("b", "")), digest_of(std::string()));
    EXPECT_EQ(refusal<InputError>([&] { digest_of_file(folder / "c"); }),
              (folder / "c").string() + ": the file does not exist");
}

} // namespace vcarve::digest_test
