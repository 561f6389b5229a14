// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mesh/vtk_soup.h>

namespace tetralux::mesh {
namespace {

/// Keeps the first error and prints nothing.
class SilentWindow : public vtkOutputWindow {
public:
    static SilentWindow* New();
    vtkTypeMacro(SilentWindow, vtkOutputWindow)
    SilentWindow(const SilentWindow&) = delete;
    SilentWindow& operator=(const SilentWindow&) = delete;

    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override {
        if (firstError.empty() && text != nullptr) {
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

}  // namespace

void captureVtkMessages() { vtkOutputWindow::SetInstance(vtkSmartPointer<SilentWindow>::New()); }

void throwOnVtkError() {
    const auto* window = SilentWindow::SafeDownCast(vtkOutputWindow::GetInstance());
    if (window != nullptr && !window->firstError.empty()) {
        throw std::runtime_error(fmt::format("cannot be read ({}); it is probably truncated or damaged: write it again",
                                             plainMessage(window->firstError)));
    }
}

CellSoup soupFromReader(vtkAlgorithm& reader) {
    captureVtkMessages();
    reader.Update();
    throwOnVtkError();
    return soupFromVtk(reader.GetOutputDataObject(0));
}

}  // namespace tetralux::mesh
