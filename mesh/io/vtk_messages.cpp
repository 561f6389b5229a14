// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <mesh/io/nearest_time.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

/// Keeps the first error and prints nothing.
class SilentWindow : public vtkOutputWindow {
public:
    static SilentWindow* New();
    vtkTypeMacro(SilentWindow, vtkOutputWindow) SilentWindow(const SilentWindow&) = delete;
    SilentWindow& operator=(const SilentWindow&) = delete;

    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override {
        // VTK's own writer leaves the points out of a piece without any.
        constexpr std::string_view emptyPiece = "No Points element available in first piece";
        if (firstError.empty() && text != nullptr &&
            std::string_view(text).find(emptyPiece) == std::string_view::npos) {
            firstError = text;
        }
    }
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}

    std::string firstError;

protected:
    SilentWindow() = default;
};
vtkStandardNewMacro(SilentWindow);

/// "ERROR: In ../file.cxx, line 1\nvtkClass (0x5): message\nmore\n" to "message more".
std::string plainMessage(const std::string& text) {
    std::size_t start = text.find("): ");
    start = start == std::string::npos ? 0 : start + 3;
    std::string plain;
    for (std::size_t i = start; i < text.size() && plain.size() < 300; ++i) {
        const bool space = text[i] == '\n' || text[i] == '\r' || text[i] == '\t' || text[i] == ' ';
        if (!space) {
            plain += text[i];
        } else if (!plain.empty() && plain.back() != ' ') {
            plain += ' ';
        }
    }
    while (!plain.empty() && (plain.back() == ' ' || plain.back() == '.')) {
        plain.pop_back();
    }
    return plain;
}

/// What would mend what VTK complains of.
const char* remedyFor(std::string_view message) {
    const auto says = [&](std::string_view words) { return message.find(words) != std::string_view::npos; };
    if (says("nsupported") || says("Unknown data type")) {
        return "the file may be sound: save it with another encoding or type of values";
    }
    if (says("File for piece") || says("ould not open file") || says("nable to open file") ||
        says("cannot read data from file")) {
        return "a file that it names is missing or damaged: put it in its place";
    }
    for (const std::string_view end :
         {"too short", "remature", "nd of file", "runcated", "not enough", "unexpected end"}) {
        if (says(end)) {
            return "it is probably truncated or damaged: write it again";
        }
    }
    return "if other programs read it, save it as .vtu there, else write it again";
}

}  // namespace

void captureVtkMessages() {
    vtkOutputWindow::SetInstance(vtkSmartPointer<SilentWindow>::New());
}

SilentVtk::SilentVtk() : before_(vtkOutputWindow::GetInstance()), logged_(vtkLogger::GetCurrentVerbosityCutoff()) {
    before_->Register(nullptr);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    captureVtkMessages();
}

SilentVtk::~SilentVtk() {
    vtkOutputWindow::SetInstance(before_);
    before_->UnRegister(nullptr);
    vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(logged_));
}

void throwOnVtkError() {
    const auto* window = SilentWindow::SafeDownCast(vtkOutputWindow::GetInstance());
    if (window != nullptr && !window->firstError.empty()) {
        const std::string message = plainMessage(window->firstError);
        throw std::runtime_error(fmt::format("cannot be read ({}); {}", message, remedyFor(message)));
    }
}

CellSoup soupFromReader(vtkAlgorithm& reader, std::optional<double> time) {
    captureVtkMessages();
    reader.UpdateInformation();
    throwOnVtkError();
    std::vector<double> times;
    vtkInformation* information = reader.GetOutputInformation(0);
    if (information != nullptr && information->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS())) {
        const double* steps = information->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
        times.assign(steps, steps + information->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
    }
    if (times.empty()) {
        reader.Update();
    } else {
        reader.UpdateTimeStep(nearestTime(times, time));
    }
    throwOnVtkError();
    CellSoup soup = soupFromVtk(reader.GetOutputDataObject(0));
    soup.times = std::move(times);
    return soup;
}

}  // namespace tetralux::mesh
