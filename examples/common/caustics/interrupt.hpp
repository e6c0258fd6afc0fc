// SPDX-License-Identifier: MIT
/// @file  Ctrl-C: the first one ends the pass with the picture so far, the second one ends the program.
#pragma once

namespace nephroid::examples {

/// From now on, the first Ctrl-C or SIGTERM is only noted; the next one ends the program as usual. A signal that the
/// program was started to ignore stays ignored.
void note_interrupts();

/// Whether an interrupt was noted.
[[nodiscard]] bool is_interrupted();

/// The program's exit status after an interrupt: 128 plus the signal's number, as in shells.
[[nodiscard]] int interrupted_status();

} // namespace nephroid::examples
