// SPDX-License-Identifier: Apache-2.0
//
// The polynomials of short pieces against the exact weights, and the transfer function's pieces against the function.
#include <cmath>

#include <gtest/gtest.h>

#include <preint/exact_integral.h>
#include <preint/glsl_prelude.h>
#include <projection/cpu/cpu_transfer.h>

namespace tetralux::glsl {
#include <projection/cpu/cpu_piece.glsl>
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

TEST(CpuPiece, WeightsOfFinePieces) {
    for (int i = 0; i <= 100; ++i)
        for (int j = -50; j <= 50; ++j) {
            const double depth = glsl::finePieceLimit() * i / 100.0, half = depth * j / 50.0;
            const auto exact = preint::linearPieceWeights(depth - half, depth + half);
            EXPECT_NEAR(glsl::finePieceOpacity(depth), exact.frontWeight + exact.backWeight,
                        std::pow(depth, 5) / 120 + 1e-15);
            EXPECT_NEAR(glsl::finePieceSkew(depth, half), exact.backWeight - exact.frontWeight,
                        depth * depth * depth / 16 + 1e-13);
        }
}

// V·D/α, the paths 1: what silhouettes multiply by another depth's α′/D′. Threshold: V's.
TEST(CpuPiece, LeanOfShortPieces) {
    for (int i = 0; i <= 200; ++i)
        for (int j = -50; j <= 50; ++j) {
            const double depth = i / 200.0, half = std::min(depth, 0.5) * j / 50.0;
            const auto exact = preint::linearPieceWeights(depth - half, depth + half);
            const double opacityPerDepth = depth > 0 ? (exact.frontWeight + exact.backWeight) / depth : 1.0;
            EXPECT_NEAR(glsl::pieceLean(depth, half, depth, half),
                        (exact.backWeight - exact.frontWeight) / opacityPerDepth, 1.4e-5)
                << depth << " " << half;
        }
}

TEST(CpuPiece, ThinPiecesKeepTheirPrecision) {
    for (double depth : {1e-4, 1e-8, 1e-12, 1e-30}) {
        EXPECT_NEAR(glsl::pieceOpacity(depth) / depth, 1.0, depth);
        // V → (d_b − d_f)/6
        EXPECT_NEAR(glsl::pieceSkew(depth, 0.5 * depth) / (depth / 6.0), 1.0, 1e-5 + 2 * depth);
        EXPECT_NEAR(glsl::pieceLean(depth, 0.5 * depth, depth, 0.5 * depth) / (depth / 6.0), 1.0, 1e-5 + 2 * depth);
    }
}

// V of a deep piece as the kernel has it. Threshold: the rational functions err by 1e-5 of Ψ ≤ 1, twice.
TEST(CpuPiece, WeightsOfDeepPieces) {
    for (const double depth : {0.55, 0.7, 1.0, 1.5, 3.0, 10.0, 40.0, 1e3, 1e9})
        for (int j = -100; j <= 100; ++j) {
            const double half = depth * j / 100.0;
            if (depth <= glsl::pieceDepthLimit() && std::abs(half) <= glsl::pieceSlopeLimit()) continue;
            const auto exact = preint::linearPieceWeights(depth - half, depth + half);
            const double perRoot = 1 / glsl::deepPieceRoot(half), front = 0.5 * (depth - half) * perRoot,
                         back = 0.5 * (depth + half) * perRoot;
            const double skew = half > 0 ? glsl::deepPieceSkew(glsl::scaledComplement(front),
                                                               glsl::scaledComplement(back), perRoot, std::exp(-depth))
                                         : glsl::deepPieceSkew(glsl::dawsonIntegral(front), glsl::dawsonIntegral(back),
                                                               perRoot, std::exp(-depth));
            EXPECT_NEAR(skew, exact.backWeight - exact.frontWeight, 3e-5) << depth << " " << half;
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
        const double x = s - piece.origin;
        ASSERT_NEAR(piece.extinction + piece.extinctionSlope * x, function.extinctionAt(s), 1e-5) << s;
        if (!piece.visible) continue;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(piece.color[c] + piece.colorSlope[c] * x, function.colorAt(s)[c], 1e-5) << s;
    }
    ASSERT_EQ(transfer.isosurfaces().size(), 1u);
    EXPECT_FALSE(transfer.constantColor());
}

TEST(CpuTransfer, PiecesFromEitherSide) {
    const CpuTransfer transfer(withJumps());
    for (std::size_t k = 0; k + 1 < transfer.pieces().size(); ++k) {
        EXPECT_EQ(transfer.pieceFromBelow(transfer.pieces()[k].high), k);
        EXPECT_EQ(transfer.pieceFromAbove(transfer.pieces()[k].high), k + 1);
    }
}

// Runs keep the mean of what they stand for, and end where there is a jump.
TEST(CpuTransfer, RunsOfNodesThatALineMeets) {
    preint::TransferFunction f;
    for (int i = 0; i <= 2000; ++i) {
        const double s = i / 2000.0, jump = s > 0.5 ? 3.0 : 0.0;
        if (i == 1000) f.extinction.push_back({s, 2.0 + s});
        f.color.push_back({s, {std::sin(3 * s), s, 0.5}});
        f.extinction.push_back({s, 2.0 + s + (i == 1000 ? 3.0 : jump)});
    }
    const CpuTransfer every(f), some(f, 1e-5);
    EXPECT_LT(some.pieces().size(), every.pieces().size() / 4);
    EXPECT_GT(some.pieces().size(), 20u);
    double error = 0, sum = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto s = static_cast<float>((i + 0.5) / 20000.0);
        const auto at = [&](const CpuTransfer& transfer, std::size_t channel) {
            const TransferPiece& piece = transfer.pieces()[transfer.pieceFromAbove(s)];
            const float ds = s - piece.origin;
            return channel == 3 ? piece.extinction + piece.extinctionSlope * ds
                                : piece.color[channel] + piece.colorSlope[channel] * ds;
        };
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(at(some, c), at(every, c), 1.05e-5) << s;
        EXPECT_NEAR(at(some, 3) / at(every, 3), 1.0, 1.05e-5) << s;
        error = std::max(error, static_cast<double>(std::abs(at(some, 0) - at(every, 0))));
        sum += static_cast<double>(at(some, 0) - at(every, 0)) / 20000.0;
    }
    EXPECT_GT(error, 1e-6);  // something was merged
    EXPECT_NEAR(sum, 0.0, 2e-7);
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
