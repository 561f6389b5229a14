// SPDX-License-Identifier: Apache-2.0
//
// Image volumes whose value is linear in i, j and k, in every form, and where they lie.
#include <mesh/io/parse_mesh.h>
#include <mesh/io/read_mesh.h>

#include <mesh/soup/validation.h>

#include <fmt/format.h>

#include "damage.h"
#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using namespace test;

std::string noFile(const std::string& file) {
    throw std::runtime_error("no file " + file);
}

/// 3 x 2 x 2 points.
std::string nrrd(const std::string& lines, const std::string& values) {
    return "NRRD0004\n# remark\nkey:=value\ndimension: 3\nsizes: 3 2 2\n" + lines + "\n" + values;
}

double indexField(double i, double j, double k) {
    return 1.0 + 2.0 * i + 3.0 * j + 4.0 * k;
}

std::string fromHex(const std::string& digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
        bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    }
    return bytes;
}

/// The values as big-endian floats, by gzip.
const std::string zipped =
    fromHex("1f8b0800000000000203b36f6060707000e205400c621f6060706480f21f00d90210bea3021003d50100902f58cf30000000");
const std::string text = "1 3 5 4 6 8 5 7 9 8 10 12";

TEST(Nrrd, EveryEncodingGivesTheSameVolume) {
    std::string shorts, digits;
    for (const int value : {1, 3, 5, 4, 6, 8, 5, 7, 9, 8, 10, 12}) {
        shorts += std::string("\0", 1) + static_cast<char>(value);
        digits += fmt::format("{:02X}\n", value);
    }
    for (const std::string& bytes :
         {nrrd("type: float\nencoding: ascii\n", text), nrrd("type: short\nencoding: raw\nendian: big\n", shorts),
          nrrd("type: uint16\nencoding: raw\nendian: big\nbyte skip: -1\n", "anything" + shorts),
          nrrd("type: uint16\nencoding: raw\nendian: big\nline skip: 1\nbyte skip: 2\n", "a line\n.." + shorts),
          nrrd("type: unsigned char\nencoding: hex\n", digits),
          nrrd("type: float\nencoding: gzip\nendian: big\n", zipped)}) {
        const ReadResult result = tetMeshFromSoup(parseNrrd(bytes, "a.nrrd", noFile));
        EXPECT_TRUE(result.report.defects.empty());
        EXPECT_NEAR(totalVolume(result.mesh), 2.0, 1e-14);
        EXPECT_LT(largestError(result.mesh, [](const glm::dvec3& x) { return indexField(x.x, x.y, x.z); }), 1e-12);
    }
}

TEST(Nrrd, DirectionsPutItInItsPlaceAndAMirrorIsNoFault) {
    const std::string bytes = nrrd(
        "type: float\nencoding: text\nspace: left-posterior-superior\nspace directions: (0,1,0) ( 2, 0, 0 ) "
        "(0,0,1)\nspace origin: (10,20,30)\n",
        text);
    const ReadResult result = tetMeshFromSoup(parseNrrd(bytes, "a.nrrd", noFile));
    EXPECT_TRUE(result.report.defects.empty());
    EXPECT_NEAR(totalVolume(result.mesh), 4.0, 1e-13);
    EXPECT_LT(largestError(result.mesh,
                           [](const glm::dvec3& x) { return indexField(x.y - 20.0, (x.x - 10.0) / 2.0, x.z - 30.0); }),
              1e-12);
    const ReadResult spaced =
        tetMeshFromSoup(parseNrrd(nrrd("type: float\nencoding: text\nspacings: 1 nan 3\n", text), "a.nrrd", noFile));
    EXPECT_NEAR(totalVolume(spaced.mesh), 6.0, 1e-13);
}

TEST(Nrrd, VectorsDetachedValuesAndWhatIsNotRead) {
    const std::string vectors =
        "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\nencoding: raw\nkinds: vector domain domain domain\n\n"
        "\1\2\3\4\5\6\7\10\11\12\13\14\15\16\17\20";
    const CellSoup soup = parseNrrd(vectors, "a.nrrd", noFile);
    ASSERT_EQ(soup.fields.at(0).components, 2);
    EXPECT_EQ(soup.points.size(), 8u);
    EXPECT_EQ(soup.fields[0].values[3], 4.0);
    const auto readData = [](const std::string& file) { return file == "b c.txt" ? text : std::string(); };
    const std::string detached = nrrd("type: float\nencoding: text\ndata file: b c.txt\n", "");
    EXPECT_EQ(parseNrrd(detached, "a.nhdr", readData).fields.at(0).values.back(), 12.0);
    const auto refuses = [&](const std::string& bytes, const char* message) {
        expectError([&] { parseNrrd(bytes, "a.nrrd", noFile); }, message);
    };
    refuses("NRRF", "a.nrrd: does not begin as an NRRD file does");
    refuses(nrrd("type: block\n", ""), "its type 'block' is not known");
    refuses(nrrd("type: float\nencoding: bzip2\n", ""), "its encoding 'bzip2' is not read");
    refuses(nrrd("type: float\nencoding: raw\n", "abc"), "ends after 3 of 48 bytes");
    refuses(nrrd("type: float\nencoding: gzip\n", zipped.substr(0, 20)), "cannot be unpacked");
    refuses(nrrd("type: float\nencoding: raw\ndata file: LIST\n", ""), "in several files");
    refuses("NRRD0001\ntype: float\ndimension: 4\nsizes: 4 4 4 20\nkinds: domain domain domain list\n\n",
            "holds 20 volumes");
    refuses("NRRD0001\ntype: float\ndimension: 2\nsizes: 4 4\n\n", "has 2 axes of space");
    refuses("NRRD0001\ntype: float\nsizes: 4000000 4000000 4000000\n\n", "its sizes are no numbers of points");
    refuses("NRRD0001\ntype: uchar\nsizes: 2000 2000 2000\nencoding: gzip\n\nshort", "of values");
}

TEST(Nrrd, DamagedCopiesAreReadOrRefused) {
    const TemporaryFolder folder;
    const std::string whole = nrrd("type: float\nencoding: gzip\nendian: big\nspacings: 1 2 3\n", zipped);
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        for (const Damage damage : damages) {
            const ReadingEnd end = readAll(folder.write("a.nrrd", damagedCopy(whole, damage, seed)));
            EXPECT_TRUE(end == ReadingEnd::Mesh || end == ReadingEnd::Refusal) << damageName(damage) << ' ' << seed;
        }
    }
}

/// A line of the matrix is the direction of an axis.
TEST(MetaImage, DirectionsPutItInItsPlace) {
    const TemporaryFolder folder;
    std::string bytes =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
        "False\nTransformMatrix = 0 1 0 1 0 0 0 0 1\nOffset = 1 2 3\nElementSpacing = 1 2 1\nDimSize = 3 2 "
        "2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
    for (const int value : {1, 3, 5, 4, 6, 8, 5, 7, 9, 8, 10, 12}) {
        bytes += static_cast<char>(value);
    }
    const ReadResult result = readMesh(folder.write("a.mha", bytes));
    EXPECT_TRUE(result.report.defects.empty());
    EXPECT_LT(largestError(result.mesh,
                           [](const glm::dvec3& x) { return indexField(x.y - 2.0, (x.x - 1.0) / 2.0, x.z - 3.0); }),
              1e-12);
}

}  // namespace
}  // namespace tetralux::mesh
