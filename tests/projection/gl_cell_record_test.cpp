// SPDX-License-Identifier: Apache-2.0
//
// CellRecord is written by C++ and read by GLSL: each field by name must be the same one on either side.
#include <cstddef>
#include <cstring>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include <projection/cells/cell_setup.h>
#include <projection/gl/gl_cell_stream.h>
#include <projection/gl/gl_functions.h>
#include <projection/gl/gl_shader_text.h>

namespace tetralux::projection {
namespace {

static_assert(sizeof(CellRecord) == 6 * 4 * sizeof(float));
static_assert(sizeof(CellGradient) == 4 * sizeof(float));
static_assert(std::is_trivially_copyable_v<CellRecord>);

constexpr const char* echoMain = R"glsl(
layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer In { vec4 records[]; };
layout(std430, binding = 1) writeonly buffer Out { float fields[]; };
void main() {
    CellRecord cell = unpackRecord(records[0], records[1], records[2], records[3], records[4], records[5]);
    for (int k = 0; k < 4; ++k) {
        for (int i = 0; i < 3; ++i) fields[3 * k + i] = cell.plane[k][i];
    }
    fields[12] = float(cell.frontMask);
    fields[13] = cell.pixel.x;
    fields[14] = cell.pixel.y;
    fields[15] = cell.fraction.x;
    fields[16] = cell.fraction.y;
    fields[17] = cell.scalar;
    fields[18] = cell.scalarPerX;
    fields[19] = cell.scalarPerY;
    fields[20] = cell.scalarPerInverseDepth;
    fields[21] = cell.scalarLow;
    fields[22] = cell.scalarHigh;
    fields[23] = cell.scale;
}
)glsl";

// The record's fields as the shader names them, in the order of the struct.
std::array<float, 24> echoed(const GlFunctions& gl, const CellRecord& record) {
    const std::string source =
        "#version 430 core\n" + std::string(glShaderText("projection/gl/gl_cell_record.glsl")) + echoMain;
    const char* text = source.c_str();
    const GLuint program = gl.CreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    EXPECT_EQ(linked, GL_TRUE);
    GLuint buffers[2];
    gl.GenBuffers(2, buffers);
    std::array<float, 24> fields{};
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
    gl.BufferData(GL_SHADER_STORAGE_BUFFER, sizeof(record), &record, GL_STATIC_DRAW);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers[1]);
    gl.BufferData(GL_SHADER_STORAGE_BUFFER, sizeof(fields), nullptr, GL_STATIC_READ);
    gl.UseProgram(program);
    gl.DispatchCompute(1, 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof(fields), fields.data());
    gl.DeleteBuffers(2, buffers);
    gl.UseProgram(0);
    gl.DeleteProgram(program);
    checkGl(gl, "echo");
    return fields;
}

TEST(GlCellRecord, GlslReadsTheFieldsThatCppWrites) {
    CellRecord record;
    for (int k = 0; k < 4; ++k) {
        for (int i = 0; i < 3; ++i) record.plane[k][i] = static_cast<float>(100 + 3 * k + i);
    }
    record.frontMask = 13;
    record.pixelX = 201;
    record.pixelY = 202;
    record.fractionX = 0.25f;
    record.fractionY = 0.375f;
    record.scalar = 301;
    record.scalarPerX = 302;
    record.scalarPerY = 303;
    record.scalarPerInverseDepth = 304;
    record.scalarLow = 305;
    record.scalarHigh = 306;
    record.scale = 401;
    const auto context = makeGlContext("auto");
    const CurrentGlContext current(*context);
    const auto gl = loadGlFunctions(*context);
    const std::array<float, 24> expected{100, 101, 102, 103,   104,    105, 106, 107, 108, 109, 110, 111,
                                         13,  201, 202, 0.25f, 0.375f, 301, 302, 303, 304, 305, 306, 401};
    EXPECT_EQ(echoed(*gl, record), expected);
}

// The block that a cell takes in the vertex buffer: corners 1, 2, 3, 0, record, gradient (gl_cell_stream.h).
TEST(GlCellRecord, VertexBlockHasTheDocumentedOrder) {
    const CellOutline outline{glm::vec2(0, 1), {2, 3}, {4, 5}, {6, 7}};
    CellRecord record;
    std::array<float, 24> values;
    std::iota(values.begin(), values.end(), 10.0f);
    std::memcpy(&record, values.data(), sizeof(record));
    const CellGradient gradient{{50, 51, 52}, 53};
    const GlCellLayout layout{true};
    std::vector<float> block(layout.floats());
    writeCell(layout, outline, record, gradient, {}, block.data());
    std::vector<float> expected{2, 3, 4, 5, 6, 7, 0, 1};
    expected.insert(expected.end(), values.begin(), values.end());
    expected.insert(expected.end(), {50, 51, 52, 53});
    EXPECT_EQ(block, expected);
}

}  // namespace
}  // namespace tetralux::projection
