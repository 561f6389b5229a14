// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/run_program.h>
#include <mesh/io/temporary_folder.h>

namespace tetralux::mesh {
namespace {

/// meshio by its public functions: a .vtu of the file's mesh, of the step nearest to a time if it has steps, which go
/// to a text file. Sets of cells become fields of 0 and 1 or of numbers.
constexpr const char* program = R"(
import sys
try:
    import meshio
except ImportError:
    print("meshio is not installed")
    sys.exit(3)
source, target, steps, wanted = sys.argv[1:]

def of_series(reader):
    points, cells = reader.read_points_cells()
    times = [reader.read_data(k)[0] for k in range(reader.num_steps)]
    step = 0 if wanted == "" else min(range(len(times)), key=lambda k: abs(times[k] - float(wanted)))
    _, point_data, cell_data = reader.read_data(step)
    open(steps, "w").write(" ".join(repr(float(t)) for t in times))
    return meshio.Mesh(points, cells, point_data=point_data, cell_data=cell_data)

def read():
    if source.lower().endswith((".xdmf", ".xmf")) and "Temporal" in open(source, errors="replace").read():
        with meshio.xdmf.TimeSeriesReader(source) as reader:
            return of_series(reader)
    return meshio.read(source)

try:
    mesh = read()
    if mesh.cell_sets:
        mesh.cell_sets_to_data()
    mesh.field_data, mesh.point_sets = {}, {}
    meshio.write(target, mesh, file_format="vtu")
except BaseException as error:
    words = " ".join(str(error).split())
    print("meshio cannot read it" + (": " + words[:300] if words else ""))
    sys.exit(4)
)";

/// Of kinds that no other format here takes.
bool acceptsMeshio(const std::string& source) {
    return hasExtension(source, {".xdmf", ".xmf", ".bdf", ".nas", ".fem", ".su2", ".f3grid", ".mdpa", ".med", ".h5m",
                                 ".tec", ".ugrid", ".avs", ".vol", ".dato", ".hmf"});
}

constexpr const char* python = "python3";  // of an active virtual environment, if there is one

std::vector<double> numbersIn(const std::filesystem::path& path) {
    std::vector<double> numbers;
    std::ifstream file(path);
    for (double number = 0; file >> number;) numbers.push_back(number);
    return numbers;
}

void convert(const std::string& source, const TemporaryFolder& folder, const ReadOptions& options) {
    const std::string output = (folder.path() / "output").string();
    try {
        runProgram({python, "-c", program, source, (folder.path() / "mesh.vtu").string(),
                    (folder.path() / "steps").string(), options.time ? fmt::format("{}", *options.time) : ""},
                   output);
    } catch (const std::runtime_error& error) {
        std::ifstream file(output);
        std::string words, line;
        while (std::getline(file, line))
            if (line.starts_with("meshio ")) words = line;
        if (words.empty()) throw std::runtime_error(fmt::format("{}: is read by meshio: {}", source, error.what()));
        if (words == "meshio is not installed")
            throw std::runtime_error(
                fmt::format("{}: is read by meshio, which {} does not find; install it (pip install meshio h5py) or "
                            "convert the file to .vtu",
                            source, python));
        throw std::runtime_error(
            folder.shown(fmt::format("{}: {}; write it again or convert it to .vtu", source, words), "."));
    }
}

CellSoup readMeshio(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    const TemporaryFolder folder(source);
    convert(source, folder, options);
    try {
        CellSoup soup = vtkXmlFormat.read((folder.path() / "mesh.vtu").string(), options);
        soup.times = numbersIn(folder.path() / "steps");
        return soup;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: by meshio: {}", source, folder.shown(error.what(), ".")));
    }
}

}  // namespace

const MeshFormat meshioFormat{"by meshio, where Python has it",
                              ".xdmf .bdf .nas .su2 .f3grid .mdpa .med .tec .ugrid .inp of Abaqus", acceptsMeshio,
                              readMeshio};

}  // namespace tetralux::mesh
