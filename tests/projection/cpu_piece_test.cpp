// SPDX-License-Identifier: Apache-2.0
//
// The polynomials of short pieces against the exact weights, and the transfer function's pieces against the function.
#include <cmath>

#include <gtest/gtest.h>

#include <preint/exact_integral.h>
#include <preint/glsl_prelude.h>
#include <projection/cpu_transfer.h>

namespace tetralux::glsl {
#include <projection/cpu_piece.glsl>
}

namespace tetralux::projection {
namespace {

TEST(CpuPiece, WeightsOfShortPieces) {
    for (int i = 0; i <= 200; ++i)
        for (int j = -50; j <= 50; ++j) {
            const double depth = i / 200.0, half = std::min(depth, 0.5) * j / 50.0;
            const auto exact = preint::linearPieceWeights(depth - half, depth + half);
            EXPECT_NEAR(glsl::pieceOpacity(depth), exact.frontWeight + exact.backWeight, 3e-7 * depth * depth + 1e-15);
            EXPECT_NEAR(glsl::pieceSkew(depth, half), exact.backWeight - exact.frontWeight, 1.4e-5)
                << depth << " " << half;
        }
}

TEST(CpuPiece, ThinPiecesKeepTheirPrecision) {
    for (double depth : {1e-4, 1e-8, 1e-12, 1e-30}) {
        EXPECT_NEAR(glsl::pieceOpacity(depth) / depth, 1.0, depth);
        // V → (d_b − d_f)/6
        EXPECT_NEAR(glsl::pieceSkew(depth, 0.5 * depth) / (depth / 6.0), 1.0, 1e-5 + 2 * depth);
    }
}

TEST(CpuPiece, FractionInvertsDepth) {
    for (double front : {0.0, 0.3, 5.0, 1e6})
        for (double back : {0.0, 0.2, 7.0, 1e9}) {
            const double whole = 0.5 * (front + back);
            for (int i = 1; i <= 4 && whole > 0; ++i) {
                const double wanted = 0.25 * i * whole, t = glsl::pieceFraction(front, back, wanted);
                EXPECT_NEAR(t * (front + 0.5 * t * (back - front)), wanted, 1e-7 * whole);
            }
        }
}

preint::TransferFunction withJumps() {
    preint::TransferFunction f;
    f.color = {{-0.5, {0, 0, 0}}, {0.2, {1, 0, 0}}, {0.5, {0, 1, 0}}, {0.5, {0, 0, 1}}, {1.5, {1, 1, 1}}};
    f.extinction = {{0.1, 1}, {0.3, 1}, {0.3, 5}, {0.6, 2}, {0.6, 0}, {0.8, 0}};
    f.isosurfaces = {{0.7, 0.5, {1, 1, 0}}, {0.9, 0.0, {1, 1, 0}}};
    return f;
}

TEST(CpuTransfer, PiecesFollowTheFunction) {
    const auto function = withJumps();
    const CpuTransfer transfer(function);
    for (int i = 0; i <= 997; ++i) {
        const double s = i / 997.0;
        const auto& piece = transfer.pieces()[transfer.pieceFromAbove(static_cast<float>(s))];
        const double x = s - piece.middle;
        ASSERT_NEAR(piece.extinction + piece.extinctionSlope * x, function.extinctionAt(s), 1e-5) << s;
        if (!piece.visible) continue;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(piece.color[c] + piece.colorSlope[c] * x, function.colorAt(s)[c], 1e-5) << s;
    }
    ASSERT_EQ(transfer.peaks().size(), 1u);
    EXPECT_FALSE(transfer.constantColor());
}

TEST(CpuTransfer, PiecesFromEitherSide) {
    const CpuTransfer transfer(withJumps());
    for (std::size_t k = 0; k + 1 < transfer.pieces().size(); ++k) {
        EXPECT_EQ(transfer.pieceFromBelow(transfer.pieces()[k].high), k);
        EXPECT_EQ(transfer.pieceFromAbove(transfer.pieces()[k].high), k + 1);
    }
}

TEST(CpuTransfer, OneColourWhereAnythingIsSeen) {
    preint::TransferFunction f;
    f.color = {{0.0, {0, 0, 1}}, {0.4, {1, 0, 0}}, {1.0, {1, 0, 0}}};
    f.extinction = {{0.4, 0}, {1.0, 3}};
    EXPECT_TRUE(CpuTransfer(f).constantColor());
    f.isosurfaces = {{0.2, 0.5, {1, 0, 0}}};
    EXPECT_TRUE(CpuTransfer(f).constantColor());
    f.isosurfaces = {{0.2, 0.5, {0, 1, 0}}};
    EXPECT_FALSE(CpuTransfer(f).constantColor());
}

}  // namespace
}  // namespace tetralux::projection
