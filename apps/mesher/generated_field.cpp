// SPDX-License-Identifier: Apache-2.0
#include "generated_field.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExprTkFunctionParser.h>
#include <vtkNew.h>

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "surface_locator_vtk.h"
#include "tet_assembly.h"

namespace tetralux::mesher {
namespace {

bool isName(const std::string& text) {
    return !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_') &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// Whether `word` stands in `text` as a word of its own.
bool mentions(const std::string& text, const std::string& word) {
    const auto inWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !inWord(text[at - 1])) && (end == text.size() || !inWord(text[end]))) return true;
    }
    return false;
}

std::vector<double> distances(const mesh::TetMesh& mesh) {
    const TriangleSurface boundary = boundaryOf(mesh);
    std::vector<bool> onBoundary(mesh.positions.size(), false);
    for (const Triangle& t : boundary.triangles)
        for (const std::uint32_t i : t) onBoundary[i] = true;
    const SurfaceLocator locator(boundary);
    std::vector<double> values(mesh.positions.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!onBoundary[i]) values[i] = locator.nearest(mesh.positions[i]).distance;
    return values;
}

std::vector<double> builtIn(const mesh::TetMesh& mesh, const std::string& name) {
    if (name == "distance") return distances(mesh);
    std::vector<double> values(mesh.positions.size());
    const glm::dvec3 centre = mesh::usedBounds(mesh.positions, mesh.cells).centre();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::dvec3& p = mesh.positions[i];
        values[i] = name == "x" ? p.x : name == "y" ? p.y : name == "z" ? p.z : glm::length(p - centre);
    }
    return values;
}

const std::vector<std::string> builtInNames{"x", "y", "z", "radius", "distance"};

void keepMessage(vtkObject*, unsigned long, void* kept, void* text) {
    auto& message = *static_cast<std::string*>(kept);
    if (message.empty()) message = static_cast<const char*>(text);
}

/// VTK's error text without "ERROR: In file, line … vtkClass (0x…): " before it.
std::string shortened(const std::string& message) {
    const std::size_t at = message.find("): ");
    std::string text = message.substr(at == std::string::npos ? 0 : at + 3);
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(" ") + 1);
    return text;
}

std::vector<double> evaluate(const mesh::TetMesh& mesh, const std::string& formula) {
    struct Variable {
        std::string name;
        std::vector<double> values;
    };
    std::vector<Variable> variables;
    for (const mesh::Field& field : mesh.fields)
        if (field.association == mesh::Association::Point && field.components == 1 && isName(field.name) &&
            mentions(formula, field.name))
            variables.push_back({field.name, field.values});
    for (const std::string& name : builtInNames) {
        const bool taken =
            std::any_of(variables.begin(), variables.end(), [&](const auto& v) { return v.name == name; });
        if (!taken && mentions(formula, name)) variables.push_back({name, builtIn(mesh, name)});
    }
    std::string problem;
    const vtkNew<vtkCallbackCommand> listener;
    listener->SetCallback(keepMessage);
    listener->SetClientData(&problem);
    const vtkNew<vtkExprTkFunctionParser> parser;
    parser->AddObserver(vtkCommand::ErrorEvent, listener);
    parser->SetFunction(formula.c_str());
    for (const Variable& v : variables) parser->SetScalarVariableValue(v.name, 0.0);
    std::vector<double> values(mesh.positions.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t v = 0; v < variables.size(); ++v)
            parser->SetScalarVariableValue(static_cast<int>(v), variables[v].values[i]);
        if (i == 0 && parser->IsScalarResult() == 0 && problem.empty()) problem = "it does not give a number";
        if (problem.empty()) values[i] = parser->GetScalarResult();
        if (!problem.empty())
            throw std::runtime_error(
                fmt::format("--field '{}' is not understood ({}): take x, y, z, radius, distance, or a formula of them",
                            formula, shortened(problem)));
    }
    return values;
}

}  // namespace

void addGeneratedField(mesh::TetMesh& mesh, const std::string& specification) {
    std::string name = "formula", formula = specification;
    const std::size_t equals = specification.find('=');
    if (equals != std::string::npos && isName(specification.substr(0, equals)) &&
        specification.substr(equals + 1, 1) != "=") {
        name = specification.substr(0, equals);
        formula = specification.substr(equals + 1);
    }
    const bool isBuiltIn = std::find(builtInNames.begin(), builtInNames.end(), formula) != builtInNames.end();
    if (isBuiltIn && equals == std::string::npos) name = formula;
    mesh::Field field{name, mesh::Association::Point, 1, isBuiltIn ? builtIn(mesh, formula) : evaluate(mesh, formula)};
    std::erase_if(mesh.fields, [&](const mesh::Field& f) { return f.name == name; });
    mesh.fields.insert(mesh.fields.begin(), std::move(field));  // the first field is the one that is drawn
}

}  // namespace tetralux::mesher
