// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/voxel_types.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace tetralux::mesh {
namespace {

template <class T>
double valueAt(const char* bytes, bool bigEndian) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes, sizeof(T));
    if (bigEndian != (std::endian::native == std::endian::big)) {
        std::reverse(raw.begin(), raw.end());
    }
    return static_cast<double>(std::bit_cast<T>(raw));
}

constexpr std::array<VoxelType, 10> types{
    {{"|u8|uint8|uchar|uint8_t|unsigned char|", 1, valueAt<std::uint8_t>},
     {"|u16|uint16|ushort|uint16_t|unsigned short|unsigned short int|", 2, valueAt<std::uint16_t>},
     {"|f32|float32|float|", 4, valueAt<float>},
     {"|f64|float64|double|", 8, valueAt<double>},
     {"|i8|int8|char|int8_t|signed char|", 1, valueAt<std::int8_t>},
     {"|i16|int16|short|int16_t|short int|signed short|signed short int|", 2, valueAt<std::int16_t>},
     {"|u32|uint32|uint|uint32_t|unsigned int|", 4, valueAt<std::uint32_t>},
     {"|i32|int32|int|int32_t|signed int|", 4, valueAt<std::int32_t>},
     {"|u64|uint64|ulonglong|uint64_t|unsigned long long|unsigned long long int|", 8, valueAt<std::uint64_t>},
     {"|i64|int64|longlong|int64_t|long long|long long int|signed long long|signed long long int|", 8,
      valueAt<std::int64_t>}}};

}  // namespace

bool VoxelType::isCalled(std::string_view name) const {
    const std::string_view all = names;
    for (std::size_t i = all.find(name); !name.empty() && i != std::string_view::npos; i = all.find(name, i + 1)) {
        if (i > 0 && all[i - 1] == '|' && all[i + name.size()] == '|') {
            return true;
        }
    }
    return false;
}

std::span<const VoxelType> voxelTypes() {
    return types;
}

}  // namespace tetralux::mesh
