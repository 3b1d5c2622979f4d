//! ABC, the verifier that proofs are compared with.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// ABC as it is installed, or as its judge in `server/proof` unpacks it.
pub struct Abc {
    program: PathBuf,
    folder: PathBuf,
}

/// What a run of ABC said, and how long the processor worked for it. `None` if
/// it was ended after this many seconds.
pub type Run = Option<(String, Duration)>;

const PATIENCE: &str = "120";

impl Abc {
    /// Brings ABC; `None` if it cannot be had. Files are kept in `folder`.
    pub fn bring(folder: &Path) -> Option<Self> {
        let script = "server/proof/tests/judge/bring-abc";
        let script = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../..")
            .join(script);
        let brought = Command::new("bash").arg(script).arg(folder).output();
        brought.is_ok_and(|it| it.status.success()).then(|| Self {
            program: folder.join("abc"),
            folder: folder.to_owned(),
        })
    }

    /// Puts a file where ABC looks for it.
    pub fn file(&self, name: &str, text: &str) -> std::io::Result<()> {
        std::fs::write(self.folder.join(name), text)
    }

    /// Lets ABC work, and asks the shell what it cost.
    pub fn run(&self, commands: &str) -> Run {
        let script = r#"timeout "$0" "$1" -q "$2"; status=$?; times; exit $status"#;
        let output = Command::new("bash")
            .current_dir(&self.folder)
            .args(["-c", script, PATIENCE])
            .arg(&self.program)
            .arg(commands)
            .output()
            .ok()?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let worked = text.lines().last().and_then(worked)?;
        output.status.success().then_some((text, worked))
    }

    /// The same less what the `preparation` costs, which reads the files.
    pub fn run_after(&self, preparation: &str, commands: &str) -> Run {
        let (_, before) = self.run(preparation)?;
        let (text, all) = self.run(commands)?;
        Some((text, all.saturating_sub(before)))
    }
}

/// The user's and the system's time of children: `0m1.250s 0m0.031s`.
fn worked(line: &str) -> Option<Duration> {
    let times = line.split_whitespace().map(|time| {
        let (minutes, seconds) = time.strip_suffix('s')?.split_once('m')?;
        let seconds: f64 = seconds.parse().ok()?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds)
    });
    let seconds: f64 = times.sum::<Option<f64>>()?;
    Duration::try_from_secs_f64(seconds).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read() {
        let expected = Duration::from_millis(61_281);
        assert_eq!(worked("1m1.250s 0m0.031s"), Some(expected));
        assert_eq!(worked("Networks are equivalent"), None);
    }
}
