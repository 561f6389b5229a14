// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/region_field.h>

#include <optional>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {

void addRegionField(CellSoup& soup, const std::string& name, std::vector<double>&& numbers) {
    Field field;
    field.name = name;
    field.association = Association::Cell;
    field.values = std::move(numbers);
    field.bookkeeping = true;
    std::optional<double> first;
    for (std::size_t cell = 0; cell < soup.types.size() && field.bookkeeping; ++cell) {
        if (cellTypeInfo(soup.types[cell]).dimension == 3) {
            first = first.value_or(field.values[cell]);
            field.bookkeeping = field.values[cell] == *first;
        }
    }
    soup.fields.push_back(std::move(field));
}

}  // namespace tetralux::mesh
