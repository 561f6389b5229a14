// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include <preint/preintegration_table.h>

namespace tetralux::preint {
namespace {

TransferFunction fiveNodes(double second) {
    TransferFunction function;
    function.color = {{0, {0, 0, 1}}, {second, {0, 1, 1}}, {0.5, {1, 1, 0}}, {0.75, {1, 0.5, 0}}, {1, {1, 0, 0}}};
    function.extinction = {{0, 0}, {second, 3}, {0.5, 12}, {0.75, 25}, {1, 40}};
    return function;
}

TableOptions evenFirst() {
    TableOptions options;
    options.evenTexelsFirst = true;
    return options;
}

// Nodes at quarters fall on texels of a size with (size − 1) divisible by 4: the wanted error needs neither warp nor
// ramps.
TEST(EvenTexels, NodesAtRoundFractionsNeedNoWarp) {
    const ExactIntegral exact(fiveNodes(0.25));
    for (const PreintegrationTable& table :
         {buildScaleInvariantTable(exact, 0, 1, evenFirst()), buildStandardTable(exact, 0, 1, 0.02, evenFirst())}) {
        EXPECT_FALSE(table.warped);
        EXPECT_TRUE(table.ramps.empty());
        EXPECT_EQ((table.size - 1) % 4, 0);
        EXPECT_LE(table.measuredError, 1e-4);
    }
}

// Where even texels miss the error, the other ways are taken: the contract is the error.
TEST(EvenTexels, WantedErrorGoesFirst) {
    const ExactIntegral exact(fiveNodes(0.1234567));
    const PreintegrationTable table = buildStandardTable(exact, 0, 1, 0.03, evenFirst());
    EXPECT_LE(table.measuredError, 1e-4);
}

}  // namespace
}  // namespace tetralux::preint
