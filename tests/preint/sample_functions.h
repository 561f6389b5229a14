// SPDX-License-Identifier: Apache-2.0
/// \file
/// Transfer functions that the tests of this folder share; scalars in [0, 1] unless said otherwise.
#pragma once

#include <preint/transfer_function.h>

namespace tetralux::preint::samples {

inline TransferFunction constant(double extinction) {
    TransferFunction function;
    function.color = {{0.0, {0.8, 0.5, 0.2}}};
    function.extinction = {{0.0, extinction}};
    return function;
}

/// Five nodes of colour and extinction, extinction up to 25.
inline TransferFunction smooth() {
    TransferFunction function;
    function.color = {{0.0, {0.0, 0.0, 1.0}},
                      {0.25, {0.0, 1.0, 1.0}},
                      {0.5, {0.2, 1.0, 0.1}},
                      {0.75, {1.0, 0.9, 0.0}},
                      {1.0, {1.0, 0.0, 0.3}}};
    function.extinction = {{0.0, 0.0}, {0.2, 1.0}, {0.45, 25.0}, {0.7, 4.0}, {1.0, 12.0}};
    return function;
}

/// Transparent but for two triangles of half width 0.004 and extinction 400.
inline TransferFunction narrowTents() {
    TransferFunction function;
    function.color = {{0.0, {0.1, 0.2, 0.9}}, {0.5, {0.9, 0.8, 0.1}}, {1.0, {0.9, 0.1, 0.1}}};
    function.extinction = {{0.3, 0.0}, {0.304, 400.0}, {0.308, 0.0}, {0.696, 0.0}, {0.7, 400.0}, {0.704, 0.0}};
    return function;
}

/// Jumps of colour at 0.4, of extinction at 0.6, of both at 0.8.
inline TransferFunction jumps() {
    TransferFunction function;
    function.color = {{0.0, {0.1, 0.3, 0.9}}, {0.4, {0.2, 0.6, 0.3}}, {0.4, {0.9, 0.6, 0.3}},
                      {0.8, {0.5, 0.1, 0.2}}, {0.8, {1.0, 1.0, 1.0}}, {1.0, {0.0, 0.5, 0.0}}};
    function.extinction = {{0.0, 1.0}, {0.6, 3.0}, {0.6, 20.0}, {0.8, 6.0}, {0.8, 0.0}, {1.0, 9.0}};
    return function;
}

inline TransferFunction isosurfaces() {
    TransferFunction function;
    function.color = {{0.0, {1.0, 1.0, 1.0}}};
    function.isosurfaces = {{0.3, 0.4, {1.0, 0.2, 0.1}}, {0.62, 0.7, {0.1, 0.4, 1.0}}};
    return function;
}

inline TransferFunction smoothWithIsosurfaces() {
    TransferFunction function = smooth();
    function.isosurfaces = isosurfaces().isosurfaces;
    return function;
}

}  // namespace tetralux::preint::samples
