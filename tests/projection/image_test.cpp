// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <projection/image/image.h>
#include <projection/image/whole_file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

namespace tetralux::projection {
namespace {

namespace fs = std::filesystem;

class ImageFiles : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("tetralux-image-test-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::ptrdiff_t fileCount() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

    fs::path folder_;
};

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

/// Every float that a renderer may produce: tiny, above 1, negative, and different in each place.
Image unevenImage(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {1e-30f * static_cast<float>(x), 0.1f + static_cast<float>(y),
                              -0.25f * static_cast<float>(x + y), 1.0f / static_cast<float>(3 + x * y)};
    return image;
}

TEST_F(ImageFiles, ExrKeepsEveryFloat) {
    const Image image = unevenImage(37, 19);
    writeImage(image, path("a.exr"));
    const Image again = readImage(path("a.exr"));
    ASSERT_EQ(again.width, 37);
    ASSERT_EQ(again.height, 19);
    EXPECT_EQ(again.pixels, image.pixels);
    EXPECT_EQ(fileCount(), 1) << "the file written beside is gone";
}

TEST_F(ImageFiles, PngRoundsToTheNearestByteAndKeepsThePlace) {
    // One pixel per byte, moved by less than half a step: rounding must bring every one back.
    Image image(256, 3);
    const float shift[3] = {-0.49f, 0.0f, 0.49f};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 256; ++x) {
            const float value = (static_cast<float>(x) + shift[y]) / 255.0f;
            image.at(x, y) = {value, 1.0f - static_cast<float>(x) / 255.0f, static_cast<float>(y) / 255.0f, 1.0f};
        }
    writeImage(image, path("a.png"));
    const Image again = readImage(path("a.png"));
    ASSERT_EQ(again.width, 256);
    ASSERT_EQ(again.height, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 256; ++x) {
            EXPECT_FLOAT_EQ(again.at(x, y).x * 255.0f, static_cast<float>(x));
            EXPECT_FLOAT_EQ(again.at(x, y).y * 255.0f, static_cast<float>(255 - x));
            EXPECT_FLOAT_EQ(again.at(x, y).z * 255.0f, static_cast<float>(y));
            EXPECT_EQ(again.at(x, y).w, 1.0f);
        }
}

TEST_F(ImageFiles, PngHoldsWhatIsOutsideZeroToOne) {
    Image image(4, 1);
    image.pixels = {{-1, 2, 0, 1}, {-1e30f, 1e30f, -0.0f, 1}, {0.25f, 0.5f, 0, 0.5f}, {0, 0, 0, 0}};
    writeImage(image, path("a.png"));
    const Image again = readImage(path("a.png"));
    EXPECT_EQ(again.at(0, 0), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(again.at(1, 0), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(again.at(2, 0), glm::vec4(64 / 255.0f, 128 / 255.0f, 0, 1)) << "premultiplied over black";
    EXPECT_EQ(again.at(3, 0), glm::vec4(0, 0, 0, 1));
}

TEST_F(ImageFiles, WhatIsNotFiniteIsNotWritten) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float value : {std::nanf(""), infinity, -infinity})
        for (const char* name : {"a.png", "a.exr"}) {
            Image image(2, 2);
            image.at(1, 0).g = value;
            EXPECT_NE(messageOf([&] { writeImage(image, path(name)); }).find("the first at (1, 0)"), std::string::npos);
            EXPECT_FALSE(std::filesystem::exists(path(name)));
        }
}

TEST_F(ImageFiles, EndingsChooseTheFormatInEitherCase) {
    writeImage(Image(2, 2), path("a.PNG"));
    std::ifstream file(path("a.PNG"), std::ios::binary);
    char start[4] = {};
    file.read(start, 4);
    EXPECT_EQ(std::string(start + 1, 3), "PNG");
    EXPECT_NE(messageOf([&] { writeImage(Image(2, 2), path("a.jpg")); }).find("use .png or .exr"), std::string::npos);
    EXPECT_NE(messageOf([&] { checkImagePath(path("a")); }).find("use .png or .exr"), std::string::npos);
}

TEST_F(ImageFiles, WhatCannotBeWrittenIsToldBeforehandAndLeavesNothing) {
    std::ofstream(path("file")) << "not a folder";
    fs::create_directory(path("folder.png"));
    for (const std::string& bad :
         {path("missing/a.png"), path("file/a.png"), path("folder.png"), std::string("/proc/a.png")}) {
        const std::string message = messageOf([&] { checkImagePath(bad); });
        EXPECT_EQ(message.rfind(bad + ": ", 0), 0u) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
        EXPECT_EQ(messageOf([&] { writeImage(Image(2, 2), bad); }), message);
    }
    EXPECT_EQ(fileCount(), 2);
    EXPECT_EQ(messageOf([&] { checkImagePath(path("good.exr")); }), "");
    EXPECT_EQ(fileCount(), 2) << "checking leaves no file";
}

TEST_F(ImageFiles, CheckingLeavesAnOldFileAlone) {
    writeImage(unevenImage(3, 3), path("a.exr"));
    checkImagePath(path("a.exr"));
    EXPECT_EQ(readImage(path("a.exr")).pixels, unevenImage(3, 3).pixels);
}

TEST_F(ImageFiles, AFullDiskLeavesTheOldFileAndNoHalfOne) {
    writeImage(Image(2, 2), path("a.exr"));
    // A limit on file size stands for the full disk: write() fails in the middle, as it does there.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 4096;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    Image noise(200, 200);
    unsigned state = 1;
    for (glm::vec4& pixel : noise.pixels)
        for (int channel = 0; channel < 4; ++channel) {
            state = state * 1664525u + 1013904223u;
            pixel[channel] = static_cast<float>(state) / 4.3e9f;
        }
    const std::string message = messageOf([&] { writeImage(noise, path("a.exr")); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_NE(message.find("cannot be written"), std::string::npos) << message;
    EXPECT_EQ(fileCount(), 1);
    EXPECT_EQ(readImage(path("a.exr")).width, 2);
}

TEST_F(ImageFiles, ASymbolicLinkIsFollowed) {
    writeImage(Image(1, 1), path("real.exr"));
    fs::create_symlink("real.exr", path("link.exr"));
    writeImage(unevenImage(2, 2), path("link.exr"));
    EXPECT_TRUE(fs::is_symlink(path("link.exr")));
    EXPECT_EQ(readImage(path("real.exr")).pixels, unevenImage(2, 2).pixels);
}

TEST_F(ImageFiles, BrokenFilesAreNamed) {
    writeImage(unevenImage(16, 16), path("whole.exr"));
    writeImage(unevenImage(16, 16), path("whole.png"));
    for (const char* ending : {".exr", ".png"}) {
        std::ifstream whole(path("whole" + std::string(ending)), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(whole), std::istreambuf_iterator<char>()};
        for (const std::size_t length : {std::size_t{0}, std::size_t{5}, bytes.size() / 3, bytes.size() - 20}) {
            const std::string cut = path("cut" + std::string(ending));
            std::ofstream(cut, std::ios::binary) << bytes.substr(0, length);
            const std::string message = messageOf([&] { readImage(cut); });
            EXPECT_EQ(message.rfind(cut + ": is not a readable", 0), 0u) << length << ": " << message;
            EXPECT_EQ(message.find('\n'), std::string::npos);
        }
    }
    EXPECT_NE(messageOf([&] { readImage(path("missing.exr")); }).find("cannot be opened"), std::string::npos);
}

TEST(CompareImages, KnownDifferences) {
    // 1000 pixels, two of them apart: 0.5 in one channel, 0.1 in all four.
    Image a(100, 10), b(100, 10);
    b.at(3, 4) = {0, 0.5f, 0, 0};
    b.at(99, 9) = {0.1f, 0.1f, 0.1f, 0.1f};
    const ImageDifference difference = compareImages(a, b);
    EXPECT_DOUBLE_EQ(difference.max, 0.5);
    EXPECT_NEAR(difference.rmse, std::sqrt((0.25 + 4 * 0.01) / 4000.0), 1e-9);
    EXPECT_NEAR(difference.psnr, 20.0 * std::log10(1.0 / difference.rmse), 1e-9);
    EXPECT_NEAR(difference.percentile999, 0.1, 1e-7) << "999 of 1000 pixels differ by 0.1 at most";
}

TEST(CompareImages, EqualImages) {
    const ImageDifference difference = compareImages(unevenImage(7, 5), unevenImage(7, 5));
    EXPECT_EQ(difference.rmse, 0.0);
    EXPECT_EQ(difference.max, 0.0);
    EXPECT_EQ(difference.psnr, std::numeric_limits<double>::infinity());
}

TEST(CompareImages, NotANumberDiffersFromEverything) {
    Image a(2, 1), b(2, 1);
    b.at(1, 0).x = std::nanf("");
    EXPECT_EQ(compareImages(a, b).max, std::numeric_limits<double>::infinity());
    EXPECT_EQ(compareImages(b, b).max, std::numeric_limits<double>::infinity());
}

TEST(CompareImages, SizesMustAgree) {
    EXPECT_NE(messageOf([] { compareImages(Image(2, 3), Image(3, 2)); }).find("2x3 and 3x2"), std::string::npos);
}

TEST(PutUnder, ComposesPremultipliedColour) {
    Image image(2, 1);
    image.pixels = {{0.3f, 0.2f, 0.1f, 0.5f}, {0, 0, 0, 0}};
    putUnder(image, {1, 0.5f, 0});
    EXPECT_EQ(image.at(0, 0), glm::vec4(0.8f, 0.45f, 0.1f, 1));
    EXPECT_EQ(image.at(1, 0), glm::vec4(1, 0.5f, 0, 1));
}

}  // namespace
}  // namespace tetralux::projection
