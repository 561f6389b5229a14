// SPDX-License-Identifier: Apache-2.0
//
// tetralux-bench-kernels: what the stages of a frame are made of, one by one (Google Benchmark). Arguments are grid
// sizes N of `bucky:N` or texels of a table's axis.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include <apps/bench_scene.h>
#include <mesh/tet/adjacency.h>
#include <preint/exact_integral.h>
#include <preint/preintegration_table.h>
#include <projection/cells/cell_setup.h>
#include <projection/cpu/cpu_bins.h>
#include <projection/frame/engine_registry.h>
#include <projection/order/power_order.h>
#include <projection/order/visibility_order.h>

namespace tetralux::apps {
namespace {

constexpr glm::ivec2 imageSize{512, 512};

const std::shared_ptr<const mesh::ScalarMesh>& buckyOf(int n) {
    static std::map<int, std::shared_ptr<const mesh::ScalarMesh>> meshes;
    auto& mesh = meshes[n];
    if (!mesh) mesh = readBenchMesh("bucky:" + std::to_string(n));
    return mesh;
}

projection::CameraFrame frameOf(const mesh::ScalarMesh& mesh, int frame) {
    return projection::cameraFrame(benchCamera(mesh.bounds, imageSize, frame));
}

void countCells(benchmark::State& state, std::size_t cells) {
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells));
}

void cellSetup(benchmark::State& state) {
    const auto& mesh = *buckyOf(static_cast<int>(state.range(0)));
    const projection::CellProjector projector(mesh, projection::sceneUnits(mesh), frameOf(mesh, 0));
    for (auto _ : state) {
        for (mesh::CellIndex cell = 0; cell < mesh.cells.size(); ++cell) {
            projection::PixelRect rect{};
            if (projector.bounds(cell, rect) != projection::SkipReason::None) continue;
            benchmark::DoNotOptimize(projector.record(cell));
        }
    }
    countCells(state, mesh.cells.size());
}
BENCHMARK(cellSetup)->Arg(32)->Unit(benchmark::kMillisecond);

/// All of a frame's visibility order, camera moved.
void visibilityOrder(benchmark::State& state) {
    const auto& mesh = *buckyOf(static_cast<int>(state.range(0)));
    projection::VisibilitySorter sorter(mesh);
    int frame = 0;
    for (auto _ : state) benchmark::DoNotOptimize(sorter.sort(frameOf(mesh, ++frame)));
    countCells(state, mesh.cells.size());
}
BENCHMARK(visibilityOrder)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();

/// What can be known of the order before there is a camera.
void orderCertificate(benchmark::State& state) {
    const auto& mesh = *buckyOf(static_cast<int>(state.range(0)));
    const mesh::Adjacency adjacency = mesh::buildAdjacency(mesh.cells, mesh.positions.size());
    for (auto _ : state) benchmark::DoNotOptimize(projection::PowerOrder(mesh, adjacency));
    countCells(state, mesh.cells.size());
}
BENCHMARK(orderCertificate)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();

void adjacency(benchmark::State& state) {
    const auto& mesh = *buckyOf(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(mesh::buildAdjacency(mesh.cells, mesh.positions.size()));
    countCells(state, mesh.cells.size());
}
BENCHMARK(adjacency)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();

void radixSort(benchmark::State& state) {
    std::vector<projection::KeyedCell> unsorted(static_cast<std::size_t>(state.range(0))), cells, scratch;
    std::mt19937 random(1);
    for (std::size_t i = 0; i < unsorted.size(); ++i)
        unsorted[i] = {static_cast<std::uint32_t>(random()), static_cast<mesh::CellIndex>(i)};
    for (auto _ : state) {
        state.PauseTiming();
        cells = unsorted;
        state.ResumeTiming();
        projection::radixSort(cells, scratch);
    }
    countCells(state, unsorted.size());
}
BENCHMARK(radixSort)->Arg(150'000)->Arg(5'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();

constexpr int binTiles = 16;  // along either side
constexpr std::size_t binChunk = 16384;

/// As culling leaves them: a cell in one tile or two, keys anyhow.
std::vector<projection::VisibleCell> someVisibleCells(std::size_t count) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::uint32_t> tile(0, binTiles - 1);
    std::uniform_real_distribution<double> key(0.0, 1.0);
    std::vector<projection::VisibleCell> visibleCells(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<std::uint16_t>(tile(random)), y = static_cast<std::uint16_t>(tile(random));
        const auto x1 = static_cast<std::uint16_t>(std::min<int>(x + static_cast<int>(i % 4 == 0), binTiles - 1));
        visibleCells[i] = {key(random), static_cast<mesh::CellIndex>(i), x, y, x1, y};
    }
    return visibleCells;
}

/// Tile lists of a frame: counts, places, entries, each list in order.
void tileBins(benchmark::State& state) {
    const std::vector<projection::VisibleCell> visibleCells =
        someVisibleCells(static_cast<std::size_t>(state.range(0)));
    std::vector<projection::VisibleCellChunk> chunks;
    for (std::size_t begin = 0; begin < visibleCells.size(); begin += binChunk)
        chunks.push_back({begin, std::min(binChunk, visibleCells.size() - begin)});
    projection::TileBins bins;
    for (auto _ : state) {
        bins.reset(chunks.size(), binTiles, binTiles);
        for (std::size_t c = 0; c < chunks.size(); ++c)
            for (std::size_t i = chunks[c].begin; i < chunks[c].begin + chunks[c].count; ++i)
                for (int x = visibleCells[i].x0; x <= visibleCells[i].x1; ++x)
                    ++bins.counts(c)[visibleCells[i].y0 * binTiles + x];
        bins.fill(visibleCells.data(), chunks, 1.0, 0.0, nullptr, nullptr);
        bins.sort(nullptr);
        benchmark::DoNotOptimize(bins.entryCount());
    }
    countCells(state, visibleCells.size());
}
BENCHMARK(tileBins)->Arg(150'000)->Arg(5'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();

constexpr double longest = 0.05;  // mesh units, as in cells of `bucky:32`

struct Segment {
    double front, back, length;
};

/// As cells of `bucky:32` give them: short, anywhere in the range.
std::vector<Segment> someSegments() {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> scalar(0.0, 1.0), change(-0.1, 0.1), length(0.0, longest);
    std::vector<Segment> segments(4096);
    for (Segment& segment : segments) {
        segment.front = scalar(random);
        segment.back = std::clamp(segment.front + change(random), 0.0, 1.0);
        segment.length = length(random);
    }
    return segments;
}

preint::ExactIntegral exactOf(projection::Mode mode) {
    return preint::ExactIntegral(benchTransferFunction("smooth", *buckyOf(32), mode));
}

preint::PreintegrationTable standardTableOf(const preint::ExactIntegral& exact, int size) {
    return preint::buildStandardTable(exact, buckyOf(32)->scalarMin, buckyOf(32)->scalarMax, longest, {.size = size});
}

preint::PreintegrationTable scaleInvariantTableOf(const preint::ExactIntegral& exact, int size) {
    return preint::buildScaleInvariantTable(exact, buckyOf(32)->scalarMin, buckyOf(32)->scalarMax, {.size = size});
}

void exactIntegral(benchmark::State& state, preint::Integral integral) {
    const preint::ExactIntegral exact = exactOf(projection::Mode::Standard);
    const std::vector<Segment> segments = someSegments();
    for (auto _ : state)
        for (const Segment& s : segments) benchmark::DoNotOptimize(exact.segment(s.front, s.back, s.length, integral));
    countCells(state, segments.size());
}
BENCHMARK_CAPTURE(exactIntegral, standard, preint::Integral::Standard);
BENCHMARK_CAPTURE(exactIntegral, scaleInvariant, preint::Integral::ScaleInvariant);

/// The double-precision look-up that the judge of tables uses.
void tableLookUp(benchmark::State& state) {
    const preint::ExactIntegral exact = exactOf(projection::Mode::Standard);
    const preint::PreintegrationTable table = standardTableOf(exact, 0);
    const std::vector<Segment> segments = someSegments();
    for (auto _ : state)
        for (const Segment& s : segments)
            benchmark::DoNotOptimize(preint::lookUpSegment(table, s.front, s.back, s.length));
    countCells(state, segments.size());
}
BENCHMARK(tableLookUp);

void countTexels(benchmark::State& state, std::size_t texels, double error) {
    countCells(state, texels);
    state.counters["error"] = error;
}

void scaleInvariantTable(benchmark::State& state) {
    const preint::ExactIntegral exact = exactOf(projection::Mode::ScaleInvariant);
    preint::PreintegrationTable table;
    for (auto _ : state) table = scaleInvariantTableOf(exact, static_cast<int>(state.range(0)));
    countTexels(state, table.texels.size(), table.measuredError);
}
BENCHMARK(scaleInvariantTable)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

void standardTable(benchmark::State& state) {
    const preint::ExactIntegral exact = exactOf(projection::Mode::Standard);
    preint::PreintegrationTable table;
    for (auto _ : state) table = standardTableOf(exact, static_cast<int>(state.range(0)));
    countTexels(state, table.texels.size(), table.measuredError);
}
BENCHMARK(standardTable)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A whole frame of an engine, camera moved.
void wholeFrame(benchmark::State& state, const std::string& engineName) {
    const auto mesh = buckyOf(static_cast<int>(state.range(0)));
    const projection::Scene scene{
        .mesh = mesh,
        .transferFunction = benchTransferFunction("smooth", *mesh, projection::Mode::Standard),
        .settings = {}};
    std::unique_ptr<projection::Engine> engine;
    try {
        engine = projection::makeEngine(scene, {.engine = engineName});
    } catch (const std::exception& error) {
        state.SkipWithError(error.what());
        return;
    }
    int frame = 0;
    for (auto _ : state) {
        projection::FrameReport report;
        benchmark::DoNotOptimize(engine->render(benchCamera(mesh->bounds, imageSize, ++frame), report));
    }
    countCells(state, mesh->cells.size());
}

}  // namespace
}  // namespace tetralux::apps

int main(int argumentCount, char** arguments) {
    for (const std::string& engine : tetralux::projection::engineNames()) {
        if (engine == "reference") continue;
        benchmark::RegisterBenchmark(("wholeFrame/" + engine).c_str(), tetralux::apps::wholeFrame, engine)
            ->Arg(32)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    benchmark::Initialize(&argumentCount, arguments);
    if (benchmark::ReportUnrecognizedArguments(argumentCount, arguments)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
