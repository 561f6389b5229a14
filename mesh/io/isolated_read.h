// SPDX-License-Identifier: Apache-2.0
/// \file
/// Third-party readers, in a process of their own if the caller asks for one.
///
/// VTK's readers trust their input: a flipped bit makes some of them read outside their arrays, run on without end, or
/// ask for all memory, and the libraries below them print to standard error. A program that may fork has such a reader
/// run in a child that has a time limit, a memory limit and no output, and only the checked-for-size arrays come back.
/// As a welcome side effect none of the reader's memory outlives it.
#pragma once

#include <functional>
#include <string>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Runs `read`, which reads by VTK, and returns what it returned: in this process, one such reader at a time, or, if
/// `isolated`, in a child process. The child must not need other threads of this process. \throws std::runtime_error
/// "source: …" with the text of the exception that `read` threw, or saying that the reader in the child crashed, took
/// more than 10 seconds plus one per megabyte of the file, or asked for more memory than three quarters of the
/// machine's or, of a file that names no others, 512 MiB plus 64 KiB per byte.
CellSoup readThirdParty(const std::string& source, bool isolated, const std::function<CellSoup()>& read);

}  // namespace tetralux::mesh
