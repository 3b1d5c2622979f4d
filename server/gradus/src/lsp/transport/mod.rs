//! The streams of the language server.
//!
//! The protocol library reads a message only when it has written another, and
//! stops for good at a frame that it cannot read. So each stream has a thread
//! of its own, a *pump*, and a queue without end between the pump and the
//! library: [`Input`] hands over only frames that hold one well-formed message,
//! [`Output`] never makes anybody wait for a client that does not read.

mod frame;
mod input;
mod output;

pub use input::Input;
pub use output::Output;

/// A message as it goes over a stream.
fn framed(body: &[u8]) -> Vec<u8> {
    let mut frame = format!("Content-Length: {}\r\n\r\n", body.len()).into_bytes();
    frame.extend_from_slice(body);
    frame
}
