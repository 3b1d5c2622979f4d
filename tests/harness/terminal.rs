use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::ffi::OsStringExt;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

/// How long an answer may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A command that runs at a terminal, and somebody who types there.
///
/// All three streams of the command are the terminal. It is not its controlling
/// terminal, so that Ctrl-C has to be sent as a signal.
pub struct Terminal {
    child: Child,
    keyboard: File,
    shown: Receiver<Vec<u8>>,
    /// What has been shown since the last text that was waited for.
    unread: Vec<u8>,
}

impl Terminal {
    /// Starts `command` at a new terminal.
    ///
    /// # Panics
    ///
    /// If the machine has no terminals to give.
    pub fn start(mut command: Command) -> Self {
        let controller = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
        grantpt(&controller).expect("a terminal of one's own");
        unlockpt(&controller).expect("an open terminal");
        let name = ptsname(&controller, Vec::new()).expect("the name of the terminal");
        let name = std::ffi::OsString::from_vec(name.into_bytes());
        let side = || {
            let file = File::options().read(true).write(true).open(&name);
            Stdio::from(file.expect("the other side of the terminal"))
        };
        let child = command
            .env("TERM", "xterm")
            .stdin(side())
            .stdout(side())
            .stderr(side())
            .spawn()
            .expect("the executable");
        // The command holds copies of the terminal, which would keep it open.
        drop(command);
        let keyboard = File::from(controller);
        let screen = keyboard.try_clone().expect("the terminal");
        Self {
            child,
            keyboard,
            shown: watch(screen),
            unread: Vec::new(),
        }
    }

    /// The number of the process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits until `text` is shown, and gives all that was shown up to its end
    /// since the last time.
    ///
    /// # Panics
    ///
    /// If it is not shown within a minute, or the command ends before.
    #[track_caller]
    pub fn wait_for(&mut self, text: &str) -> String {
        let limit = Instant::now() + PATIENCE;
        loop {
            let found = self
                .unread
                .windows(text.len())
                .position(|window| window == text.as_bytes());
            if let Some(at) = found {
                let rest = self.unread.split_off(at + text.len());
                let shown = std::mem::replace(&mut self.unread, rest);
                return String::from_utf8_lossy(&shown).into_owned();
            }
            let left = limit.saturating_duration_since(Instant::now());
            match self.shown.recv_timeout(left) {
                Ok(bytes) => self.unread.extend(bytes),
                Err(why) => panic!("{why}: no `{text}` in:\n{}", self.rest()),
            }
        }
    }

    /// Types a line.
    pub fn type_line(&mut self, line: &str) {
        writeln!(self.keyboard, "{line}").expect("a terminal to type at");
    }

    /// Presses Ctrl-D, which on an empty line ends the input.
    pub fn press_end_of_input(&mut self) {
        self.keyboard
            .write_all(b"\x04")
            .expect("a terminal to type at");
    }

    /// Waits for the end, and gives the exit status, `None` if a signal ended
    /// the process, and what was shown since the last time.
    pub fn end(mut self) -> (Option<i32>, String) {
        let status = self.child.wait().expect("the end of the process");
        while let Ok(bytes) = self.shown.recv_timeout(PATIENCE) {
            self.unread.extend(bytes);
        }
        (status.code(), self.rest())
    }

    fn rest(&self) -> String {
        String::from_utf8_lossy(&self.unread).into_owned()
    }
}

/// What a screen shows, as it comes.
fn watch(mut screen: File) -> Receiver<Vec<u8>> {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut bytes = [0; 4096];
        // Reading fails when the last process has left the terminal.
        while let Ok(length @ 1..) = screen.read(&mut bytes) {
            if sender.send(bytes[..length].to_vec()).is_err() {
                break;
            }
        }
    });
    receiver
}
