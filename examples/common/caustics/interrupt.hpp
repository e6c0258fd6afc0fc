// SPDX-License-Identifier: MIT
/// @file  Ctrl-C: the first ends the pass with the picture so far, the second the program.
#pragma once

namespace nephroid::examples {

/// From here on Ctrl-C, and a polite request to end (SIGTERM), is only noted; the next one ends the program as usual.
/// A signal that whoever started the program has it ignore stays ignored.
void note_interrupts();

/// Whether one came.
[[nodiscard]] bool is_interrupted();

/// What the program then returns: 128 and the signal's number, as shells have it.
[[nodiscard]] int interrupted_status();

} // namespace nephroid::examples
