// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include <projection/gl/gl_context.h>
#include <projection/gl/gl_functions.h>

namespace tetralux::projection {
namespace {

// Draws nothing but a clear colour into a framebuffer of its own and reads it back.
float clearedValue(GlContext& context, float value) {
    const CurrentGlContext current(context);
    const auto gl = loadGlFunctions(context);
    GLuint texture = 0, framebuffer = 0;
    gl->GenTextures(1, &texture);
    gl->BindTexture(GL_TEXTURE_2D, texture);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, 4, 4);
    gl->GenFramebuffers(1, &framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    gl->ClearColor(value, 0, 0, 0);
    gl->Clear(GL_COLOR_BUFFER_BIT);
    float pixel[4] = {-1, -1, -1, -1};
    gl->ReadPixels(3, 3, 1, 1, GL_RGBA, GL_FLOAT, pixel);
    gl->DeleteFramebuffers(1, &framebuffer);
    gl->DeleteTextures(1, &texture);
    checkGl(*gl, "clear");
    return pixel[0];
}

TEST(GlContext, NamesAutoFirst) {
    EXPECT_EQ(glContextNames(), (std::vector<std::string>{"auto", "egl", "osmesa"}));
}

TEST(GlContext, UnknownNameListsTheKnownOnes) {
    try {
        makeGlContext("glx");
        FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "context 'glx': no such kind; choose one of auto, egl, osmesa");
    }
}

class GlContextKind : public testing::TestWithParam<std::string> {};

TEST_P(GlContextKind, DrawsAndReadsBack) {
    const auto context = makeGlContext(GetParam());
    EXPECT_EQ(clearedValue(*context, 0.3125f), 0.3125f);
    EXPECT_EQ(clearedValue(*context, 7.5f), 7.5f);  // made current a second time
}

TEST_P(GlContextKind, OneAfterTheOther) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(clearedValue(*makeGlContext(GetParam()), 0.25f), 0.25f);
}

INSTANTIATE_TEST_SUITE_P(All, GlContextKind, testing::ValuesIn(glContextNames()),
                         [](const auto& suite) { return suite.param; });

// EGL's and OSMesa's contexts would draw into each other's targets if one stayed current.
TEST(GlContext, KindsAlternateInOneThread) {
    const auto egl = makeGlContext("egl"), osmesa = makeGlContext("osmesa"), other = makeGlContext("egl");
    for (int i = 0; i < 3; ++i) {
        const float value = static_cast<float>(i) + 0.5f;
        EXPECT_EQ(clearedValue(*egl, value), value);
        EXPECT_EQ(clearedValue(*osmesa, value + 0.25f), value + 0.25f);
        EXPECT_EQ(clearedValue(*other, value + 8), value + 8);
    }
}

}  // namespace
}  // namespace tetralux::projection
