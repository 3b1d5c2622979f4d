use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStderr, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::{Duration, Instant};

use serde_json::Value;

/// A language server and its streams: messages go in and out as they are. What
/// nobody receives stays in the pipe, as with a client that does not read.
#[derive(Debug)]
pub struct Wire {
    server: Child,
    /// `None` once it was closed.
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
}

/// How long a test waits for what must come. Machines that run tests may be
/// slow; a server that hangs is one that has not answered by now.
const PATIENCE: Duration = Duration::from_secs(120);

impl Wire {
    /// Starts the server that `executable` is.
    pub fn start(executable: &str) -> Self {
        Self::run(Command::new(executable).arg("lsp").stderr(Stdio::null()))
    }

    /// Starts the server that `command` runs.
    pub fn run(command: &mut Command) -> Self {
        let mut server = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the server starts");
        let output = server.stdout.take().expect("its standard output");
        // Nothing is read before somebody wants it.
        let (sender, messages) = sync_channel(0);
        std::thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = message(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Self {
            input: server.stdin.take(),
            server,
            messages,
        }
    }

    /// What the server writes on standard error, if the command that started it
    /// says so.
    pub fn errors(&mut self) -> ChildStderr {
        self.server.stderr.take().expect("its standard error")
    }

    /// The server's number among processes.
    pub fn id(&self) -> u32 {
        self.server.id()
    }

    /// Sends a message.
    pub fn send(&mut self, message: &Value) {
        let body = message.to_string();
        let header = format!("Content-Length: {}\r\n\r\n", body.len());
        self.send_bytes(&[header.as_bytes(), body.as_bytes()].concat());
    }

    /// Sends bytes, whatever they are. A server that is gone reads nothing.
    pub fn send_bytes(&mut self, bytes: &[u8]) {
        if let Some(input) = &mut self.input {
            let _ = input.write_all(bytes).and_then(|()| input.flush());
        }
    }

    /// Closes the server's standard input.
    pub fn close(&mut self) {
        self.input = None;
    }

    /// The next message. Fails the test if none comes.
    pub fn receive(&self) -> Value {
        match self.messages.recv_timeout(PATIENCE) {
            Ok(message) => message,
            Err(RecvTimeoutError::Timeout) => panic!("the server does not answer"),
            Err(RecvTimeoutError::Disconnected) => panic!("the server has ended"),
        }
    }

    /// The next message if one comes within `time`.
    pub fn receive_within(&self, time: Duration) -> Option<Value> {
        self.messages.recv_timeout(time).ok()
    }

    /// Waits until the server has ended. Fails the test if it does not.
    pub fn wait(&mut self) -> ExitStatus {
        let since = Instant::now();
        loop {
            if let Some(status) = self.server.try_wait().expect("its status") {
                return status;
            }
            assert!(since.elapsed() < PATIENCE, "the server does not end");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

impl Drop for Wire {
    fn drop(&mut self) {
        // Only a test that failed leaves it running.
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The next message of a stream; `None` at its end.
fn message(stream: &mut impl BufRead) -> Option<Value> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if stream.read_line(&mut line).ok()? == 0 {
            return None;
        }
        let line = line.trim_end();
        if line.is_empty() {
            break;
        }
        let (name, value) = line.split_once(':').expect("a header");
        if name.eq_ignore_ascii_case("content-length") {
            length = value.trim().parse().ok();
        }
    }
    let mut body = vec![0; length.expect("a Content-Length")];
    stream.read_exact(&mut body).ok()?;
    Some(serde_json::from_slice(&body).expect("a message in JSON"))
}
