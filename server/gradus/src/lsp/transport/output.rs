use std::io::Write;
use std::pin::Pin;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

use serde_json::Value;
use tokio::io::AsyncWrite;
use tokio::sync::watch;

use super::framed;

/// Standard output, as the protocol library writes it: never full. Clones write
/// to the same stream, each a whole frame at a time.
#[derive(Clone, Debug)]
pub struct Output {
    frames: Sender<Vec<u8>>,
    /// Bytes that the client has not got yet.
    waiting: watch::Sender<usize>,
    /// What the library has written of a frame.
    partial: Vec<u8>,
}

/// How long the last answers have to reach a client that reads slowly.
const GRACE: Duration = Duration::from_secs(2);

/// With more bytes than this waiting, nothing is told that nobody asked for.
const ROOM: usize = 1 << 20;

impl Output {
    /// Starts the pump into standard output.
    pub fn start() -> Self {
        Self::into(std::io::stdout())
    }

    /// Starts the pump into `stream`.
    fn into(stream: impl Write + Send + 'static) -> Self {
        let (frames, queue) = channel();
        let waiting = watch::Sender::new(0);
        let left = waiting.clone();
        std::thread::spawn(move || pump(stream, &queue, &left));
        Self {
            frames,
            waiting,
            partial: Vec::new(),
        }
    }

    /// Writes a message, before whatever the library begins to write from now
    /// on.
    pub fn message(&self, message: &Value) {
        self.send(framed(message.to_string().as_bytes()));
    }

    /// Writes `frame` when all before it are written.
    pub fn send(&self, frame: Vec<u8>) {
        self.waiting.send_modify(|bytes| *bytes += frame.len());
        // Without a pump the client is gone, and the input ends too.
        let _ = self.frames.send(frame);
    }

    /// Waits until the client has read nearly all that was written. A client
    /// that does not read must not make the server keep ever more for it.
    pub async fn room(&self) {
        let mut waiting = self.waiting.subscribe();
        // The sender is here, so the wait cannot fail.
        let _ = waiting.wait_for(|bytes| *bytes <= ROOM).await;
    }

    /// Waits until everything is written, or the client does not read it.
    pub fn finish(&self) {
        let since = Instant::now();
        while *self.waiting.borrow() > 0 && since.elapsed() < GRACE {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

fn pump(mut stream: impl Write, queue: &Receiver<Vec<u8>>, left: &watch::Sender<usize>) {
    let mut is_open = true;
    while let Ok(frame) = queue.recv() {
        // When nobody reads any more, nothing waits any more.
        is_open = is_open && stream.write_all(&frame).is_ok() && stream.flush().is_ok();
        left.send_modify(|bytes| *bytes -= frame.len());
    }
}

impl AsyncWrite for Output {
    fn poll_write(
        mut self: Pin<&mut Self>,
        _: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<std::io::Result<usize>> {
        self.partial.extend_from_slice(bytes);
        Poll::Ready(Ok(bytes.len()))
    }

    fn poll_flush(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<std::io::Result<()>> {
        // The library flushes after whole frames only.
        if !self.partial.is_empty() {
            let frame = std::mem::take(&mut self.partial);
            self.send(frame);
        }
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<std::io::Result<()>> {
        self.poll_flush(context)
    }
}

#[cfg(test)]
mod tests {
    use futures_util::FutureExt;

    use super::*;

    /// A client that reads a frame only when it is told to.
    struct Slow(Receiver<()>);

    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.recv().map_err(std::io::Error::other)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn there_is_room_again_when_the_client_has_read() {
        let (read, reads) = channel();
        let output = Output::into(Slow(reads));
        assert_eq!(output.room().now_or_never(), Some(()));
        output.send(vec![0; ROOM]);
        output.send(vec![0; 1]);
        assert_eq!(output.room().now_or_never(), None);
        read.send(()).expect("a pump");
        while output.room().now_or_never().is_none() {
            std::thread::yield_now();
        }
    }

    #[test]
    fn nothing_waits_for_a_client_that_is_gone() {
        let (_, reads) = channel();
        let output = Output::into(Slow(reads));
        output.send(vec![0; 2 * ROOM]);
        output.send(vec![0; 2 * ROOM]);
        while output.room().now_or_never().is_none() {
            std::thread::yield_now();
        }
    }
}
