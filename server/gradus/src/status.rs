//! How a run ended, as the exit status that a script sees.

use std::io::ErrorKind;
use std::process::ExitCode;

use crate::io::Io;

/// How a command ended, from best to worst: of two, the greater one counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Done, and all is well.
    Done,
    /// Done, and problems were found.
    ProblemsFound,
    /// The command line makes no sense, or a file cannot be read or written.
    Usage,
    /// Somebody pressed Ctrl-C.
    Interrupted,
}

impl Status {
    /// The exit status: 0, 1 and 2, and 130 as shells have it for Ctrl-C.
    pub fn exit_status(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::ProblemsFound => 1,
            Self::Usage => 2,
            Self::Interrupted => 130,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        Self::from(status.exit_status())
    }
}

/// The status of a command that ended so, after its answer was handed over.
///
/// An answer nobody reads any more (`gradus check | head`) is no problem; one
/// that could not be written (a full disk) is, or a script would take half an
/// answer for a whole one.
pub fn settle(ended: std::io::Result<Status>, mut io: Io) -> Status {
    let settled = ended.and_then(|status| io.flush().map(|()| status));
    match settled {
        Ok(status) => status,
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Status::Done,
        Err(error) => {
            io.complain(&format!("the answer cannot be written: {error}"));
            Status::Usage
        }
    }
}
