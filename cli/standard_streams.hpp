#pragma once

#include <string>

namespace touchstone {

/// Gives the standard streams that were closed (`>&-`) a descriptor on which every read or write
/// fails. Without it the next file or socket to be opened would be standard output, and what is
/// printed would end up in there. Comes before anything else in main.
void open_closed_streams();

/// Empties the buffers of standard output: was everything printed there really written? If not,
/// says why on standard error.
///
/// A pipe whose reader has ended (`touchstone candidates | head -n 1`) ends the program at the next
/// write by SIGPIPE, quietly, as it does other programs (status 141 of a shell); where a parent has
/// ignored SIGPIPE, it is an output that cannot be written.
bool standard_output_is_written();

/// To standard error, with a newline. What cannot be written there is lost: there is nobody to
/// tell.
void complain(const std::string& text);

}  // namespace touchstone
