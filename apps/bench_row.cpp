// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_row.h>

#include <algorithm>

#include <apps/bench_statistics.h>

namespace tetralux::apps {

namespace {

double perSecond(std::uint64_t count, double milliseconds) {
    return milliseconds > 0.0 ? 1000.0 * static_cast<double>(count) / milliseconds : 0.0;
}

}  // namespace

double BenchRow::medianMilliseconds() const {
    return frameMilliseconds.empty() ? 0.0 : median(frameMilliseconds);
}

double BenchRow::leastMilliseconds() const {
    return frameMilliseconds.empty() ? 0.0 : *std::min_element(frameMilliseconds.begin(), frameMilliseconds.end());
}

double BenchRow::medianProcessorMilliseconds() const {
    return processorMilliseconds.empty() ? 0.0 : median(processorMilliseconds);
}

double BenchRow::tetrahedraPerSecond() const {
    return perSecond(subject.tetrahedra, medianMilliseconds());
}

double BenchRow::fragmentsPerSecond() const {
    return perSecond(fragments, medianMilliseconds());
}

double BenchRow::bytesPerTetrahedron() const {
    return subject.tetrahedra == 0 ? 0.0
                                   : static_cast<double>(memoryOverMeshBytes) / static_cast<double>(subject.tetrahedra);
}

void markFronts(std::vector<BenchRow>& rows) {
    std::map<BenchSubject, std::vector<std::size_t>> bySubject;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].onFront = false;
        if (rows[i].judged && rows[i].failure.empty() && rows[i].engine != "reference")
            bySubject[rows[i].subject].push_back(i);
    }
    for (const auto& [subject, members] : bySubject) {
        std::vector<TimeAndError> points;
        for (const std::size_t i : members) points.push_back({rows[i].medianMilliseconds(), rows[i].error.rmse});
        for (const std::size_t i : paretoFront(points)) rows[members[i]].onFront = true;
    }
}

}  // namespace tetralux::apps
