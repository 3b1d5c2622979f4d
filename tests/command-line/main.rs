//! How the executable behaves towards the system: signals, pipes, full disks,
//! files that others own. What it answers is in the transcripts.

mod answers;
mod convert;
mod hostile;
#[cfg(unix)]
mod interrupt;
#[cfg(unix)]
mod interview;
mod quick_start;

/// The built executable in a folder of its own.
fn gradus() -> end_to_end::Gradus {
    end_to_end::Gradus::new(env!("CARGO_BIN_EXE_gradus"))
}
