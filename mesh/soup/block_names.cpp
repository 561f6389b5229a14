// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/block_names.h>

#include <algorithm>

namespace tetralux::mesh {

void nameBlock(CellSoup& part, double number, const std::string& name) {
    const bool has = std::any_of(part.fields.begin(), part.fields.end(), [](const Field& field) {
        return field.association == Association::Cell && field.name == blockFieldName;
    });
    if (has) return;
    Field field;
    field.name = blockFieldName;
    field.association = Association::Cell;
    field.values.assign(part.cellCount(), number);
    field.bookkeeping = true;
    part.fields.push_back(std::move(field));
    if (!name.empty()) part.blockNames.push_back({blockFieldName, number, name});
}

}  // namespace tetralux::mesh
