// SPDX-License-Identifier: Apache-2.0
/// \file
/// Third-party readers in a process of their own.
///
/// VTK's readers trust their input: a flipped bit makes some of them read outside their arrays, run on without end, or
/// ask for all memory, and the libraries below them print to standard error. So such a reader runs in a forked child
/// that has a time limit, a memory limit and no output, and only the checked-for-size arrays come back. As a welcome
/// side effect none of the reader's memory outlives it.
#pragma once

#include <functional>
#include <string>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Runs `read` in a child process and returns what it returned. The child must not need other threads of this process.
/// \throws std::runtime_error "source: …" with the text of the exception that `read` threw, or saying that the reader
/// crashed, took more than 10 seconds plus one per megabyte of the file, or asked for more memory than three quarters of
/// the machine's or, of a file that names no others, 512 MiB plus 64 KiB per byte.
CellSoup readIsolated(const std::string& source, const std::function<CellSoup()>& read);

}  // namespace tetralux::mesh
