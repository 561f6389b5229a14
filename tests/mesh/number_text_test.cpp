// SPDX-License-Identifier: Apache-2.0
//
// Numbers in text as Fortran and other programs write them, in every format of text.
#include "small_files.h"

namespace tetralux::mesh {
namespace {

using namespace test;

/// The small mesh of a kind with the last values of its field (4, 5, 10 on points 3 to 5) in other words.
std::string withValues(const std::string& source, const std::string& old, const std::string& with,
                       const TemporaryFolder& folder) {
    SmallMesh mesh = smallMesh(source);
    bool found = false;
    for (SmallFile& file : mesh.files) {
        if (!found && file.content.find(old) != std::string::npos) {
            file.content = replaced(file.content, old, with);
            found = true;
        }
    }
    EXPECT_TRUE(found) << source;
    return written(mesh, folder);
}

struct Spelling {
    const char *source, *old, *fortran, *stars, *none;
};
const std::array spellings{
    Spelling{"a.vtu", "1 3 4 5 10<", "1 3.d0 +4.0D+00 1.5-101 +1.000Q+001<", "1 3 4 ***** 10<", "1 3 4 NaN -inf<"},
    Spelling{"a.vtk", "1 3 4 5 10\n", "1 3.d0 +4.0D+00 1.5-101 +1.000Q+001\n", "1 3 4 ***** 10\n", "1 3 4 NaN -inf\n"},
    Spelling{"a.msh", "2 3\n3 4\n4 5\n5 10\n", "2 3.d0\n3 +4.0D+00\n4 1.5-101\n5 +1.000Q+001\n",
             "2 3\n3 4\n4 *****\n5 10\n", "2 3\n3 4\n4 NaN\n5 -inf\n"},
    Spelling{"a.mesh", "3\n4\n5\n10\n", "3.d0\n+4.0D+00\n1.5-101\n+1.000Q+001\n", "3\n4\n*****\n10\n",
             "3\n4\nNaN\n-inf\n"},
    Spelling{"a.ele", "0 0 3\n3 0 1 0 4\n4 0 0 1 5\n5 1 1 1 10\n",
             "0 0 3.d0\n3 0 1 0 +4.0D+00\n4 0 0 1 1.5-101\n5 1 1 1 +1.000Q+001\n",
             "0 0 3\n3 0 1 0 4\n4 0 0 1 *****\n5 1 1 1 10\n", "0 0 3\n3 0 1 0 4\n4 0 0 1 NaN\n5 1 1 1 -inf\n"},
    Spelling{"a.inp", "2 3\n3 4\n4 5\n5 10\n", "2 3.d0\n3 +4.0D+00\n4 1.5-101\n5 +1.000Q+001\n",
             "2 3\n3 4\n4 *****\n5 10\n", "2 3\n3 4\n4 NaN\n5 -inf\n"},
    Spelling{"a.case", " 3.00000e+00\n 4.00000e+00\n 5.00000e+00\n 1.00000e+01\n",
             " 3.d0\n +4.0D+00\n 1.5-101\n +1.000Q+001\n", " 3.0\n 4.0\n *****\n 10.0\n", " 3.0\n 4.0\n NaN\n -inf\n"},
};

std::vector<double> valuesOf(const std::string& source) {
    ReadResult result = readMesh(source);
    for (const Field& field : result.mesh.fields) {
        if (field.association == Association::Point) {
            return field.values;
        }
    }
    ADD_FAILURE() << source;
    return {};
}

TEST(NumberText, NumbersOfFortranInEveryTextFormat) {
    for (const Spelling& spelling : spellings) {
        SCOPED_TRACE(spelling.source);
        const TemporaryFolder folder;
        const std::vector<double> values =
            valuesOf(withValues(spelling.source, spelling.old, spelling.fortran, folder));
        ASSERT_EQ(values.size(), 5u);
        // UCD and EnSight hold floats.
        const double tiny = values[3] == 0.0 ? 0.0 : 1.5e-101;
        EXPECT_EQ(values, (std::vector<double>{1.0, 3.0, 4.0, tiny, 10.0}));
        EXPECT_TRUE(tiny != 0.0 || std::string(spelling.source) == "a.inp" || std::string(spelling.source) == "a.case");
    }
}

TEST(NumberText, WhatIsNoNumberIsNamedWithItsLine) {
    for (const Spelling& spelling : spellings) {
        SCOPED_TRACE(spelling.source);
        const TemporaryFolder folder;
        const std::string text =
            errorOf([&] { readMesh(withValues(spelling.source, spelling.old, spelling.stars, folder)); });
        EXPECT_NE(text.find("'*****'"), std::string::npos) << text;
        EXPECT_NE(text.find("line "), std::string::npos) << text;
        EXPECT_EQ(text.find("damaged"), std::string::npos) << text;
    }
    const TemporaryFolder folder;
    expectError([&] { readMesh(withValues("a.vtu", "5 10<", "5 1e400<", folder)); }, "line 3: '1e400' stands where");
    expectError([&] { readMesh(withValues("a.vtk", "4 5 10\n", "4 5 1e400\n", folder)); }, "line 15: '1e400'");
    expectError([&] { readMesh(withValues("a.msh", "5 10\n", "5 1e400\n", folder)); }, "'1e400'");
}

/// Missing values stay missing: the cells that need them are left out and counted.
TEST(NumberText, ValuesThatAreNotFiniteAreCountedInEveryTextFormat) {
    for (const Spelling& spelling : spellings) {
        SCOPED_TRACE(spelling.source);
        const TemporaryFolder folder;
        ReadResult result = readMesh(withValues(spelling.source, spelling.old, spelling.none, folder));
        std::erase_if(result.mesh.fields, [](const Field& f) { return f.association != Association::Point; });
        ASSERT_EQ(result.mesh.fields.size(), 1u);
        const std::vector<double>& values = result.mesh.fields[0].values;
        EXPECT_EQ(values[2], 4.0);
        EXPECT_TRUE(std::isnan(values[3]));
        EXPECT_EQ(values[4], -std::numeric_limits<double>::infinity());
        EXPECT_EQ(result.mesh.cells.size(), 2u);
        expectError([&] { selectScalar(std::move(result.mesh), "", result.report); }, "is NaN, infinite");
        EXPECT_EQ(countOf(result.report, Defect::NonFiniteScalar), 2u);
    }
}

/// Floats in text may hold more than a float does; numbers below any double are 0.
TEST(NumberText, NumbersBeyondTheirTypeAreNumbers) {
    const TemporaryFolder folder;
    const std::string single = replaced(smallVtu(), "Float64", "Float32");
    for (const char* order : {"LittleEndian", "BigEndian"}) {
        const std::string text = replaced(replaced(single, "LittleEndian", order), "5 10<", "1e-400 1e39<");
        const std::vector<double> values = valuesOf(folder.write("a.vtu", text));
        EXPECT_EQ(values[3], 0.0);
        EXPECT_EQ(values[4], 1e39);
    }
    EXPECT_EQ(valuesOf(withValues("a.vtk", "s double 1\nLOOKUP_TABLE default\n1 3 4 5 10",
                                  "s float 1\nLOOKUP_TABLE default\n1 3 4 5 1e39", folder))[4],
              1e39);
}

}  // namespace
}  // namespace tetralux::mesh
