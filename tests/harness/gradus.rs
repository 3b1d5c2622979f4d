use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

/// The built executable and a folder of its own to run in, which goes when this
/// is dropped.
pub struct Gradus {
    executable: PathBuf,
    folder: TempDir,
}

/// How a run ended and what it said.
#[derive(Debug)]
pub struct Ended {
    /// Standard output.
    pub answer: String,
    /// Standard error.
    pub aside: String,
    /// The exit status, 0 to 255; `None` if a signal ended the process.
    pub status: Option<i32>,
}

impl Gradus {
    /// The executable at `path`, which a test target knows as
    /// `env!("CARGO_BIN_EXE_gradus")`, in a new empty folder.
    pub fn new(path: &str) -> Self {
        Self {
            executable: path.into(),
            folder: TempDir::with_prefix("gradus-test-").expect("a temporary folder"),
        }
    }

    /// The folder that it runs in.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Puts a file into the folder, making the folders above it.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder().join(name);
        let above = path.parent().expect("a folder");
        std::fs::create_dir_all(above).expect("folders");
        std::fs::write(&path, contents).expect("a file");
        path
    }

    /// A file of the folder.
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder().join(name)).expect("a file")
    }

    /// The command `gradus` with `arguments`, in the folder and with nothing of
    /// the tester's own settings.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = self.prepare(&self.executable);
        command.args(arguments);
        command
    }

    /// Runs `gradus` with `arguments` and nothing on standard input.
    pub fn run(&self, arguments: &[&str]) -> Ended {
        self.run_with(arguments, "")
    }

    /// Runs `gradus` with `arguments` and `input` on standard input.
    pub fn run_with(&self, arguments: &[&str], input: impl AsRef<[u8]>) -> Ended {
        let mut child = self
            .command(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the executable");
        let mut pipe = child.stdin.take().expect("standard input");
        // A command that does not read its input closes it early.
        let _ = pipe.write_all(input.as_ref());
        drop(pipe);
        Ended::of(child)
    }

    /// Runs a line of shell in which `gradus` is the executable.
    pub fn shell(&self, line: &str) -> Ended {
        let folder = self.executable.parent().expect("a folder");
        let path = format!("{}:/usr/local/bin:/usr/bin:/bin", folder.display());
        let child = self
            .prepare(Path::new("sh"))
            .env("PATH", path)
            .args(["-c", line])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("a shell");
        Ended::of(child)
    }

    fn prepare(&self, program: &Path) -> Command {
        let mut command = Command::new(program);
        command
            .current_dir(self.folder())
            .env_clear()
            .env("LC_ALL", "C.UTF-8")
            .env("HOME", self.folder());
        command
    }
}

impl Ended {
    /// Waits for `child` to end.
    pub fn of(child: Child) -> Self {
        let output = child.wait_with_output().expect("the end of the process");
        Self {
            answer: text(output.stdout),
            aside: text(output.stderr),
            status: output.status.code(),
        }
    }
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("output in UTF-8")
}
