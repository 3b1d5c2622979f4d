//! Ctrl-C.
//!
//! The first press raises a flag, so that a command can clear its progress line
//! and end by itself with status 130. A command that waits for something else,
//! as for standard input, never asks the flag; so half a second later the
//! process ends anyway. It never ends in the middle of replacing a file.

use std::time::Duration;

use logic::Cancel;

use crate::file;
use crate::status::Status;

/// How long a command has to end by itself.
const GRACE: Duration = Duration::from_millis(500);

/// Raises `cancel` when Ctrl-C is pressed, from now on.
pub fn listen(cancel: Cancel) {
    let handler = move || {
        cancel.cancel();
        std::thread::sleep(GRACE);
        let _nothing_half_written = file::hold_writing();
        std::process::exit(Status::Interrupted.exit_status().into());
    };
    // Where no handler can be set, Ctrl-C ends the process as it always did.
    let _ = ctrlc::set_handler(handler);
}
