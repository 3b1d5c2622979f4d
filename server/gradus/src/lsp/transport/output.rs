use std::io::Write;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

use tokio::io::AsyncWrite;

/// Standard output, as the protocol library writes it: never full. Clones write
/// to the same stream, each a whole frame at a time.
#[derive(Clone, Debug)]
pub struct Output {
    frames: Sender<Vec<u8>>,
    /// Frames that the client has not got yet.
    waiting: Arc<AtomicUsize>,
    /// What the library has written of a frame.
    partial: Vec<u8>,
}

/// How long the last answers have to reach a client that reads slowly.
const GRACE: Duration = Duration::from_secs(2);

impl Output {
    /// Starts the pump.
    pub fn start() -> Self {
        let (frames, queue) = channel();
        let waiting = Arc::new(AtomicUsize::new(0));
        let left = Arc::clone(&waiting);
        std::thread::spawn(move || pump(&queue, &left));
        Self {
            frames,
            waiting,
            partial: Vec::new(),
        }
    }

    /// Writes `frame` when all before it are written.
    pub fn send(&self, frame: Vec<u8>) {
        self.waiting.fetch_add(1, Ordering::SeqCst);
        // Without a pump the client is gone, and the input ends too.
        let _ = self.frames.send(frame);
    }

    /// Waits until everything is written, or the client does not read it.
    pub fn finish(&self) {
        let since = Instant::now();
        while self.waiting.load(Ordering::SeqCst) > 0 && since.elapsed() < GRACE {
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

fn pump(queue: &Receiver<Vec<u8>>, left: &AtomicUsize) {
    let mut stream = std::io::stdout().lock();
    while let Ok(frame) = queue.recv() {
        let written = stream.write_all(&frame).and_then(|()| stream.flush());
        left.fetch_sub(1, Ordering::SeqCst);
        if written.is_err() {
            // Nobody reads any more, so nothing waits any more.
            while queue.recv().is_ok() {
                left.fetch_sub(1, Ordering::SeqCst);
            }
            return;
        }
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
