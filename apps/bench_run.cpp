// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_run.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include <apps/bench_scene.h>
#include <apps/bench_vtk_rows.h>

namespace tetralux::apps {

namespace {

std::string subjectName(const BenchSubject& subject) {
    return fmt::format("{} {}x{} {} {}", subject.scene, subject.width, subject.height, subject.transferFunction,
                       subject.mode);
}

/// All that is done with one mesh.
class SceneBench {
public:
    SceneBench(const BenchPlan& plan, const std::string& source, const std::function<void(const std::string&)>& tell)
        : plan_(plan), source_(source), tell_(tell) {
        tell_(fmt::format("{}: reading", source));
        mesh_ = readBenchMesh(source);
        if (!plan.engines.vtkMappers.empty()) vtk_.emplace(plan.engines.vtkProgram, *mesh_);
    }

    void run(const std::string& transferFunction, const NamedMode& mode, std::vector<BenchRow>& rows) const {
        projection::Scene scene{.mesh = mesh_,
                                .transferFunction = benchTransferFunction(transferFunction, *mesh_, mode.mode),
                                .settings = {.mode = mode.mode, .shading = {}, .adaptive = {}, .table = {}}};
        scene.settings.shading.silhouette = mode.silhouette;
        scene.settings.adaptive = mode.adaptive;
        scene.settings.samples = mode.samples;
        std::vector<BenchSubject> subjects;
        for (const glm::ivec2& size : plan_.sizes)
            subjects.push_back({source_, mesh_->cells.size(), size.x, size.y, transferFunction, mode.name});
        std::vector<ReferenceImages> references;
        for (const BenchSubject& subject : subjects) {
            tell_(subjectName(subject) + ": reference");
            references.push_back(judge(scene, subject, plan_.frames));
        }
        std::vector<BenchRow> measured = drawWithOurs(scene, subjects, references);
        if (mode.mode == projection::Mode::Standard && !mode.silhouette && !mode.adaptive && mode.samples == 1)
            drawWithVtk(scene, subjects, references, measured);
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            if (plan_.engines.reference) rows.push_back(references[i].row);
            std::copy_if(measured.begin(), measured.end(), std::back_inserter(rows),
                         [&](const BenchRow& row) { return row.subject == subjects[i]; });
        }
    }

private:
    std::vector<BenchRow> drawWithOurs(const projection::Scene& scene, const std::vector<BenchSubject>& subjects,
                                       const std::vector<ReferenceImages>& references) const {
        std::vector<BenchRow> rows;
        for (const EngineChoice& choice : plan_.engines.choices) {
            tell_(fmt::format("{}: {} {}", subjectName(subjects.front()), choice.name(), choice.setting()));
            for (BenchRow& row : measureEngine(scene, choice, subjects, references, plan_.frames))
                rows.push_back(std::move(row));
        }
        return rows;
    }

    void drawWithVtk(const projection::Scene& scene, const std::vector<BenchSubject>& subjects,
                     const std::vector<ReferenceImages>& references, std::vector<BenchRow>& rows) const {
        for (const std::string& mapper : plan_.engines.vtkMappers) {
            for (std::size_t i = 0; i < subjects.size(); ++i) {
                tell_(fmt::format("{}: vtk:{}", subjectName(subjects[i]), mapper));
                rows.push_back(vtk_->measure(scene, mapper, subjects[i], references[i], plan_.frames));
            }
        }
    }

    const BenchPlan& plan_;
    std::string source_;
    const std::function<void(const std::string&)>& tell_;
    std::shared_ptr<const mesh::ScalarMesh> mesh_;
    std::optional<VtkBench> vtk_;
};

}  // namespace

std::vector<BenchRow> runBench(const BenchPlan& plan, const std::function<void(const std::string&)>& tell) {
    std::vector<BenchRow> rows;
    for (const std::string& source : plan.sources) {
        const SceneBench bench(plan, source, tell);
        for (const NamedMode& mode : plan.modes)
            for (const std::string& transferFunction : plan.transferFunctions) bench.run(transferFunction, mode, rows);
    }
    markFronts(rows);
    return rows;
}

double rmseBound(const BenchSubject& subject) {
    return subject.transferFunction == "peaks" || subject.transferFunction == "veiled" ? 2e-3 : 1e-4;
}

std::vector<std::string> wrongPictures(const std::vector<BenchRow>& rows) {
    std::vector<std::string> wrong;
    std::size_t judged = 0;
    for (const BenchRow& row : rows) {
        if (row.engine.starts_with("vtk:") || row.engine == "reference" || !row.failure.empty()) continue;
        ++judged;
        const double bound = rmseBound(row.subject);
        if (!(row.judged && row.error.rmse <= bound))
            wrong.push_back(fmt::format("{}, {}: rmse {:.3g} is above {:.3g}", subjectName(row.subject), row.engine,
                                        row.judged ? row.error.rmse : std::nan(""), bound));
    }
    if (judged == 0) wrong.emplace_back("no engine drew a picture");
    return wrong;
}

}  // namespace tetralux::apps
