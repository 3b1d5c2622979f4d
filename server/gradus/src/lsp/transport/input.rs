use std::io::BufReader;
use std::pin::Pin;
use std::task::{Context, Poll, ready};

use tokio::io::{AsyncRead, ReadBuf};
use tokio::sync::mpsc::{UnboundedReceiver, unbounded_channel};
use tokio::sync::oneshot;

use super::frame::{self, Frame};
use super::{Output, framed};

/// Standard input, as the protocol library reads it: well-formed frames only.
#[derive(Debug)]
pub struct Input {
    frames: UnboundedReceiver<Vec<u8>>,
    /// The frame being read, and how much of it was.
    current: Vec<u8>,
    taken: usize,
}

impl Input {
    /// Starts the pump. What is no message is answered on `output`. Whoever
    /// waits for the second part is woken when the stream has ended.
    pub fn start(output: Output) -> (Self, oneshot::Receiver<()>) {
        let (sender, frames) = unbounded_channel();
        let (open, ended) = oneshot::channel();
        std::thread::spawn(move || {
            let _dropped_at_the_end: oneshot::Sender<()> = open;
            let mut stream = BufReader::new(std::io::stdin().lock());
            loop {
                match frame::next(&mut stream) {
                    Frame::Message(body) => {
                        if sender.send(framed(&body)).is_err() {
                            return;
                        }
                    }
                    Frame::Refused(answer) => output.message(&answer),
                    Frame::End => return,
                }
            }
        });
        let input = Self {
            frames,
            current: Vec::new(),
            taken: 0,
        };
        (input, ended)
    }
}

impl AsyncRead for Input {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<std::io::Result<()>> {
        if self.taken == self.current.len() {
            // No frame any more: nothing is put in, which is the end.
            let Some(next) = ready!(self.frames.poll_recv(context)) else {
                return Poll::Ready(Ok(()));
            };
            self.current = next;
            self.taken = 0;
        }
        let rest = &self.current[self.taken..];
        let length = rest.len().min(buffer.remaining());
        buffer.put_slice(&rest[..length]);
        self.taken += length;
        Poll::Ready(Ok(()))
    }
}
